// The weights of hemicube pixels against their closed-form integrals, and the elementary functions
// they are made of against long double libm.

#include "radiosity/elementary.h"
#include "radiosity/hemicube/delta_form_factors.h"
#include "tests/support/drawn_face.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hemicube::test {
namespace {

using radiosity::DeltaFormFactors;
using radiosity::kFormFactorUnit;
using raster::Face;

constexpr long double kPi = std::numbers::pi_v<long double>;

/// Form factor of the rectangle (0,0)-(x,y) of the top face, at height 1 over the receiver.
/// Source: the double integral of 1 / (pi (u^2 + v^2 + 1)^2).
long double top_integral(long double x, long double y) {
  const long double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * kPi);
}

/// Form factor of the rectangle (0,0)-(x,z) of a side, z up from the horizon: the double integral
/// of w / (pi (u^2 + w^2 + 1)^2).
long double side_integral(long double x, long double z) {
  const long double a = std::sqrt(1 + z * z);
  return (std::atan(x) - std::atan(x / a) / a) / (2 * kPi);
}

/// The exact weight of a pixel in units of 2^-48.
long double exact_weight(Face face, std::uint32_t resolution, std::int32_t i, std::int32_t j) {
  const long double step = 2.0L / resolution;
  const long double x0 = -1 + i * step, x1 = x0 + step;
  const auto integral = face == Face::kTop ? top_integral : side_integral;
  const long double y0 = (face == Face::kTop ? -1 : 0) + j * step, y1 = y0 + step;
  return (integral(x1, y1) - integral(x0, y1) - integral(x1, y0) + integral(x0, y0)) *
         static_cast<long double>(kFormFactorUnit);
}

class Resolutions : public testing::TestWithParam<std::uint32_t> {};

// Catches: weights from pixel centres (their sum is off by 0.5 / resolution^2), and any wrong
// integral.
TEST_P(Resolutions, EachWeightIsTheIntegralOverItsPixel) {
  DeltaFormFactors weights;
  require(weights.init(GetParam()));
  EXPECT_EQ(weights.resolution(), GetParam());
  const auto n = static_cast<std::int32_t>(GetParam());
  const std::int32_t stride = n > 256 ? n / 128 - 1 : 1; // all rows below 256, some above
  for (const Face face : kFaces)
    for (std::int32_t j = 0; j < (face == Face::kTop ? n : n / 2); j += stride)
      for (std::int32_t i = 0; i < n; ++i) {
        const auto weight = static_cast<long double>(weights.weight(face, i, j));
        ASSERT_LE(std::fabs(weight - exact_weight(face, GetParam(), i, j)), 2.0L)
            << "face " << static_cast<int>(face) << ", pixel (" << i << ", " << j << ")";
      }
}

// Catches: a hemicube whose parts do not make a whole, so that closed rooms gain or lose light.
TEST_P(Resolutions, TheWholeHemicubeIsExactlyOne) {
  DeltaFormFactors weights;
  require(weights.init(GetParam()));
  std::uint64_t sum = 0;
  for (const Face face : kFaces) {
    const auto grid = raster::hemicube_grid(face, GetParam());
    const auto sums = weights.sums(face);
    ASSERT_EQ(sums.size(),
              static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height) + 1);
    for (std::size_t k = 1; k < sums.size(); ++k)
      ASSERT_GE(sums[k], sums[k - 1]) << "a weight is negative";
    sum += sums.back() - sums.front();
  }
  EXPECT_EQ(sum, kFormFactorUnit);
}

// Catches: running sums that drift: a run must be as good as a pixel.
TEST_P(Resolutions, RunsAreAsExactAsPixels) {
  DeltaFormFactors weights;
  require(weights.init(GetParam()));
  const auto n = static_cast<std::int32_t>(GetParam());
  for (const Face face : kFaces) {
    const auto sums = weights.sums(face);
    const std::int32_t height = face == Face::kTop ? n : n / 2;
    const long double step = 2.0L / GetParam();
    for (std::int32_t j = 1; j <= height; j += height / 8) {
      // All rows below j: the rectangle (-1, y0) .. (1, y_j), twice its right half by symmetry.
      const auto integral = face == Face::kTop ? top_integral : side_integral;
      const long double y0 = face == Face::kTop ? -1 : 0;
      const long double exact = 2 * (integral(1, y0 + j * step) - integral(1, y0)) *
                                static_cast<long double>(kFormFactorUnit);
      const auto rows = static_cast<std::size_t>(j) * static_cast<std::size_t>(n);
      EXPECT_LE(std::fabs(static_cast<long double>(sums[rows] - sums[0]) - exact), 2.0L)
          << "face " << static_cast<int>(face) << ", rows below " << j;
    }
  }
}

