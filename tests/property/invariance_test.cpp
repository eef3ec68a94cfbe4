// Form factors on every rung as functions of shapes alone: not of place, size, turn, the order of
// faces, vertices and corners, nor of which hand the axes have.

#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/hemicube/five_views.h"
#include "tests/support/ladder_levels.h"
#include "tests/support/ladder_scenes.h"
#include "tests/support/lambert.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemicube::test {
namespace {

constexpr std::uint32_t kResolution = 256;

/// What a form factor may change by where nothing but rounding changes: the ulp of a float entry,
/// and this.
constexpr double kRounding = 1e-9;

/// A pixel whose centre is on an edge but for rounding may change hands: 2e-5 each at 256.
constexpr double kFewPixels = 1e-4;

/// Coordinates of 1e6 are rounded by up to r = 6e-11. Who moves the corners of two polygons by r
/// moves their contour integral (1 / 2 pi) of ln r by r * perimeter * (1 + ln(perimeter / r)) / pi:
/// for polygons of 0.05 that is 5e-10, and 2e-7 of their area.
constexpr double kFar = 1e-6;

/// What no point of a cell shows may still be there: cells that carry less than a tenth of a target
/// of 0.01 of a form factor need not be cut (form_factor/ladder_setup.cpp).
constexpr double kUnseen = 2e-3;

/// Where entries come from.
enum class Source : std::uint8_t {
  kPixels,    ///< pixels, or visible shares counted in pixels
  kIntegrals, ///< nothing hides anything: formulas alone
  kPoints,    ///< visible shares from a few points, which depend on the first corner of a patch
  kTarget     ///< visible shares integrated to the target of the rung
};

struct Case {
  const char* name;
  LadderLevel level;
  PolygonList (*make)();
  Source source;
  int blockers = 0; ///< convex things that can be in front of a patch: of Source::kPixels
};
void PrintTo(const Case& made, std::ostream* out) {
  *out << made.name;
}

const Case kCases[] = {
    {"t_vertices_hemicube", kHemicubeRung, t_vertices, Source::kPixels},
    {"t_vertices_analytic", kAnalyticRung, t_vertices, Source::kIntegrals},
    {"t_vertices_area", kAreaRung, t_vertices, Source::kIntegrals},
    {"t_vertices_adaptive", kAdaptiveRung, t_vertices, Source::kIntegrals},
    {"l_room_hemicube", kHemicubeRung, l_shaped, Source::kPixels, 1},
    {"l_room_analytic", kAnalyticRung, l_shaped, Source::kPixels, 1},
    {"l_room_area", kAreaRung, l_shaped, Source::kPoints},
    {"l_room_adaptive", kAdaptiveRung, l_shaped, Source::kTarget},
    {"open_hemicube", kHemicubeRung, open_scene, Source::kPixels, 2},
    {"open_analytic", kAnalyticRung, open_scene, Source::kPixels, 2},
    {"open_area", kAreaRung, open_scene, Source::kPoints},
    {"open_loose", kLooseRung, open_scene, Source::kTarget},
    {"open_adaptive", kAdaptiveRung, open_scene, Source::kTarget},
    {"soup_hemicube", kHemicubeRung, random_soup, Source::kPixels, 23},
    {"soup_analytic", kAnalyticRung, random_soup, Source::kPixels, 23},
    {"soup_area", kAreaRung, random_soup, Source::kPoints},
    {"soup_loose", kLooseRung, random_soup, Source::kTarget},
    {"soup_adaptive", kAdaptiveRung, random_soup, Source::kTarget},
    {"tiny_exact", kExactRung, tiny_scene, Source::kTarget},
};

using Order = std::vector<std::uint32_t>;

Order ascending(std::size_t count) {
  Order order(count);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

Order shuffled_order(std::size_t count, std::uint32_t seed) {
  Order order = ascending(count);
  Random random(seed);
  for (std::size_t k = count; k > 1; --k)
    std::swap(order[k - 1], order[random.index(static_cast<std::uint32_t>(k))]);
  return order;
}

/// Each polygon seen in a mirror: x negated, and the way around turned so that fronts stay fronts.
PolygonList mirrored(PolygonList polygons) {
  for (Polygon& polygon : polygons) {
    std::reverse(polygon.begin(), polygon.end());
    for (Vec3& corner : polygon)
      corner.x = -corner.x;
  }
  return polygons;
}

/// Each polygon from its second corner on.
PolygonList from_another_corner(PolygonList polygons) {
  for (Polygon& polygon : polygons)
    polygon = turned(std::move(polygon), 1);
  return polygons;
}

/// One patch per polygon; corners at one place are one vertex.
Scene with_shared_vertices(const PolygonList& polygons) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  for (const Polygon& polygon : polygons)
    builder.face(grey, polygon);
  return builder.finish();
}

/// The same scene with its vertices in another order.
Scene with_renumbered_vertices(Scene scene) {
  const Order order = shuffled_order(scene.vertices.size(), 3);
  const std::vector<Vec3> old(scene.vertices.begin(), scene.vertices.end());
  Order number(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    scene.vertices[k] = old[order[k]];
    number[order[k]] = k;
  }
  for (std::uint32_t& corner : scene.corners)
    corner = number[corner];
  return scene;
}

class Invariance : public testing::TestWithParam<Case> {
protected:
  void SetUp() override {
    polygons_ = GetParam().make();
    patches_ = patches_of(polygons_);
    compute(patches_, &reference_);
  }

