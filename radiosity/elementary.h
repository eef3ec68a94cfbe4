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

/// The larger and the smaller of two numbers; where one is NaN, the other: std::fmax and std::fmin
/// without a call into libm.
inline double max_number(double a, double b) noexcept {
  return b > a || a != a ? b : a;
}
inline double min_number(double a, double b) noexcept {
  return b < a || a != a ? b : a;
}

struct Turn {
  double cosine, sine;
};

/// Cosine and sine of numerator / denominator of a full turn, each within 2^-52 of the exact one,
/// and exact at multiples of a quarter. denominator > 0.
Turn turn_of(std::uint32_t numerator, std::uint32_t denominator) noexcept;

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

/// The angle of the vector (x, y) from the x axis for y >= 0, in 0 .. pi, within 2 units in the
/// last place; 0 for (0, 0), pi for (-1, 0). One division and no branch, so that loops over it
/// vectorise. The larger of the two must be 0 or within 2^-960 .. 2^1022.
inline double angle_above(double y, double x) noexcept {
  const double ax = x < 0 ? -x : x;
  const double large = y > ax ? y : ax, small = y > ax ? ax : y;
  // arctan(small / large) = arctan(c) + arctan(t) with c the nearest quarter.
  double c = 0, base_high = 0, base_low = 0;
  c = small > large * 0.125 ? 0.25 : c;
  base_high = small > large * 0.125 ? detail::kArctangentOfQuarters[1][0] : base_high;
  base_low = small > large * 0.125 ? detail::kArctangentOfQuarters[1][1] : base_low;
  c = small > large * 0.375 ? 0.5 : c;
  base_high = small > large * 0.375 ? detail::kArctangentOfQuarters[2][0] : base_high;
  base_low = small > large * 0.375 ? detail::kArctangentOfQuarters[2][1] : base_low;
  c = small > large * 0.625 ? 0.75 : c;
  base_high = small > large * 0.625 ? detail::kArctangentOfQuarters[3][0] : base_high;
  base_low = small > large * 0.625 ? detail::kArctangentOfQuarters[3][1] : base_low;
  c = small > large * 0.875 ? 1.0 : c;
  base_high = small > large * 0.875 ? detail::kArctangentOfQuarters[4][0] : base_high;
  base_low = small > large * 0.875 ? detail::kArctangentOfQuarters[4][1] : base_low;
  const double below = large + c * small;
  const double t = (small - c * large) / (below > 0 ? below : 1.0);
  const double rest = base_low + (detail::arctangent_series(t * t) * t + t);
  // From the nearer axis to the x axis: offset + sign * (base + rest).
  const double turn = x < 0 ? -1.0 : 1.0, sign = y > ax ? -turn : turn;
  double offset_high = x < 0 ? 2 * detail::kHalfPiHigh : 0.0;
  double offset_low = x < 0 ? 2 * detail::kHalfPiLow : 0.0;
  offset_high = y > ax ? detail::kHalfPiHigh : offset_high;
  offset_low = y > ax ? detail::kHalfPiLow : offset_low;
  const double base = sign * base_high, high = offset_high + base;
  return high + (((base - (high - offset_high)) + offset_low) + sign * rest);
}

/// The angle of the vector (x, y) from the x axis, in (-pi, pi], within 2 units in the last place;
/// 0 for (0, 0). Zeros have no sign: pi for (-1, -0). Finite arguments below 2^1022.
inline double arctangent2(double y, double x) noexcept {
  const double ay = y < 0 ? -y : y, ax = x < 0 ? -x : x;
  // Products must not be denormal.
  const double scale = ay < 0x1p-960 && ax < 0x1p-960 ? 0x1p+512 : 1.0;
  const double angle = angle_above(ay * scale, x * scale);
  return y < 0 ? -angle : angle;
}

/// The natural logarithm of a positive normal number, within 2 units in the last place. No branch,
/// so that loops over it vectorise.
inline double logarithm_of_normal(double x) noexcept {
  constexpr std::uint64_t kOne = 0x3ff0000000000000, kSqrtHalf = 0x3fe6a09e667f3bcd;
  constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
  // x = 2^k * m with m in [sqrt(1/2), sqrt(2)).
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (kOne - kSqrtHalf);
  const double m = std::bit_cast<double>((bits & 0x000fffffffffffff) + kSqrtHalf);
  const double k = std::bit_cast<double>((bits >> 52) | 0x4330000000000000) - (0x1p52 + 1023);
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
  return k * kLn2High - ((half - (s * (half + sum * u) + k * kLn2Low)) - f);
}

/// The natural logarithm of x, within 2 units in the last place. 0 gives -infinity, infinity
/// itself, what is below 0 NaN.
inline double logarithm(double x) noexcept {
  if (std::bit_cast<std::uint64_t>(x) - 0x0010000000000000 < 0x7fe0000000000000)
    return logarithm_of_normal(x);
  if (!(x >= 0))
    return std::numeric_limits<double>::quiet_NaN();
  if (x == 0)
    return -std::numeric_limits<double>::infinity();
  return x > 1 ? x : logarithm_of_normal(x * 0x1p54) - 54 * 0x1.62e42fefa39efp-1;
}

} // namespace hemicube::radiosity
