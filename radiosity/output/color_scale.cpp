#include "radiosity/output/color_scale.h"

#include "radiosity/elementary.h"

#include <charconv>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// A number n * 10^exponent.
struct Decimal {
  std::int64_t n;
  int exponent;

  /// The nearest double up to 10^22, where powers of ten are exact, and close to it beyond.
  double value() const noexcept {
    double power = 1;
    for (int k = exponent < 0 ? -exponent : exponent; k > 0; --k)
      power *= 10;
    const auto whole = static_cast<double>(n);
    return exponent < 0 ? whole / power : whole * power;
  }
};

/// Pixels are floats: what is so little above a round number is that number.
constexpr double kRounding = 1 - 1e-6;

/// The largest k whose power of ten is at most x > 0.
int decade(double x) noexcept {
  int k = static_cast<int>(std::floor(logarithm(x) / logarithm(10)));
  if (Decimal{1, k}.value() > x) // the logarithm is rounded
    --k;
  if (Decimal{1, k + 1}.value() <= x)
    ++k;
  return k;
}

/// The largest of 1, 2, 5 times a power of ten that is at most x, or the smallest at least x.
Decimal nice_below(double x) noexcept {
  const int k = decade(x);
  for (const int n : {5, 2})
    if (Decimal{n, k}.value() <= x)
      return {n, k};
  return {1, k};
}
Decimal nice_above(double x) noexcept {
  const Decimal below = nice_below(x);
  if (below.value() >= x)
    return below;
  if (below.n == 5)
    return {1, below.exponent + 1};
  return {below.n == 1 ? 2 : 5, below.exponent};
}

/// A round number at or up to a quarter above x > 0.
double multiple_above(double x) noexcept {
  const Decimal step = nice_below(x / 4);
  const auto count = static_cast<std::int64_t>(std::ceil(x / step.value() * kRounding));
  return Decimal{count * step.n, step.exponent}.value();
}

/// Writes a number plainly with as many decimals as its power of ten, or as 1.5e-7.
void write(Decimal number, char* out) noexcept {
  char digits[24];
  const bool is_negative = number.n < 0;
  const auto magnitude = static_cast<std::uint64_t>(is_negative ? -number.n : number.n);
  const auto count = static_cast<int>(std::to_chars(digits, digits + 24, magnitude).ptr - digits);
  if (is_negative)
    *out++ = '-';
  const auto put = [&](int from, int to) {
    for (int k = from; k < to; ++k)
      *out++ = k >= 0 && k < count ? digits[k] : '0';
  };
  constexpr int kMostPlain = 6;
  const int before = count + number.exponent; // digits before the point
  if (magnitude == 0) {
    *out++ = '0';
  } else if (number.exponent >= 0 && before <= kMostPlain) {
    put(0, before);
  } else if (number.exponent < 0 && -number.exponent < kMostPlain && before <= kMostPlain) {
    put(before > 0 ? 0 : before - 1, before);
    *out++ = '.';
    put(before, count);
  } else {
    put(0, 1);
    int last = count;
    while (last > 1 && digits[last - 1] == '0')
      --last;
    if (last > 1)
      *out++ = '.';
    put(1, last);
    *out++ = 'e';
    out = std::to_chars(out, out + 8, before - 1).ptr;
  }
  *out = '\0';
}

/// Adds a tick if it lies on the scale and there is room.
struct TickList {
  const ColorScale& scale;
  std::size_t most;
  Tick* ticks;
  std::size_t count = 0;

  void add(Decimal number) noexcept {
    const double value = number.value();
    if (value < scale.min || value > scale.max || count == most)
      return;
    ticks[count].value = value;
    write(number, ticks[count].digits);
    ++count;
  }
};

/// Ticks at equal distances.
void add_multiples(TickList* list) noexcept {
  const auto [min, max, is_log] = list->scale;
  // n steps make n + 1 ticks.
  const Decimal step = nice_above((max - min) / static_cast<double>(list->most - 1) * kRounding);
  const double first = std::ceil(min / step.value()), last = std::floor(max / step.value());
  constexpr double kMostDigits = 1e15;
  if (!(std::fabs(first) < kMostDigits && std::fabs(last) < kMostDigits))
    return;
  for (auto k = static_cast<std::int64_t>(first) - 1; k <= static_cast<std::int64_t>(last) + 1; ++k)
    list->add({k * step.n, step.exponent});
}

/// Ticks at 1, 2, 5 times powers of ten; at powers alone, or at some of them, where these are too
/// many.
void add_powers(TickList* list) noexcept {
  const int low = decade(list->scale.min), high = decade(list->scale.max);
  const int most = static_cast<int>(list->most);
  const bool has_between = 3 * (high - low + 1) <= most;
  const int stride = (high - low + most) / most;
  for (int k = low; k <= high; k += stride)
    for (const int n : {1, 2, 5})
      if (n == 1 || has_between)
        list->add({n, k});
}

} // namespace

double ColorScale::share(double value) const noexcept {
  if (!(value > min))
    return 0;
  if (value >= max)
    return 1;
  if (!is_log)
    return (value - min) / (max - min);
  return (logarithm(value) - logarithm(min)) / (logarithm(max) - logarithm(min));
}

double shown_value(const Picture& picture, std::size_t pixel) noexcept {
  return luminance_at(picture, pixel) * (picture.samples * picture.samples) / picture.hits[pixel];
}

Status choose_scale(const Picture& picture, bool is_log, ColorScale* scale) {
  constexpr double kDecades = 1e4, kRare = 0.01, kSmallest = 1e-30;
  Buffer<double> lit;
  HC_TRY(lit_pixels(picture, &lit));
  const double high = lit.empty() ? 0 : quantile(&lit, 1 - kRare);
  if (!(high > kSmallest)) {
    *scale = {0, 1, false};
    return is_log ? Status::error(StatusCode::kInvalidArgument,
                                  "nothing in the picture is above 0, where a logarithmic scale of "
                                  "colours has to start; use a linear one")
                  : Status();
  }
  *scale = {0, is_log ? nice_above(high * kRounding).value() : multiple_above(high), is_log};
  if (is_log) { // half of the top leaves a scale where all is the same
    const double low = max_number(quantile(&lit, kRare), scale->max / kDecades);
    scale->min = nice_below(min_number(low, scale->max / 2) / kRounding).value();
  }
  return {};
}

std::size_t make_ticks(const ColorScale& scale, std::size_t most, Tick* ticks) noexcept {
  HC_ASSERT(most >= 3 && most <= kMostTicks);
  TickList list{scale, most, ticks};
  if (scale.is_log)
    add_powers(&list);
  if (list.count >= 2)
    return list.count;
  list.count = 0;
  add_multiples(&list);
  return list.count;
}

} // namespace hemicube::radiosity