  void compute(const PatchSet& patches, FormFactors* factors) const {
    compute_all(patches, GetParam().level.options(kResolution), 2, factors);
  }

  /// What the target allows a form factor to be off by: a share of what would be seen with nothing
  /// in between. Two rows that are may differ by twice that.
  double target_tolerance(std::uint32_t i, std::uint32_t j) const {
    const auto of = [&](std::uint32_t k) { return radiosity::ConvexPolygon(polygons_[k]); };
    const double whole =
        radiosity::exchange_area(of(i), patches_.normal[i], of(j), patches_.normal[j], 1e-5).value;
    const double target =
        GetParam().level.rung == radiosity::Rung::kExact ? 1e-6 : GetParam().level.error;
    return 2 * target * whole / patches_.area[i];
  }

  /// Of hemicubes that see the same with other pixels. A row of pixels sees a polygon as one run,
  /// and each thing in front of it may make it one more.
  double pixel_tolerance(std::uint32_t i, std::uint32_t j) const {
    return 2 * (1 + GetParam().blockers) *
           aliasing_bound(radiosity::hemicube_view(patches_, i), polygons_[j], kResolution);
  }

  /// Expects the reference's rows. @param tolerance  double(i, j), of the entry i, j of the
  /// reference, besides the ulp of a float
  /// @param order  face k is face order[k] of the reference
  template <typename Tolerance>
  void expect_same(const PatchSet& patches, const Order& order, Tolerance tolerance) {
    FormFactors factors;
    compute(patches, &factors);
    ASSERT_EQ(factors.matrix.row_count(), order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      const std::vector<double> expected = reference_.dense_row(order[i]);
      const std::vector<double> actual = factors.dense_row(i);
      double sum = 0;
      for (std::uint32_t j = 0; j < order.size(); ++j) {
        const double value = expected[order[j]];
        const double allowed = tolerance(order[i], order[j]) + 0x1p-23 * value;
        EXPECT_NEAR(actual[j], value, allowed) << "from " << order[i] << " to " << order[j];
        sum += allowed;
      }
      const radiosity::RowView a = reference_.matrix.row(order[i]), b = factors.matrix.row(i);
      EXPECT_NEAR(b.space + b.back_side, a.space + a.back_side, sum) << "row " << order[i];
    }
  }
  template <typename Tolerance> void expect_same(const PolygonList& polygons, Tolerance tolerance) {
    expect_same(patches_of(polygons), ascending(polygons.size()), tolerance);
  }

