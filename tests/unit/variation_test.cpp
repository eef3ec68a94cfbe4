// How much radiosity varies within elements, on meshes where that is known.

#include "radiosity/refine/variation.h"
#include "tests/unit/refine_support.h"

#include <cmath>
#include <functional>

namespace hemicube::test {
namespace {

using Light = std::function<double(const Vec3& centre)>;

/// Of one band, in units of 1 W/m^2, where nothing emits.
std::vector<double> variations(const PatchSet& mesh, const Light& light, double exitance = 0) {
  std::vector<double> radiosity, variation;
  for (const Vec3& centre : mesh.centre)
    radiosity.push_back(light(centre));
  const std::vector<double> emitted(radiosity.size(), exitance), scale{1};
  require(radiosity::find_variation(mesh, radiosity, emitted, scale, &variation));
  return variation;
}

/// A material with 8 x 8 cells in the unit square of z = 0.
PatchSet regular_grid(std::uint32_t second_material_from = 8) {
  SceneBuilder builder(1);
  const std::uint32_t materials[] = {builder.material("one", 0.5, 0),
                                     builder.material("other", 0.5, 0)};
  builder.grid([&](int i, int) { return materials[i >= static_cast<int>(second_material_from)]; },
               {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 8, 8);
  return patches_of(builder.finish());
}

// Catches: a difference that is not divided by the way between the middles, or not multiplied by
// the size; a unit that is not `scale`.
TEST(Variation, OfALinearFieldIsSlopeTimesSize) {
  const PatchSet mesh = regular_grid();
  for (const double v : variations(mesh, [](const Vec3& c) { return 1 + 3 * c.x; }))
    EXPECT_NEAR(v, 3.0 / 8, 1e-15);
  // Across both edges; the steeper one counts.
  for (const double v : variations(mesh, [](const Vec3& c) { return 9 - 2 * c.x - 4 * c.y; }))
    EXPECT_NEAR(v, 4.0 / 8, 2e-15);
}

// Catches: variation where there is none, by which a furnace would be cut.
TEST(Variation, OfAConstantIsZero) {
  for (const double v : variations(regular_grid(), [](const Vec3&) { return 0.7; }))
    EXPECT_EQ(v, 0.0);
}

// Catches: a step that is not seen from both sides, or beyond the elements beside it.
TEST(Variation, OfAStepIsTheStepOnBothSidesOfIt) {
  const PatchSet mesh = regular_grid();
  const auto found = variations(mesh, [](const Vec3& c) { return c.x < 0.5 ? 1.0 : 3.0; });
  for (std::uint32_t e = 0; e < mesh.patch_count(); ++e)
    EXPECT_NEAR(found[e], std::fabs(mesh.centre[e].x - 0.5) < 0.1 ? 2 : 0, 1e-14);
}

// Catches: the edge of a carpet or of a lamp that is taken for a shadow.
TEST(Variation, AnotherMaterialDoesNotCount) {
  const auto found = variations(regular_grid(4), [](const Vec3& c) { return c.x < 0.5 ? 1 : 3.0; });
  for (const double v : found)
    EXPECT_EQ(v, 0.0);
}

// Catches: light that changes at the corner of a room, or from front to back of a screen, which no
// cut will ever change.
TEST(Variation, CornersAndBacksDoNotCount) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.two_sided(grey);
  builder.grid(grey, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
  builder.grid(grey, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, 2, 2);
  // A third plate on the edge, bent by 15 degrees: no longer the same surface.
  builder.grid(grey, {0, 1, 0}, {1, 1, 0}, {1, 1.96, -0.26}, {0, 1.96, -0.26}, 2, 2);
  const Scene scene = builder.finish();
  const PatchSet mesh = patches_of(scene);
  ASSERT_EQ(mesh.patch_count(), 24u);
  std::vector<double> radiosity, variation;
  for (std::uint32_t e = 0; e < 24; ++e)
    radiosity.push_back(1 + e / 4);
  const std::vector<double> none(24, 0), scale{1};
  require(radiosity::find_variation(mesh, radiosity, none, scale, &variation));
  for (std::uint32_t e = 0; e < 24; ++e)
    EXPECT_EQ(variation[e], 0.0) << "element " << e;
}

// Catches: curved walls of flat patches that are not judged at all; backs of such that are not
// connected although fronts use their vertices.
TEST(Variation, GentleBendsCount) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.two_sided(grey);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{1, 0, 0}, {2, 0, 0.1}, {2, 1, 0.1}, {1, 1, 0}});
  const PatchSet mesh = patches_of(builder.finish());
  std::vector<double> variation;
  const std::vector<double> radiosity{1, 4, 1, 3}, none(4, 0), scale{2};
  require(radiosity::find_variation(mesh, radiosity, none, scale, &variation));
  EXPECT_NEAR(variation[0], 1.5, 0.01);
  EXPECT_NEAR(variation[1], 1.5, 0.01);
  EXPECT_NEAR(variation[2], 1.0, 0.01);
  EXPECT_NEAR(variation[3], 1.0, 0.01);
}

