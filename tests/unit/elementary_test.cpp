// The library's own logarithm and two-argument arc tangent against long double libm.

#include "radiosity/elementary.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hemicube::test {
namespace {

using radiosity::arctangent2;
using radiosity::logarithm;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

/// |x - exact| in units of the last place of exact.
long double ulps(double x, long double exact) {
  const double magnitude = std::fabs(static_cast<double>(exact));
  const double unit = std::nextafter(magnitude, kInfinity) - magnitude;
  return std::fabs(static_cast<long double>(x) - exact) / static_cast<long double>(unit);
}

void check_logarithm(double x) {
  ASSERT_LE(ulps(logarithm(x), std::log(static_cast<long double>(x))), 2.0L) << x;
}

void check_arctangent(double y, double x) {
  const double angle = arctangent2(y, x);
  ASSERT_LE(ulps(angle, std::atan2(static_cast<long double>(y), static_cast<long double>(x))), 2.0L)
      << y << ", " << x;
  ASSERT_EQ(arctangent2(-y, x), y == 0 ? angle : -angle);
}

// Catches: a series of too low a degree, cancellation near 1, a bad joint at sqrt(2) 2^k.
TEST(Elementary, LogarithmIsWithinTwoUlps) {
  Random random(11);
  for (int i = 0; i < 200000; ++i) {
    check_logarithm(random.between(0.5, 2));
    check_logarithm(1 + std::ldexp(random.between(-1, 1), -static_cast<int>(random.index(50))));
    check_logarithm(std::ldexp(1 + random.unit(), static_cast<int>(random.index(2098)) - 1074));
  }
  for (const double joint : {0.70710678118654757, 1.0, 1.4142135623730951, 2.0}) {
    double x = joint;
    for (int i = 0; i < 100; ++i)
      x = std::nextafter(x, 0);
    for (int i = 0; i < 200; ++i, x = std::nextafter(x, 4))
      check_logarithm(x);
  }
}

// Catches: denormals read as normal numbers, infinities from finite numbers.
TEST(Elementary, LogarithmAtTheEndsOfTheRange) {
  EXPECT_EQ(logarithm(1), 0.0);
  EXPECT_EQ(logarithm(0), -kInfinity);
  EXPECT_EQ(logarithm(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(logarithm(-1)));
  EXPECT_TRUE(std::isnan(logarithm(std::numeric_limits<double>::quiet_NaN())));
  for (const double x : {kSmallest, 3 * kSmallest, std::numeric_limits<double>::min(),
                         std::nextafter(std::numeric_limits<double>::min(), 0.0),
                         std::numeric_limits<double>::max()})
    check_logarithm(x);
}

// Catches: a wrong octant, bad joints at c + 1/8, digits lost near pi and near the axes.
TEST(Elementary, ArctangentOfTwoIsWithinTwoUlps) {
  Random random(12);
  for (int i = 0; i < 200000; ++i) {
    const double x = random.between(-1, 1), y = random.between(-1, 1);
    check_arctangent(y, x);
    check_arctangent(std::ldexp(y, -static_cast<int>(random.index(100))), x);
    check_arctangent(y, std::ldexp(x, -static_cast<int>(random.index(100))));
  }
  for (const double joint : {0.125, 0.375, 0.625, 0.875, 1.0})
    for (double y = joint * (1 - 1e-14), end = joint * (1 + 1e-14); y <= end;
         y = std::nextafter(y, 2)) {
      check_arctangent(y, 1);
      check_arctangent(1, y);
      check_arctangent(y, -1);
      check_arctangent(1, -y);
    }
}

// Catches: 0/0, a half turn of the wrong sign, underflow of a small ratio.
TEST(Elementary, ArctangentOfTwoOnTheAxes) {
  const double pi = std::numbers::pi;
  EXPECT_EQ(arctangent2(0, 0), 0.0);
  EXPECT_EQ(arctangent2(0, 2), 0.0);
  EXPECT_EQ(arctangent2(0, -2), pi);
  EXPECT_EQ(arctangent2(-0.0, -2), pi);
  EXPECT_EQ(arctangent2(3, 0), pi / 2);
  EXPECT_EQ(arctangent2(-3, 0), -pi / 2);
  EXPECT_EQ(arctangent2(5, 5), pi / 4);
  EXPECT_EQ(arctangent2(kSmallest, 1), kSmallest);
  EXPECT_EQ(arctangent2(kSmallest, kSmallest), pi / 4);
  EXPECT_EQ(arctangent2(1e-300, -1e300), pi);
}

// Catches: a wrong octant or sign, a series too short, axes missed by a rounding.
TEST(Elementary, TurnsAreWithinTheirBound) {
  const long double full = 2 * std::numbers::pi_v<long double>;
  const auto check = [&](std::uint32_t k, std::uint32_t n) {
    const radiosity::Turn turn = radiosity::turn_of(k, n);
    const long double angle = full * (k % n) / n;
    ASSERT_LE(std::fabs(turn.cosine - std::cos(angle)), 0x1p-52L) << k << " of " << n;
    ASSERT_LE(std::fabs(turn.sine - std::sin(angle)), 0x1p-52L) << k << " of " << n;
  };
  for (std::uint32_t n = 1; n <= 400; ++n)
    for (std::uint32_t k = 0; k <= n + 1; ++k)
      check(k, n);
  Random random(13);
  for (int i = 0; i < 20000; ++i)
    check(static_cast<std::uint32_t>(random.index(4294967295u)), 4294967295u);
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
    const radiosity::Turn turn = radiosity::turn_of(quarter, 4);
    EXPECT_EQ(turn.cosine, quarter == 0 ? 1 : quarter == 2 ? -1 : 0);
    EXPECT_EQ(turn.sine, quarter == 1 ? 1 : quarter == 3 ? -1 : 0);
  }
}

} // namespace
} // namespace hemicube::test
