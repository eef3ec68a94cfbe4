// Adaptive meshing: what must not change, what must not be cut, where it ends, and whether it
// helps.

#include "radiosity/adaptive.h"
#include "radiosity/output/element_table.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hemicube::test {
namespace {

using radiosity::Options;
using radiosity::Refinement;
using radiosity::RefinementEnd;
using radiosity::Rung;

struct Adapted {
  PatchSet patches, elements;
  radiosity::ElementTree tree;
  radiosity::Solution solution;
  radiosity::Certificate certificate;
  radiosity::RefinementReport report;
  Status status;
};

/// Fills all of `result`, which keeps to its place: the tree refers to its patches, and to `scene`.
void adapt(const Scene& scene, const Refinement& refinement, const Options& options,
           Adapted* result, std::uint32_t threads = 2) {
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  result->patches = patches_of(scene);
  result->status = radiosity::solve_adaptive(
      scene, result->patches, refinement, options, pool, nullptr, &result->tree, &result->elements,
      &result->solution, &result->certificate, &result->report);
}

Options on_rung(Rung rung, std::uint32_t resolution = 64) {
  Options options;
  options.rung = rung;
  options.resolution = resolution;
  return options;
}

Refinement limits(double variation, double min_edge = 0, std::uint64_t max_elements = 20000) {
  return {variation, min_edge, max_elements};
}

void expect_same_solution(const radiosity::Solution& a, const radiosity::Solution& b) {
  EXPECT_TRUE(same_bits(a.radiosity.span(), b.radiosity.span()));
  EXPECT_TRUE(same_bits(a.irradiance.span(), b.irradiance.span()));
  EXPECT_TRUE(same_bits(a.row_sum.span(), b.row_sum.span()));
  EXPECT_TRUE(same_bits(a.space.span(), b.space.span()));
  EXPECT_TRUE(same_bits(a.back_side.span(), b.back_side.span()));
}

double shortest_edge(const PatchSet& mesh) {
  double shortest = 1e300;
  for (std::uint32_t e = 0; e < mesh.patch_count(); ++e) {
    const auto corners = mesh.corners_of(e);
    for (std::size_t k = 0; k < corners.size(); ++k)
      shortest = std::min(shortest, glm::length(mesh.vertices[corners[k]] -
                                                mesh.vertices[corners[(k + 1) % corners.size()]]));
  }
  return shortest;
}

/// A closed room 2 x 1 x 1 under a lamp of 8 patches, with a two-sided screen in it that throws a
/// shadow; scaled, then moved.
Scene shadow_room(double scale = 1, const Vec3& move = {0, 0, 0}) {
  SceneBuilder builder(1);
  const auto at = [&](double x, double y, double z) { return scale * Vec3(x, y, z) + move; };
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.2, 10);
  const std::uint32_t screen = builder.material("screen", 0.4, 0);
  builder.two_sided(screen);
  const auto box = [&](const Vec3& low, const Vec3& high) {
    builder.box({wall, wall, wall, wall, wall, lamp}, low, high, {4, 2, 2}, true);
  };
  box(at(0, 0, 0), at(2, 1, 1));
  builder.face(
      screen, {at(0.75, 0.25, 0.5), at(1.25, 0.25, 0.5), at(1.25, 0.75, 0.5), at(0.75, 0.75, 0.5)});
  return builder.finish();
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

// Catches: a bound that cuts, or the cuts that even neighbours out, are let past; an end that is
// not told.
TEST(Adaptive, ThereAreNeverMoreElementsThanAllowed) {
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
TEST(Adaptive, LimitsThatMakeNoSenseAreRefused) {
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

// The light at the edge of two plates changes ever more on the way to it: by as much across any
// element beside it, however small. Catches: refinement that does not end there, or ends elsewhere.
TEST(Adaptive, EndsAtTheEdgeOfTwoPlates) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.5, 1);
  builder.grid(grey, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
  builder.grid(lamp, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, 2, 2);
  const Scene scene = builder.finish();
  Adapted adapted;
  adapt(scene, limits(0.3, 0.03), on_rung(Rung::kArea), &adapted);
  ASSERT_TRUE(adapted.status.ok()) << adapted.status.message();
  EXPECT_TRUE(adapted.report.end == RefinementEnd::kMinEdge ||
              adapted.report.end == RefinementEnd::kVariation)
      << radiosity::refinement_end_name(adapted.report.end);
  EXPECT_GT(adapted.elements.patch_count(), 16u);
  EXPECT_LT(adapted.elements.patch_count(), 1000u) << "2048 would be cut evenly";
  const double smallest = shortest_edge(adapted.elements);
  EXPECT_GE(smallest, 0.03);
  EXPECT_LE(smallest, 0.13) << "not refined at the edge";
}

// A slender triangle along a floor that is cut finely. Catches: cuts that even neighbours out
// without a look at min_edge.
TEST(Adaptive, NoCutLeavesAShorterEdgeThanAllowed) {
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
TEST(Adaptive, WithoutReflectedLightNothingIsCut) {
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
TEST(Adaptive, OnePatchIsAScene) {
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
TEST(Adaptive, SurfacesThatMeetAnyhowAreRefined) {
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
