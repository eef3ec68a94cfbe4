// Adaptive meshing: where it ends, and scenes there is little or nothing to cut in.

#include "tests/analytic/adaptive_support.h"

#include <algorithm>
#include <limits>

namespace hemicube::test {
namespace {

// Catches: a bound that cuts, or the cuts that even neighbours out, are let past; an end that is
// not told.
TEST(AdaptiveLimits, ThereAreNeverMoreElementsThanAllowed) {
  const Scene scene = shadow_room();
  const std::uint32_t patches = patches_of(scene).patch_count();
  for (const std::uint32_t more : {0u, 1u, 2u, 3u, 4u, 7u, 20u, 61u, 150u}) {
    Adapted adapted;
    adapt(scene, limits(0.05, 0.01, patches + more), on_rung(Rung::kHemicube, 32), &adapted);
    ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
    EXPECT_LE(adapted.elements.patch_count(), patches + more);
    EXPECT_GE(adapted.elements.patch_count() + 7, patches + more) << "fewer than there is room for";
    EXPECT_EQ(adapted.elements.patch_count(), adapted.report.elements);
    EXPECT_EQ(adapted.report.end, RefinementEnd::kMaxElements);
  }
  Adapted adapted;
  adapt(scene, limits(0.05, 0.01, patches - 1), {}, &adapted);
  EXPECT_EQ(adapted.status.code(), StatusCode::kInvalidArgument);
  EXPECT_NE(adapted.status.message().find(std::to_string(patches)), std::string::npos);
}

// Catches: limits that are compared the wrong way round with NaN.
TEST(AdaptiveLimits, LimitsThatMakeNoSenseAreRefused) {
  const Scene scene = furnace_cube(1, 0.5, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Refinement& refinement :
       {limits(0), limits(-1), limits(nan), limits(infinity), limits(0.1, -1), limits(0.1, nan),
        limits(0.1, infinity), limits(0.1, 0, 0)}) {
    Adapted adapted;
    adapt(scene, refinement, {}, &adapted);
    EXPECT_EQ(adapted.status.code(), StatusCode::kInvalidArgument)
        << refinement.variation << " " << refinement.min_edge << " " << refinement.max_elements;
  }
}

// A slender triangle along a floor that is cut finely. Catches: cuts that even neighbours out
// without a look at min_edge.
TEST(AdaptiveLimits, NoCutLeavesAShorterEdgeThanAllowed) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0, 1);
  builder.face(grey, {{0, -1, 0}, {1, -1, 0}, {1, 0, 0}, {0, 0, 0}});
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {0.02, 0.08, 0}});
  builder.face(lamp, {{0, -1, 0}, {0, 0, 0}, {0, 0, 1}, {0, -1, 1}});
  const Scene scene = builder.finish();
  Adapted adapted;
  adapt(scene, limits(0.1, 0.05), on_rung(Rung::kArea), &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_GT(adapted.elements.patch_count(), 50u);
  EXPECT_GE(shortest_edge(adapted.elements), 0.05);
}

// Catches: division by no light, or by no reflecting area; black surfaces and lamps that are cut.
TEST(AdaptiveLimits, WithoutReflectedLightNothingIsCut) {
  const struct {
    const char* name;
    double reflectance, exitance;
  } cases[] = {{"unlit", 0.5, 0}, {"black", 0, 0}, {"lamps", 0, 3}};
  for (const auto& made : cases) {
    SceneBuilder builder(1);
    const std::uint32_t all = builder.material("all", made.reflectance, made.exitance);
    builder.box({all, all, all, all, all, all}, {0, 0, 0}, {1, 1, 2}, {1, 2, 1}, true);
    const Scene scene = builder.finish();
    Adapted adapted;
    adapt(scene, limits(0.01), on_rung(Rung::kHemicube, 32), &adapted);
    ASSERT_TRUE(adapted.status.ok()) << made.name << ": " << adapted.status.message();
    EXPECT_EQ(adapted.report.rounds, 0u) << made.name;
    EXPECT_EQ(adapted.report.largest_variation, 0) << made.name;
    for (const double b : adapted.solution.radiosity)
      EXPECT_EQ(b, made.exitance) << made.name;
  }
}

// Catches: one patch, whose neighbours and rows are none.
TEST(AdaptiveLimits, OnePatchIsAScene) {
  SceneBuilder builder(1);
  builder.face(builder.material("lamp", 0.5, 4), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Scene scene = builder.finish();
  Adapted adapted;
  adapt(scene, limits(0.01), on_rung(Rung::kArea), &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_EQ(adapted.elements.patch_count(), 1u);
  EXPECT_EQ(adapted.solution.radiosity[0], 4.0);
}

// Catches: edges with three sheets, surfaces that pass through each other: neighbours that are not
// found, elements that are lost, refinement without end.
TEST(AdaptiveLimits, SurfacesThatMeetAnyhowAreRefined) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0, 5);
  const std::uint32_t screen = builder.material("screen", 0.5, 0);
  builder.two_sided(screen);
  builder.grid(grey, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, 2, 1);
  builder.face(screen, {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}); // third on the edge
  builder.face(screen, {{0.5, 0.2, -0.5}, {1.5, 0.2, 0.5}, {1.5, 0.8, 0.5}, {0.5, 0.8, -0.5}});
  builder.face(lamp, {{0, 0, 2}, {0, 1, 2}, {2, 1, 2}, {2, 0, 2}});
  const Scene scene = builder.finish();
  Adapted adapted;
  adapt(scene, limits(0.2, 0.1, 400), on_rung(Rung::kArea, 32), &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_GT(adapted.report.rounds, 0u);
  double actual = 0, expected = 0;
  for (const double area : adapted.elements.area)
    actual += area;
  for (const double area : adapted.patches.area)
    expected += area;
  EXPECT_NEAR(actual, expected, 1e-12);
  for (const double b : adapted.solution.radiosity)
    EXPECT_TRUE(b >= 0 && b <= 5) << b;
}

// Catches: rows of parts that take a patch of more corners than integrals know for one of few, or
// the share of a part for that of the whole.
TEST(AdaptiveLimits, APolygonOfManyCornersIsRefined) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0, 5);
  std::vector<Vec3> disc; // of the unit circle by Pythagorean triples: nothing transcendental
  for (int k = 0; k < 100; ++k) {
    const double t = (k % 50 + 0.5) / 50 * 2 - 1; // half angles -45 .. 45 degrees
    const Vec3 half(1 - t * t, 2 * t, 0);
    disc.push_back((k < 50 ? 1.0 : -1.0) * half / (1 + t * t));
  }
  builder.face(grey, disc);
  builder.face(lamp, {{0, -1, 1}, {0, 1, 1}, {1, 1, 1}, {1, -1, 1}});
  const Scene scene = builder.finish();
  for (const Rung rung : {Rung::kHemicube, Rung::kArea}) {
    Adapted adapted;
    adapt(scene, limits(0.1, 0.02, 200), on_rung(rung), &adapted);
    ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
    ASSERT_EQ(adapted.patches.patch_count(), 2u);
    EXPECT_GT(adapted.elements.patch_count(), 100u);
    for (std::uint32_t e = 0; e < adapted.elements.patch_count(); ++e) {
      const double b = adapted.solution.radiosity[e];
      EXPECT_TRUE(adapted.elements.parent[e] == 1 ? b == 5 : b > 0 && b < 2.5) << b;
    }
  }
}

} // namespace
} // namespace hemicube::test
