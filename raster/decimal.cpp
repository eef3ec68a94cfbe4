#include "raster/decimal.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace hemicube {
namespace {

/// An unsigned integer below 2^1280: more than any double, scaled by any power of ten that occurs.
class Natural {
public:
  explicit Natural(std::uint64_t value) noexcept
      : words_{static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(value >> 32)} {}

  void shift_left(int bits) noexcept {
    for (; bits >= 16; bits -= 16)
      multiply(1u << 16);
    multiply(1u << bits);
  }

  void multiply(std::uint32_t factor) noexcept {
    std::uint64_t carry = 0;
    for (std::uint32_t& word : words_) {
      carry += std::uint64_t{word} * factor;
      word = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }

  void add(const Natural& other) noexcept {
    std::uint64_t carry = 0;
    for (int i = 0; i < kWords; ++i) {
      carry += std::uint64_t{words_[i]} + other.words_[i];
      words_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }

  /// @param other  not larger
  void subtract(const Natural& other) noexcept {
    std::uint64_t borrow = 0;
    for (int i = 0; i < kWords; ++i) {
      const std::uint64_t difference = std::uint64_t{words_[i]} - other.words_[i] - borrow;
      words_[i] = static_cast<std::uint32_t>(difference);
      borrow = difference >> 63;
    }
  }

  /// < 0, 0 or > 0 as this is less than, equal to or more than the other.
  int compare(const Natural& other) const noexcept {
    for (int i = kWords - 1; i >= 0; --i)
      if (words_[i] != other.words_[i])
        return words_[i] < other.words_[i] ? -1 : 1;
    return 0;
  }

private:
  static constexpr int kWords = 40;
  std::uint32_t words_[kWords];
};

struct Digits {
  char text[kMaxDecimal];
  int count = 0;
  int exponent = 0; ///< of ten: the value is d.ddd times ten to it
};

/// The shortest digits of fraction * 2^exponent, > 0, whose neighbours are half a unit away; below
/// half as much if it is a power of two.
Digits shortest_digits(std::uint64_t fraction, int exponent, bool is_power) noexcept {
  // In units of 1 / scale: the value, and how far from it a number may be that reads back the same.
  Natural value(fraction), scale(1), above(1), below(1);
  value.shift_left(1 + (is_power ? 1 : 0) + (exponent > 0 ? exponent : 0));
  scale.shift_left(1 + (is_power ? 1 : 0) + (exponent < 0 ? -exponent : 0));
  above.shift_left((is_power ? 1 : 0) + (exponent > 0 ? exponent : 0));
  below.shift_left(exponent > 0 ? exponent : 0);
  const int reach = fraction % 2 == 0 ? 0 : 1;      // ties read back as the even one
  const auto exceeds = [&](const Natural& number) { // whether number + above is at least scale
    Natural sum = number;
    sum.add(above);
    return sum.compare(scale) >= reach;
  };

  Digits digits;
  while (exceeds(value)) {
    scale.multiply(10);
    ++digits.exponent;
  }
  const auto next = [&] {
    value.multiply(10);
    above.multiply(10);
    below.multiply(10);
  };
  for (next(); !exceeds(value); next())
    --digits.exponent;
  --digits.exponent;
  while (true) {
    int digit = 0;
    for (; value.compare(scale) >= 0; ++digit)
      value.subtract(scale);
    const bool low = value.compare(below) <= -reach, high = exceeds(value);
    if (low && high) {
      value.multiply(2);
      const int half = value.compare(scale);
      digit += half > 0 || (half == 0 && digit % 2 == 1) ? 1 : 0;
    } else if (high) {
      ++digit;
    }
    digits.text[digits.count++] = static_cast<char>('0' + digit);
    if (low || high)
      return digits;
    next();
  }
}

/// Text in a buffer that is known to be large enough.
struct Writer {
  char* to;
  void put(char c) { *to++ = c; }
  void put(const char* text, int count) {
    std::memcpy(to, text, static_cast<std::size_t>(count));
    to += count;
  }
  void zeros(int count) {
    for (; count > 0; --count)
      put('0');
  }
};

void write_scientific(const Digits& d, Writer* out) noexcept {
  out->put(d.text[0]);
  if (d.count > 1) {
    out->put('.');
    out->put(d.text + 1, d.count - 1);
  }
  const int size = d.exponent < 0 ? -d.exponent : d.exponent;
  out->put('e');
  out->put(d.exponent < 0 ? '-' : '+');
  if (size >= 100)
    out->put(static_cast<char>('0' + size / 100));
  out->put(static_cast<char>('0' + size / 10 % 10));
  out->put(static_cast<char>('0' + size % 10));
}

void write_fixed(const Digits& d, double magnitude, Writer* out) noexcept {
  if (d.exponent < 0) {
    out->put("0.", 2);
    out->zeros(-d.exponent - 1);
    out->put(d.text, d.count);
  } else if (d.exponent < d.count - 1) {
    out->put(d.text, d.exponent + 1);
    out->put('.');
    out->put(d.text + d.exponent + 1, d.count - d.exponent - 1);
  } else { // a whole number, all of it
    auto whole = static_cast<unsigned __int128>(magnitude);
    out->to += d.exponent + 1;
    for (int k = 1; k <= d.exponent + 1; ++k, whole /= 10)
      out->to[-k] = static_cast<char>('0' + static_cast<int>(whole % 10));
  }
}

} // namespace

std::size_t shortest_decimal(double value, char* text) noexcept {
  constexpr std::uint64_t kHiddenBit = std::uint64_t{1} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t fraction = bits % kHiddenBit;
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  Writer out{text};
  if (bits >> 63 != 0)
    out.put('-');
  if (exponent == 0x7ff) {
    out.put(fraction == 0 ? "inf" : "nan", 3);
  } else if (exponent == 0 && fraction == 0) {
    out.put('0');
  } else {
    const Digits d = exponent == 0 ? shortest_digits(fraction, -1074, false)
                                   : shortest_digits(fraction + kHiddenBit, exponent - 1075,
                                                     fraction == 0 && exponent > 1);
    const int size = d.exponent < 0 ? -d.exponent : d.exponent;
    const int fixed = d.exponent < 0       ? 1 + size + d.count
                      : size < d.count - 1 ? d.count + 1
                                           : size + 1;
    const int scientific = d.count + (d.count > 1 ? 1 : 0) + (size >= 100 ? 5 : 4);
    if (fixed <= scientific)
      write_fixed(d, value < 0 ? -value : value, &out);
    else
      write_scientific(d, &out);
  }
  return static_cast<std::size_t>(out.to - text);
}

} // namespace hemicube
