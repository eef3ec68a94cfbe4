#pragma once

#include <bit>
#include <cstdint>
#include <limits>

/// Own elementary functions: only + - * /, because the libm of each system rounds differently.
/// Those of the inner loops are inline.
namespace hemicube::radiosity {

/// pi, rounded to double.
inline constexpr double kPi = 3.14159265358979323846;

/// The arc tangent of x, within 2 units in the last place, odd, -pi/2 .. pi/2. Only + - * /: the
/// libm of each system rounds differently, this does not. NaN gives NaN.
double arctangent(double x) noexcept;

namespace detail {

// arctan(k/4), k = 0..4, in two parts.
inline constexpr double kArctangentOfQuarters[5][2] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};
inline constexpr double kHalfPiHigh = 0x1.921fb54442d18p+0, kHalfPiLow = 0x1.1a62633145c07p-54;

/// (arctan(t) - t) / t for |t| <= 1/8 and u = t*t: Taylor, the first term left out is 2^-56.
inline double arctangent_series(double u) noexcept {
  double sum = 1.0 / 17;
  sum = sum * u - 1.0 / 15;
  sum = sum * u + 1.0 / 13;
  sum = sum * u - 1.0 / 11;
  sum = sum * u + 1.0 / 9;
  sum = sum * u - 1.0 / 7;
  sum = sum * u + 1.0 / 5;
  sum = sum * u - 1.0 / 3;
  return sum * u;
}

} // namespace detail

/// The angle of the vector (x, y) from the x axis, in (-pi, pi], within 2 units in the last place;
/// 0 for (0, 0). Zeros have no sign: pi for (-1, -0). Finite arguments below 2^1022; one division.
inline double arctangent2(double y, double x) noexcept {
  const double ay = y < 0 ? -y : y, ax = x < 0 ? -x : x;
  const bool steep = ay > ax;
  const double large = steep ? ay : ax, small = steep ? ax : ay;
  if (large < 0x1p-960) // products below must not be denormal
    return large == 0 ? 0 : arctangent2(y * 0x1p+512, x * 0x1p+512);
  // arctan(small / large) = arctan(c) + arctan(t) with c the nearest quarter.
  const int quarter = (small > large * 0.125) + (small > large * 0.375) + (small > large * 0.625) +
                      (small > large * 0.875);
  const double c = quarter * 0.25;
  const double t = (small - c * large) / (large + c * small);
  const double* base = detail::kArctangentOfQuarters[quarter];
  double high = base[0], low = base[1] + (detail::arctangent_series(t * t) * t + t);
  if (quarter == 0) {
    high = t;
    low = detail::arctangent_series(t * t) * t;
  }
  if (steep) {
    low = detail::kHalfPiLow - low;
    const double sum = detail::kHalfPiHigh - high;
    low += (detail::kHalfPiHigh - sum) - high;
    high = sum;
  }
  if (x < 0) {
    low = 2 * detail::kHalfPiLow - low;
    const double sum = 2 * detail::kHalfPiHigh - high;
    low += (2 * detail::kHalfPiHigh - sum) - high;
    high = sum;
  }
  const double angle = high + low;
  return y < 0 ? -angle : angle;
}

/// The natural logarithm of x, within 2 units in the last place. 0 gives -infinity, infinity
/// itself, what is below 0 NaN.
inline double logarithm(double x) noexcept {
  constexpr std::uint64_t kOne = 0x3ff0000000000000, kSqrtHalf = 0x3fe6a09e667f3bcd;
  constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
  std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  int exponent = -1023;
  if (bits - 0x0010000000000000 >= 0x7fe0000000000000) { // all but positive normal numbers
    if (!(x >= 0))
      return std::numeric_limits<double>::quiet_NaN();
    if (x == 0)
      return -std::numeric_limits<double>::infinity();
    if (bits == 0x7ff0000000000000)
      return x;
    bits = std::bit_cast<std::uint64_t>(x * 0x1p54);
    exponent -= 54;
  }
  // x = 2^exponent * m with m in [sqrt(1/2), sqrt(2)).
  bits += kOne - kSqrtHalf;
  exponent += static_cast<int>(bits >> 52);
  const double m = std::bit_cast<double>((bits & 0x000fffffffffffff) + kSqrtHalf);
  // log(1+f) = 2 artanh(s) = f - f*f/2 + s (f*f/2 + 2 s*s/3 + 2 s^4/5 + ...), s = f / (2+f).
  const double f = m - 1, s = f / (2 + f), u = s * s, half = 0.5 * f * f;
  double sum = 2.0 / 21;
  sum = sum * u + 2.0 / 19;
  sum = sum * u + 2.0 / 17;
  sum = sum * u + 2.0 / 15;
  sum = sum * u + 2.0 / 13;
  sum = sum * u + 2.0 / 11;
  sum = sum * u + 2.0 / 9;
  sum = sum * u + 2.0 / 7;
  sum = sum * u + 2.0 / 5;
  sum = sum * u + 2.0 / 3;
  const double k = exponent;
  return k * kLn2High - ((half - (s * (half + sum * u) + k * kLn2Low)) - f);
}

} // namespace hemicube::radiosity
