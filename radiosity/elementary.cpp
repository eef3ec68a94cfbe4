#include "radiosity/elementary.h"

namespace hemicube::radiosity {
namespace {

struct TwoPart {
  double high, low;
};

// arctan(k/8), k = 0..8, in two parts.
constexpr TwoPart kArctangentOfEighths[9] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};
constexpr TwoPart kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// arctan(t) - t for |t| <= 1/16, from its Taylor series: the first term left out is 2^-60 of t.
double series_beyond_linear(double t) {
  const double u = t * t;
  double sum = -1.0 / 15;
  sum = sum * u + 1.0 / 13;
  sum = sum * u - 1.0 / 11;
  sum = sum * u + 1.0 / 9;
  sum = sum * u - 1.0 / 7;
  sum = sum * u + 1.0 / 5;
  sum = sum * u - 1.0 / 3;
  return t * (u * sum);
}

/// arctan(x) for 0 <= x <= 1: arctan(c) + arctan((x - c) / (1 + x c)) with c the nearest eighth.
TwoPart arctangent_to_one(double x) {
  const int eighth = static_cast<int>(x * 8 + 0.5);
  const double c = eighth * 0.125;
  const double t = (x - c) / (1 + x * c);
  const TwoPart base = kArctangentOfEighths[eighth];
  if (eighth == 0)
    return {t, series_beyond_linear(t)};
  return {base.high, base.low + (series_beyond_linear(t) + t)};
}

/// Cosine and sine of 0 <= x <= pi/4: Taylor, the first term left out is below 2^-58.
Turn turn_by(double x) {
  const double u = x * x;
  double cosine = 0, sine = 0;
  for (int k = 16; k >= 2; k -= 2) {
    cosine = (1 + cosine) * (-u / ((k - 1) * k));
    sine = (1 + sine) * (-u / (k * (k + 1)));
  }
  return {1 + cosine, x + x * sine};
}

} // namespace

Turn turn_of(std::uint32_t numerator, std::uint32_t denominator) noexcept {
  // Whole eighths of a turn, and what is left of the next one.
  const std::uint64_t n = denominator, eighths = 8 * std::uint64_t{numerator % denominator};
  const std::uint64_t octant = eighths / n;
  const std::uint64_t rest = octant % 2 == 0 ? eighths % n : n - eighths % n;
  const double part = static_cast<double>(rest) / static_cast<double>(n);
  const Turn small = turn_by(part * (kHalfPi.high / 2));
  const Turn first = // within the quarter, counted from its nearer axis
      octant % 2 == 0 ? small : Turn{small.sine, small.cosine};
  switch (octant / 2) {
  case 0:
    return first;
  case 1:
    return {-first.sine, first.cosine};
  case 2:
    return {-first.cosine, -first.sine};
  default:
    return {first.sine, -first.cosine};
  }
}

double arctangent(double x) noexcept {
  if (!(x <= 1 && x >= -1)) {
    if (x != x)
      return x;
    const double magnitude = x < 0 ? -x : x;
    const TwoPart inverse = arctangent_to_one(1 / magnitude);
    const double value = kHalfPi.high - (inverse.high - (kHalfPi.low - inverse.low));
    return x < 0 ? -value : value;
  }
  if (x == 0)
    return x; // also -0
  const TwoPart value = arctangent_to_one(x < 0 ? -x : x);
  return x < 0 ? -(value.high + value.low) : value.high + value.low;
}

} // namespace hemicube::radiosity