// Catches: transposed or shifted tables.
TEST_P(Resolutions, WeightsAreSymmetricToTwoUnits) {
  DeltaFormFactors weights;
  require(weights.init(GetParam()));
  const auto n = static_cast<std::int32_t>(GetParam());
  const auto near = [](std::uint64_t a, std::uint64_t b) { return (a > b ? a - b : b - a) <= 2; };
  for (std::int32_t j = 0; j < n / 2; ++j)
    for (std::int32_t i = 0; i < n; ++i) {
      const std::uint64_t top = weights.weight(Face::kTop, i, j);
      ASSERT_TRUE(near(top, weights.weight(Face::kTop, n - 1 - i, j)) &&
                  near(top, weights.weight(Face::kTop, i, n - 1 - j)) &&
                  near(top, weights.weight(Face::kTop, j, i)))
          << "top (" << i << ", " << j << ")";
      const std::uint64_t side = weights.weight(Face::kPlusX, i, j);
      ASSERT_TRUE(near(side, weights.weight(Face::kPlusX, n - 1 - i, j)))
          << "side (" << i << ", " << j << ")";
      for (const Face face : {Face::kMinusX, Face::kPlusY, Face::kMinusY})
        ASSERT_EQ(side, weights.weight(face, i, j)) << "sides must be alike";
    }
}

INSTANTIATE_TEST_SUITE_P(, Resolutions,
                         testing::Values(16, 18, 50, 64, 200, 256, 512, 1000, 1024, 2046, 2048));

// Catches: a resolution the tables cannot represent, taken without a word.
TEST(DeltaFormFactors, BadResolutionsAreRefusedByValue) {
  for (const std::uint32_t bad : {0u, 1u, 14u, 15u, 17u, 255u, 2049u, 2050u, 4096u, 0xfffffffeu}) {
    DeltaFormFactors weights;
    const Status status = weights.init(bad);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << bad;
    EXPECT_NE(std::string(status.message()).find(std::to_string(bad)), std::string::npos)
        << status.message();
  }
}

/// |x - exact| in units of the last place of exact.
long double ulps(double x, long double exact) {
  const double magnitude = std::fabs(static_cast<double>(exact));
  const double unit =
      std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude;
  return std::fabs(static_cast<long double>(x) - exact) / static_cast<long double>(unit);
}

// Catches: a polynomial of too low a degree, bad joints between ranges, lost signs.
TEST(Elementary, ArctangentIsWithinTwoUlps) {
  Random random(48);
  long double worst = 0;
  const auto check = [&](double x) {
    const double y = radiosity::arctangent(x);
    worst = std::max(worst, ulps(y, std::atan(static_cast<long double>(x))));
    ASSERT_LE(worst, 2.0L) << "arctangent(" << x << ") = " << y;
    ASSERT_EQ(radiosity::arctangent(-x), -y);
  };
  for (int i = 0; i < 200000; ++i) {
    check(random.between(0, 1));
    check(random.between(0, 8));
    check(std::ldexp(1 + random.unit(), static_cast<int>(random.index(200)) - 100));
  }
  for (const double joint :
       {0.0625, 0.125, 0.25, 0.4375, 0.5, 0.6875, 0.75, 1.0, 1.1875, 2.0, 2.4375, 4.0, 8.0, 16.0,
        0.41421356237309503, 2.414213562373095, 0.2679491924311227})
    for (double x = joint * (1 - 1e-14), end = joint * (1 + 1e-14); x <= end;
         x = std::nextafter(x, 2 * joint))
      check(x);
  RecordProperty("worst_ulps", std::to_string(static_cast<double>(worst)));
}

// Catches: 0 * infinity, overflow of a square, a lost sign of zero.
TEST(Elementary, ArctangentAtTheEndsOfTheRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double half_pi = std::atan(kInfinity);
  EXPECT_EQ(radiosity::arctangent(0.0), 0.0);
  EXPECT_TRUE(std::signbit(radiosity::arctangent(-0.0)));
  EXPECT_EQ(radiosity::arctangent(kInfinity), half_pi);
  EXPECT_EQ(radiosity::arctangent(-kInfinity), -half_pi);
  EXPECT_EQ(radiosity::arctangent(1e308), half_pi);
  EXPECT_EQ(radiosity::arctangent(1e-308), 1e-308);
  EXPECT_EQ(radiosity::arctangent(5e-324), 5e-324);
  EXPECT_TRUE(std::isnan(radiosity::arctangent(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(radiosity::kPi, static_cast<double>(kPi));
}

} // namespace
} // namespace hemicube::test