// Catches: neighbours of another size that are not found because of the vertices between them, or
// that are judged as if they were of the same size.
TEST(Variation, OfNeighboursOfOtherSizes) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  Cuttable cuttable(builder.finish());
  cuttable.cut(0);
  const PatchSet mesh = cuttable.mesh();
  const auto found = variations(mesh, [](const Vec3& c) { return 2 * c.x; });
  ASSERT_EQ(mesh.patch_count(), 5u);
  // Middles of small ones are 0.5 apart in x; the large one is seen past a corner: by the way over
  // the middle of the common edge, of which the small one has sqrt(1/16), the large sqrt(5/16).
  const double small = 2 * 0.25, large = 2 * std::sqrt(0.3125), step = 2 * 0.75;
  EXPECT_NEAR(found[4], step * large / (small / 2 + large / 2), 1e-12);
  EXPECT_NEAR(found[0], 1, 1e-12);
  EXPECT_NEAR(found[1], std::max(1.0, step * small / (small / 2 + large / 2)), 1e-12);
}

// Catches: a lamp of one patch that is cut because it shines; a lone patch that light falls on and
// that is never looked at more closely.
TEST(Variation, OfALonePatchIsWhatItReflects) {
  SceneBuilder builder(1);
  builder.face(builder.material("lamp", 0.5, 10), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const PatchSet mesh = patches_of(builder.finish());
  EXPECT_EQ(variations(
                mesh, [](const Vec3&) { return 10.0; }, 10),
            std::vector<double>{0});
  EXPECT_EQ(variations(
                mesh, [](const Vec3&) { return 10.5; }, 10),
            std::vector<double>{0.5});
}

// Catches: bands that are added up or mixed up; a dark band that is divided by.
TEST(Variation, TheWorstLitBandCounts) {
  const PatchSet mesh = regular_grid();
  std::vector<double> radiosity, variation;
  for (const Vec3& c : mesh.centre)
    radiosity.insert(radiosity.end(), {1 + c.x, 5 + 8 * c.y, 1e3 * c.x});
  const std::vector<double> none(radiosity.size(), 0), scale{1, 2, 0};
  require(radiosity::find_variation(mesh, radiosity, none, scale, &variation));
  for (const double v : variation)
    EXPECT_NEAR(v, 0.5, 1e-14);
}

// Catches: work that grows with the square of the number of elements on one edge: 10^10 pairs would
// run for minutes.
TEST(Variation, ManyElementsOnOneEdgeDoNotHang) {
  constexpr int kCount = 100000;
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  for (int k = 0; k < kCount; ++k) {
    const double t = 0.01 * k / kCount; // all within a degree: all on the same surface
    builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {0.5, 1, t}});
  }
  const PatchSet mesh = patches_of(builder.finish());
  ASSERT_EQ(mesh.patch_count(), 100000u);
  const auto found = variations(mesh, [](const Vec3& c) { return 1e3 * c.z; });
  EXPECT_GT(*std::max_element(found.begin(), found.end()), 0);
}

} // namespace
} // namespace hemicube::test
