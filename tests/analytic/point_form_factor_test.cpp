// Rows of one hemicube against Lambert's exact point-to-polygon form factor, case by case: near,
// far, thin, grazing, straddling the horizon, blocked.

#include "radiosity/hemicube/five_views.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/support/form_factor_cases.h"
#include "tests/support/lambert.h"
#include "tests/support/one_point.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

/// Values are floats with one scale a row ...
constexpr double kStorage = 1e-7;
/// ... made of counts of 2^-48.
constexpr double kCount = 1e-14;

/// The bound for a polygon and whatever stands before it.
double bound_of(const raster::View& view, std::span<const Vec3> polygon,
                std::span<const std::vector<Vec3>> blockers, std::uint32_t resolution) {
  double bound = aliasing_bound(view, polygon, resolution);
  for (const auto& blocker : blockers)
    bound += aliasing_bound(view, blocker, resolution);
  return bound;
}

// The formula of the tests themselves, against the 20-digit references.
TEST(Lambert, FormulaAgreesWithTheReference) {
  for (const nlohmann::json& one : form_factor_cases(true)) {
    const double exact =
        lambert_form_factor(point_of(one["P1"][0]), point_of(one["normal1"]), facing_polygon(one));
    const double expected = one["F12"];
    EXPECT_NEAR(exact, expected, 1e-12 * expected) << one["name"];
  }
  EXPECT_LE(largest_aliasing_bound(256), 3.5 / 256);
}

// Catches: rows at points in a wrong frame; everything the row of a patch can have wrong.
TEST(PointFormFactors, AreThoseOfTheReferenceUpToPixels) {
  for (const nlohmann::json& one : form_factor_cases(true)) {
    const std::string name = one["name"];
    const radiosity::Receiver receiver{point_of(one["P1"][0]), point_of(one["normal1"])};
    const std::vector<Vec3> front = facing_polygon(one);
    const std::vector<Vec3> back(front.rbegin(), front.rend());
    SceneBuilder facing, averted;
    facing.face(facing.material("grey", 0.5, 1), front);
    averted.face(averted.material("grey", 0.5, 1), back);
    const PatchSet patches = patches_of(facing.finish()), turned = patches_of(averted.finish());
    for (const std::uint32_t resolution : {64u, 256u, 1024u}) {
      radiosity::Options options;
      options.resolution = resolution;
      radiosity::FormFactorMatrix matrix, behind;
      radiosity::Certificate certificate;
      radiosity::SerialExecutor serial;
      require(radiosity::compute_point_form_factors(patches, {&receiver, 1}, options, serial,
                                                    nullptr, &matrix, &certificate));
      require(radiosity::compute_point_form_factors(turned, {&receiver, 1}, options, serial,
                                                    nullptr, &behind, &certificate));
      const double actual = entry(matrix.row(0), 0), expected = one["F12"];
      const double bound = aliasing_bound(
          radiosity::hemicube_view(receiver.position, receiver.normal), front, resolution);
      EXPECT_NEAR(actual, expected, bound + kStorage * expected + kCount)
          << name << " at " << resolution;
      EXPECT_NEAR(matrix.row(0).space, 1 - actual, 1e-15);
      // The same polygon turned over receives nothing, and blocks as much.
      EXPECT_EQ(entry(behind.row(0), 0), 0.0) << name;
      EXPECT_NEAR(behind.row(0).back_side, actual, 1e-7 * actual) << name;
      std::printf("%s at %u: F %.9g, exact %.9g, error %.2e, bound %.2e\n", name.c_str(),
                  resolution, actual, expected, actual - expected, bound);
    }
  }
}

// From the centre of P1 to P2 and back, past the blockers.
// Catches: clipping at the horizon, near planes, far and thin polygons drawn too large, wrong
// winners.
TEST(PairFormFactors, AreThePointFormFactorsUpToPixels) {
  for (const std::uint32_t resolution : {64u, 256u, 1024u}) {
    double squares = 0, largest = 0;
    int count = 0;
    for (const nlohmann::json& one : form_factor_cases(false)) {
      const CasePatches made(one);
      radiosity::Options options;
      options.resolution = resolution;
      FormFactors factors;
      compute_all(made.patches, options, 1, &factors);
      for (const std::uint32_t from : {0u, 1u}) {
        const std::uint32_t to = 1 - from;
        const auto polygon = corners_of(made.patches, to);
        const Vec3 centre = made.patches.centre[from], normal = made.patches.normal[from];
        const double actual = entry(factors.matrix.row(from), to);
        const double exact = blocked_form_factor(centre, normal, polygon, made.blockers);
        const double bound = bound_of(radiosity::hemicube_view(made.patches, from), polygon,
                                      made.blockers, resolution);
        EXPECT_NEAR(actual, exact, bound + kStorage * exact + kCount)
            << one["name"] << ", from P" << from + 1 << " at " << resolution;
        squares += (actual - exact) * (actual - exact);
        largest = std::max(largest, std::fabs(actual - exact));
        ++count;
      }
    }
    std::printf("pairs at %u: RMS error %.2e, largest %.2e of %d\n", resolution,
                std::sqrt(squares / count), largest, count);
  }
}

} // namespace
} // namespace hemicube::test
