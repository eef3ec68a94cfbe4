#pragma once

#include "raster/math.h"

#include <cmath>
#include <cstdint>
#include <span>

namespace hemicube::test {

/// Makes numbers of the bytes of a case, one after the other; 0 beyond the end. Two calls in one
/// expression would be made in an order of the compiler's, and a case be another with each.
class ByteReader {
public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }

  std::uint32_t byte() {
    if (bytes_.empty())
      return 0;
    const std::uint32_t value = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return value;
  }
  std::uint32_t below(std::uint32_t count) { return byte() % count; }

  /// A multiple of 1/64 in [-2, 2): coordinates that often agree.
  double coarse() { return (static_cast<double>(byte()) - 128) / 64; }
  /// 16 bits in [-2, 2).
  double fine() {
    const double high = coarse();
    return high + static_cast<double>(byte()) / 0x1p14;
  }
  /// A share, 0 and 1 included.
  double share() { return static_cast<double>(byte()) / 255; }
  /// A power of two between 1 and 2^-31, or 0.
  double tiny() {
    const std::uint32_t power = below(33);
    return power == 32 ? 0 : std::ldexp(1.0, -static_cast<int>(power));
  }

  Vec3 point() {
    const bool is_coarse = below(3) == 0;
    const auto number = [&] { return is_coarse ? coarse() : fine(); };
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }

  Vec3 tiny_point() {
    const Vec3 at = point();
    return at * tiny();
  }

private:
  std::span<const std::uint8_t> bytes_;
};

} // namespace hemicube::test