  /// Expects what hemicubes that go along with their patches leave: rounding. It may choose
  /// otherwise whether a cell is cut, which the target allows.
  void expect_moved(const PatchSet& patches, const Order& order, double rounding) {
    switch (GetParam().source) {
    case Source::kPixels:
    case Source::kPoints:
      return expect_same(patches, order, [&](auto, auto) { return kFewPixels; });
    case Source::kTarget:
      return expect_same(patches, order,
                         [&](auto i, auto j) { return rounding + target_tolerance(i, j); });
    case Source::kIntegrals:
      return expect_same(patches, order, [&](auto, auto) { return rounding; });
    }
  }
  void expect_moved(const PolygonList& polygons, double rounding = kRounding) {
    expect_moved(patches_of(polygons), ascending(polygons.size()), rounding);
  }

  /// Expects what is left if hemicubes are turned about their normals.
  void expect_turned(const PolygonList& polygons) {
    if (GetParam().source == Source::kPixels)
      expect_same(polygons, [&](auto i, auto j) { return kFewPixels + pixel_tolerance(i, j); });
    else if (GetParam().source == Source::kTarget)
      expect_same(polygons, [&](auto i, auto j) { return kUnseen + target_tolerance(i, j); });
    else if (GetParam().source == Source::kIntegrals)
      expect_moved(polygons);
  }

  void expect_same_bits(const PatchSet& patches, const char* what) {
    FormFactors factors;
    compute(patches, &factors);
    EXPECT_TRUE(same_bits(reference_.matrix, factors.matrix)) << what;
  }

  PolygonList polygons_;
  PatchSet patches_;
  FormFactors reference_;
};

// Catches: absolute tolerances.
TEST_P(Invariance, PowersOfTwoChangeNoBit) {
  for (const double scale : {0x1p-30, 0x1p-3, 0x1p20})
    expect_same_bits(patches_of(moved(polygons_, scale, {0, 0, 0})), "scaled");
}

// Catches: the same, and decisions that rounding makes.
TEST_P(Invariance, UnitsOfLengthDoNotMatter) {
  for (const double scale : {1e-6, 1e6})
    expect_moved(moved(polygons_, scale, {0, 0, 0}));
}

// Catches: arithmetic on positions rather than differences, tolerances that do not grow with them.
TEST_P(Invariance, FarFromTheOriginLittleChanges) {
  expect_moved(moved(polygons_, 1, {1e6, -1e6, 1e6}), kFar);
}

// Catches: code for walls along axes, and walls that fall apart once their corners are rounded.
TEST_P(Invariance, TurningTheSceneDoesNotMatter) {
  Random random(11);
  for (int k = 0; k < 2; ++k)
    expect_moved(turned(polygons_, random_frame(random)));
}

// Catches: form factors that depend on the numbers of patches.
TEST_P(Invariance, OrderOfFacesOnlyPermutesTheMatrix) {
  const Order order = shuffled_order(polygons_.size(), 5);
  PolygonList permuted;
  for (const std::uint32_t k : order)
    permuted.push_back(polygons_[k]);
  expect_moved(patches_of(permuted), order, kRounding);
}

// Catches: neighbours found by number where position counts; the lowest vertex taken for the first.
TEST_P(Invariance, NumbersOfVerticesChangeNoBit) {
  expect_same_bits(patches_of(with_shared_vertices(polygons_)), "shared");
  expect_same_bits(patches_of(with_renumbered_vertices(with_shared_vertices(polygons_))),
                   "renumbered");
}

// Catches: an orientation that is not handled symmetrically.
TEST_P(Invariance, MirroredScenesHaveTheSameFormFactors) {
  expect_turned(mirrored(polygons_));
}

// Catches: the first corner of a patch taken for more than a direction.
TEST_P(Invariance, AnyCornerMayBeTheFirst) {
  expect_turned(from_another_corner(polygons_));
}

INSTANTIATE_TEST_SUITE_P(, Invariance, testing::ValuesIn(kCases),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace hemicube::test
