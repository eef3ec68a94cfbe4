// Adaptive meshing: what must not change, what must not be cut, and whether it helps.

#include "radiosity/output/element_table.h"
#include "tests/analytic/adaptive_support.h"
#include "tests/support/reference.h"

#include <cstdio>

namespace hemicube::test {
namespace {

void expect_same_solution(const radiosity::Solution& a, const radiosity::Solution& b) {
  EXPECT_TRUE(same_bits(a.radiosity.span(), b.radiosity.span()));
  EXPECT_TRUE(same_bits(a.irradiance.span(), b.irradiance.span()));
  EXPECT_TRUE(same_bits(a.row_sum.span(), b.row_sum.span()));
  EXPECT_TRUE(same_bits(a.space.span(), b.space.span()));
  EXPECT_TRUE(same_bits(a.back_side.span(), b.back_side.span()));
}

// Catches: rows, backs or black patches that take another way through the matrix of elements; a
// scale that is fitted again where nothing was divided.
TEST(Adaptive, WhereNothingIsCutTheSolutionIsThatOfTheScene) {
  const Scene scenes[] = {shadow_room(), cornell_like(4), t_vertex_room()};
  for (const Scene& scene : scenes)
    for (const Rung rung : {Rung::kHemicube, Rung::kArea}) {
      const Options options = on_rung(rung);
      const Solved expected = solve(scene, options, 2);
      Adapted adapted;
      adapt(scene, limits(1e9), options, &adapted);
      ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
      EXPECT_EQ(adapted.report.rounds, 0u);
      EXPECT_EQ(adapted.report.end, RefinementEnd::kVariation);
      EXPECT_EQ(adapted.report.elements, expected.patches.patch_count());
      EXPECT_EQ(adapted.report.rows_gathered, expected.patches.patch_count());
      expect_same_solution(adapted.solution, expected.solution);
      EXPECT_EQ(adapted.certificate.radiosity_hash, expected.certificate.radiosity_hash);
      EXPECT_EQ(adapted.certificate.form_factor_hash, expected.certificate.form_factor_hash);
      EXPECT_EQ(adapted.certificate.scene_hash, expected.certificate.scene_hash);
      EXPECT_EQ(adapted.certificate.hemicubes, expected.certificate.hemicubes);
    }
}

// Catches: noise of pixels, closure or sharing that looks like light that varies; light that is
// lost or made where elements meet.
TEST(Adaptive, UniformLightIsNeverCut) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.two_sided(grey);
  builder.box({grey, grey, grey, grey, grey, grey}, {0, 0, 0}, {1, 1, 1}, {2, 2, 2}, true);
  builder.grid(grey, {0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.75, 0.75, 0.5}, {0.25, 0.75, 0.5}, 2,
               2);
  // The outsides of the box see space, and are as bright as it is.
  Scene scene = builder.finish();
  scene.space_exitance[0] = 2;
  for (const Rung rung : {Rung::kHemicube, Rung::kArea}) {
    Options options = on_rung(rung, 32);
    options.tolerance = 1e-12;
    Adapted adapted;
    adapt(scene, limits(1e-3), options, &adapted);
    ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
    EXPECT_EQ(adapted.report.rounds, 0u) << "variation " << adapted.report.largest_variation;
    EXPECT_EQ(adapted.elements.patch_count(), 56u);
    for (const double b : adapted.solution.radiosity)
      EXPECT_NEAR(b, 2, 1e-9);
  }
}

// The same light on elements that were cut all the same, as the patches' sides have no neighbours.
// Catches: rows of elements that do not sum to 1, backs that get the rows of fronts.
TEST(Adaptive, UniformLightStaysUniformOnElements) {
  const Scene scene = furnace_cube(1, 0.5, 1);
  Options options = on_rung(Rung::kHemicube);
  options.tolerance = 1e-12;
  Adapted adapted;
  adapt(scene, limits(0.1, 1e-3), options, &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_EQ(adapted.elements.patch_count(), 24u) << "walls of one patch are looked at once";
  for (const double b : adapted.solution.radiosity)
    EXPECT_NEAR(b, 2, 1e-9);
}

// Catches: what depends on which thread gathers or divides a row, kernels that differ.
TEST(Adaptive, BitsAreTheSameForAllThreadsAndKernels) {
  const Scene scene = shadow_room();
  const Refinement refinement = limits(0.4, 0.05, 200);
  Adapted expected;
  Options options = on_rung(Rung::kHemicube);
  adapt(scene, refinement, options, &expected, 1);
  ASSERT_TRUE(expected.status.ok()) << expected.status.message();
  EXPECT_GT(expected.report.rounds, 1u);
  for (const std::uint32_t threads : {2u, 3u, 7u})
    for (const raster::Kernels* kernels :
         {raster::kernels_by_name("scalar"), static_cast<const raster::Kernels*>(nullptr)}) {
      options.kernels = kernels;
      Adapted adapted;
      adapt(scene, refinement, options, &adapted, threads);
      expect_same_solution(adapted.solution, expected.solution);
      EXPECT_EQ(radiosity::element_table(adapted.tree), radiosity::element_table(expected.tree));
      EXPECT_EQ(adapted.report.largest_variation, expected.report.largest_variation);
    }
}

// Catches: a mean over black surfaces, too: with a large one that no light reaches the variation
// would be many times as large.
TEST(Adaptive, VariationIsInUnitsOfWhatReflectingSurfacesReflect) {
  Adapted adapted[2];
  Scene scenes[2];
  for (const bool has_black : {false, true}) {
    SceneBuilder builder(1);
    const std::uint32_t grey = builder.material("grey", 0.5, 0);
    const std::uint32_t lamp = builder.material("lamp", 0.5, 1);
    const std::uint32_t black = builder.material("black", 0, 0);
    builder.grid(grey, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
    builder.grid(lamp, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, 2, 2);
    if (has_black) // below the floor, turned away
      builder.face(black, {{-9, -9, -9}, {-9, 9, -9}, {9, 9, -9}, {9, -9, -9}});
    scenes[has_black] = builder.finish();
    adapt(scenes[has_black], limits(0.5, 0.05), on_rung(Rung::kHemicube), &adapted[has_black]);
    ASSERT_TRUE(adapted[has_black].status.ok()) << adapted[has_black].status.message();
  }
  EXPECT_GT(adapted[0].report.rounds, 0u);
  EXPECT_EQ(radiosity::element_table(adapted[0].tree) + "8,\n",
            radiosity::element_table(adapted[1].tree));
  EXPECT_NEAR(adapted[0].report.largest_variation, adapted[1].report.largest_variation, 1e-3);
}

// Catches: elements cut after the pixels of one point.
TEST(Adaptive, TheRungChosenIsNoLowerThanArea) {
  const Scene scene = shadow_room();
  Options options;
  options.choose_rung = options.choose_resolution = options.estimate_error = true;
  options.error = 0.5;
  ASSERT_LT(solve(scene, options, 2).certificate.setting.rung, Rung::kArea);
  Adapted adapted;
  adapt(scene, limits(0.5, 0.1), options, &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_EQ(adapted.certificate.setting.rung, Rung::kArea);
  EXPECT_TRUE(adapted.certificate.has_radiosity_error);
  EXPECT_LT(adapted.certificate.radiosity_error, 0.1);
}

// Catches: lengths in metres where they should be in sizes of the scene; a chosen min_edge that is
// none; hashes and orders that depend on coordinates.
TEST(Adaptive, CutsDoNotDependOnTheUnitOrThePlace) {
  const Options options = on_rung(Rung::kHemicube, 64);
  const Refinement refinement = limits(0.4, 0, 150);
  const Scene unit = shadow_room();
  Adapted expected;
  adapt(unit, refinement, options, &expected);
  ASSERT_TRUE(expected.status.ok()) << expected.status.message();
  EXPECT_GT(expected.report.rounds, 1u);
  const std::string table = radiosity::element_table(expected.tree);
  for (const double scale : {0x1p-20, 0x1p20}) {
    const Scene scene = shadow_room(scale);
    Adapted adapted;
    adapt(scene, refinement, options, &adapted);
    ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
    EXPECT_EQ(radiosity::element_table(adapted.tree), table) << "scale " << scale;
    expect_same_solution(adapted.solution, expected.solution);
    EXPECT_EQ(adapted.report.limits.min_edge, scale * expected.report.limits.min_edge);
  }
  const Scene scene = shadow_room(1, {1024, -512, 2048});
  Adapted adapted;
  adapt(scene, refinement, options, &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_EQ(radiosity::element_table(adapted.tree), table) << "moved";
}

// Catches: light that is lost or made by dividing rows among elements.
TEST(Adaptive, EnergyOfClosedRoomsBalances) {
  SceneBuilder builder(1);
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.2, 10);
  builder.box({wall, wall, wall, lamp, wall, wall}, {0, 0, 0}, {2, 1, 1}, {4, 2, 2}, true);
  const struct {
    Scene scene;
    double bound; ///< partly visible pairs of rung area are not reciprocal: patches alone: 4.8e-3
  } cases[] = {{builder.finish(), 1e-6}, {shadow_room(), 2e-3}};
  for (const auto& [scene, bound] : cases) {
    Options options = on_rung(Rung::kArea, 128);
    options.tolerance = 1e-10;
    Adapted adapted;
    adapt(scene, limits(0.2, 0.05, 400), options, &adapted);
    ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
    EXPECT_GT(adapted.elements.patch_count(), 300u);
    ASSERT_EQ(adapted.certificate.energy.size(), 1u);
    EXPECT_NEAR(adapted.certificate.energy[0].imbalance, 0, bound);
    for (const double space : adapted.solution.space)
      EXPECT_LE(space, 1e-6);
  }
}

/// Area-weighted RMS error of the means over faces against the continuous solution.
double face_error(const Scene& scene, const PatchSet& mesh, const radiosity::Solution& solution,
                  const nlohmann::json& truth) {
  std::vector<double> area(scene.face_count()), mean(scene.face_count() * solution.band_count);
  for (std::uint32_t e = 0; e < mesh.patch_count(); ++e) {
    area[mesh.face[e]] += mesh.area[e];
    for (std::uint32_t b = 0; b < solution.band_count; ++b)
      mean[mesh.face[e] * solution.band_count + b] +=
          mesh.area[e] * solution.radiosity[e * std::size_t{solution.band_count} + b];
  }
  for (std::size_t k = 0; k < mean.size(); ++k)
    mean[k] /= area[k / solution.band_count];
  return deviation(mean, truth, area).area_rms;
}

// Catches: elements that are cut where it does not help, or send out light as coarsely as before.
TEST(Adaptive, TwiceTheElementsHalveTheError) {
  const Scene scene = reference_scene("scenes/tableroom_a.coarse.obj");
  const auto truth = reference_json("scenes/tableroom_a.truth.json")["coarse"]["B"];
  const Options options = on_rung(Rung::kArea, 128);
  const Solved patches = solve(scene, options, 2);
  const double before = face_error(scene, patches.patches, patches.solution, truth);
  Adapted adapted;
  adapt(scene, limits(0.01, 0, 2 * patches.patches.patch_count()), options, &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  const double after = face_error(scene, adapted.elements, adapted.solution, truth);
  std::printf("error of %u patches %.2e, of %u elements %.2e\n", patches.patches.patch_count(),
              before, adapted.elements.patch_count(), after);
  EXPECT_LT(after, before / 2);
}

} // namespace
} // namespace hemicube::test
