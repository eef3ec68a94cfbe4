// Lines 31 to 42 of README.md: the linear system, and meshes.

#include "radiosity/adaptive.h"
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "radiosity/output/vertex_radiosity.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/analytic/adaptive_support.h"
#include "tests/hard_cases/hard_case.h"
#include "tests/support/one_point.h"
#include "tests/support/shadow_rooms.h"
#include "tests/support/sound_mesh.h"

#include <array>

namespace hemicube::test {
namespace {

/// Relative to the truth, every patch and band.
double largest_error(const Solved& solved, const nlohmann::json& truth) {
  return deviation(solved.solution.radiosity.span(), truth, solved.patches.area.span()).largest;
}

Options with_tolerance(Options options, double tolerance) {
  options.tolerance = tolerance;
  return options;
}

double off_one(double low, double high) {
  return std::max(high - 1, 1 - low);
}

// What rows sum to before closure is an error of form factors: rung area promises nothing where
// patches are partly hidden, rung adaptive what it is asked for.
// Catches: rows that make light, of which a room of reflectance 0.999999 makes a million times as
// much.
TEST(HardCase, L31_RowSums) {
  for (const std::string name : {"furnace_cube", "furnace_lroom", "furnace_boxes",
                                 "furnace_icosphere2", "furnace_cube_0999999"}) {
    const Scene scene = reference_scene("enclosures/" + name + ".obj");
    const bool is_convex = name != "furnace_lroom" && name != "furnace_boxes";
    for (const LadderLevel& level : {kHemicubeRung, kAreaRung, kLooseRung}) {
      const Solved solved = solve(scene, with_tolerance(level.options(64), 1e-9));
      const Buffer<double>& sums = solved.solution.row_sum;
      const auto [low, high] = std::minmax_element(sums.begin(), sums.end());
      const std::string what = name + ", " + level.name;
      expect_within(what, off_one(*low, *high), 1e-12);
      const radiosity::Range& raw = solved.certificate.row_sum_raw;
      if (is_convex || level.rung == Rung::kHemicube)
        expect_within(what + ", raw", off_one(raw.min, raw.max), 1e-4);
      if (name == "furnace_cube_0999999") {
        double worst = 0;
        for (const double radiosity : solved.solution.radiosity)
          worst = std::max(worst, std::fabs(radiosity - 1));
        expect_within(what + ", B", worst, 1e-4);
      }
    }
  }
  FormFactors factors;
  compute_all(patches_of(reference_scene("enclosures/furnace_lroom.obj")), kTightRung.options(), 2,
              &factors);
  const radiosity::Range& raw = factors.certificate.row_sum_raw;
  expect_within(std::string("furnace_lroom, ") + kTightRung.name + ", raw",
                off_one(raw.min, raw.max), 1e-4);
}

/// max |A_i F_ij - A_j F_ji| / min(A_i, A_j) of all pairs, less the same of other form factors.
double reciprocity(const PatchSet& patches, const std::vector<double>& f,
                   const std::vector<double>& other) {
  const std::size_t n = patches.patch_count();
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double there = f[i * n + j] - other[i * n + j], back = f[j * n + i] - other[j * n + i];
      largest = std::max(largest, std::fabs(patches.area[i] * there - patches.area[j] * back) /
                                      std::min(patches.area[i], patches.area[j]));
    }
  return largest;
}

std::vector<double> all_factors(const PatchSet& patches, const Options& options) {
  FormFactors factors;
  compute_all(patches, options, 2, &factors);
  std::vector<double> all;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    const std::vector<double> row = factors.dense_row(i);
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

// Form factors from one point are not reciprocal, however exact: in cube_mixed by 1.1e-2. So pure
// ones are compared with those. Catches: what pixels do to one row and not to the other; columns by
// reciprocity that make a small patch receive more than there is.
TEST(HardCase, L32_Reciprocity) {
  for (const std::string name : {"cube_mixed", "sphere_l2_2"}) {
    const PatchSet patches = patches_of(reference_scene("enclosures/" + name + ".obj"));
    const std::vector<double> pure = all_factors(patches, kHemicubeRung.options(kHardResolution));
    expect_within(name + ", hemicube", reciprocity(patches, pure, one_point_form_factors(patches)),
                  2e-3);
    const std::vector<double> none(pure.size(), 0.0);
    expect_within(name + ", area",
                  reciprocity(patches, all_factors(patches, kAreaRung.options()), none), 2e-3);
  }
  const Scene table = reference_scene("scenes/tableroom_a.coarse.obj");
  const PatchSet patches = patches_of(table);
  const std::vector<double> adaptive = all_factors(patches, kLooseRung.options());
  expect_within("tableroom_a, adaptive at 0.3",
                reciprocity(patches, adaptive, std::vector<double>(adaptive.size(), 0.0)), 2e-3);

  const auto imbalance = [&](const Options& options) {
    double largest = 0;
    const Solved solved = solve(table, options);
    for (const radiosity::EnergyBalance& energy : solved.certificate.energy)
      largest = std::max(largest, std::fabs(energy.absorbed / energy.emitted - 1));
    return largest;
  };
  Options options = with_tolerance(kHemicubeRung.options(128), 1e-9);
  options.solver = radiosity::SolverKind::kProgressive;
  options.stop_unshot = 1e-7;
  expect_within("tableroom_a, power, hemicube by shooting", imbalance(options), 1e-6);
  options.solver = radiosity::SolverKind::kGaussSeidel;
  options.balance = true;
  expect_within("tableroom_a, power, hemicube balanced", imbalance(options), 1e-6);
}

// Catches: a solver that stops on the residual, when the error is up to 1/(1 - rho) as large.
TEST(HardCase, L33_NearlyWhite) {
  const Scene scene = reference_scene("enclosures/sphere_l1_4.obj");
  const auto truth =
      reference_case("enclosures.json", "sphere_l1_4")["truth"]["patch_B_polyhedron"];
  for (const LadderLevel& level : kAreaRungs)
    expect_within(level.name, largest_error(solve(scene, level.options()), truth), 1e-3);
  Options options = kAreaRung.options();
  options.solver = radiosity::SolverKind::kJacobi;
  const Solved jacobi = solve(scene, options);
  expect_within("area, Jacobi", largest_error(jacobi, truth), 1e-3);
  options.solver = radiosity::SolverKind::kProgressive;
  options.balance = true;
  expect_within("area, progressive", largest_error(solve(scene, options), truth), 1e-3);
}

// Catches: shooting that loses light, or stops on what is unshot.
TEST(HardCase, L34_GatheringAndShootingAgree) {
  const Scene scene = cornell_like(4);
  Options options = with_tolerance(kHemicubeRung.options(64), 1e-11);
  options.balance = true;
  const Solved gathered = solve(scene, options);
  options.solver = radiosity::SolverKind::kProgressive;
  options.stop_unshot = 1e-10;
  const Solved shot = solve(scene, options);
  expect_within(
      "hemicube, balanced",
      largest_relative(shot.solution.radiosity.span(), gathered.solution.radiosity.span()), 1e-8);
}

// Catches: bands that leak into each other, and B = E + 0 H that is not E.
TEST(HardCase, L35_BandsAreIndependent) {
  Scene scene = furnace_cube(2, 0.5, 1);
  scene.exitance[1] = 0;    // g: reflects, and is dark
  scene.reflectance[2] = 0; // b: lit, and black
  for (const LadderLevel& level : {kHemicubeRung, kAreaRung, kAdaptiveRung}) {
    const Solved solved = solve(scene, level.options(64));
    for (std::uint32_t p = 0; p < solved.patches.patch_count(); ++p) {
      EXPECT_EQ(solved.radiosity(p, 1), 0.0) << level.name << ", patch " << p;
      EXPECT_EQ(solved.radiosity(p, 2), 1.0) << level.name << ", patch " << p;
    }
  }
  const auto truth = reference_case("enclosures.json", "disconnected")["truth"]["group_B"];
  const Scene apart = reference_scene("enclosures/disconnected.obj");
  for (const LadderLevel& level : {kHemicubeRung, kAreaRung, kAdaptiveRung}) {
    const Solved solved = solve(apart, with_tolerance(level.options(), 1e-11));
    double largest = 0;
    for (std::uint32_t p = 0; p < solved.patches.patch_count(); ++p)
      for (std::uint32_t band = 0; band < 3; ++band) {
        const double exact = truth[std::string(apart.materials[solved.patches.material[p]])][band];
        const double error = std::fabs(solved.radiosity(p, band) - exact);
        largest = std::max(largest, exact > 0 ? error / exact : error);
      }
    expect_within(std::string("disconnected, ") + level.name, largest, 1e-9);
  }
}

/// The spread of B, relative to the brightest, among patches whose places in the cube are the same
/// but for turns about its vertical axis and mirrors.
double asymmetry(const Solved& solved) {
  std::map<std::array<long, 3>, std::pair<double, double>> ranges;
  for (std::uint32_t p = 0; p < solved.patches.patch_count(); ++p) {
    const Vec3 centre = solved.patches.centre[p];
    const auto round = [](double x) { return std::lround(1024 * x); };
    long x = std::abs(round(centre.x - 0.5)), y = std::abs(round(centre.y - 0.5));
    if (x > y)
      std::swap(x, y);
    const double value = solved.radiosity(p, 0);
    auto& range = ranges.try_emplace({x, y, round(centre.z)}, value, value).first->second;
    range = {std::min(range.first, value), std::max(range.second, value)};
  }
  double largest = 0, brightest = 0;
  for (const auto& [place, range] : ranges) {
    largest = std::max(largest, range.second - range.first);
    brightest = std::max(brightest, range.second);
  }
  return largest / brightest;
}

// Catches: hemicubes that see more one way than another; an order of sums that shows.
TEST(HardCase, L36_Symmetry) {
  for (const LadderLevel& level : {kHemicubeRung, kAnalyticRung, kAreaRung, kAdaptiveRung})
    expect_within(level.name,
                  asymmetry(solve(cube8(), with_tolerance(level.options(kHardResolution), 1e-13))),
                  level.rung == Rung::kHemicube ? 1e-4 : 1e-12);
}

// Catches: a solver that loses positivity, clamps, or mixes up bands: (I - rho F)^-1 is a sum of
// non-negative terms, so more reflectance or exitance anywhere lowers no radiosity anywhere.
TEST(HardCase, L37_Monotone) {
  const Options options = with_tolerance(kHemicubeRung.options(64), 1e-13);
  const Solved base = solve(cornell_like(8), options);
  const std::uint32_t materials = cornell_like(8).materials.size();
  for (std::uint32_t m = 0; m < materials; ++m)
    for (const bool reflect : {true, false}) {
      Scene scene = cornell_like(8);
      double& value = reflect ? scene.reflectance[m * 3 + 1] : scene.exitance[m * 3 + 1];
      value = reflect ? value * 1.01 : value * 1.01 + 0.01;
      const Solved more = solve(scene, options);
      double gain = 0;
      for (std::uint32_t p = 0; p < base.patches.patch_count(); ++p) {
        EXPECT_GE(more.radiosity(p, 1), base.radiosity(p, 1) * (1 - 1e-12)) << "patch " << p;
        gain += more.radiosity(p, 1) - base.radiosity(p, 1);
        for (const std::uint32_t other : {0u, 2u})
          EXPECT_NEAR(more.radiosity(p, other), base.radiosity(p, other),
                      1e-12 * base.radiosity(p, other))
              << "another band changed";
      }
      EXPECT_GT(gain, 0) << "material " << m;
    }
}

// Catches: a solver that stops before the light has come round the last bend.
TEST(HardCase, L38_LongChains) {
  const Scene scene = reference_scene("scenes/corridor_a.coarse.obj");
  const auto truth = reference_json("scenes/corridor_a.truth.json")["coarse_constant_element_B"];
  for (const LadderLevel& level : {kHemicubeRung, kAreaRung, kLooseRung}) {
    const Solved solved = solve(scene, level.options());
    const Buffer<double>& radiosity = solved.solution.radiosity;
    const double darkest = *std::min_element(radiosity.begin(), radiosity.end());
    EXPECT_GT(darkest, 0.0) << level.name;
    EXPECT_LT(darkest, 1e-4) << level.name << ": the end must be dark";
    if (level.rung == Rung::kAdaptive)
      expect_within(level.name, largest_error(solved, truth), 0.1);
  }
}

// Two plates that meet at 10 degrees: the light at their edge changes ever more on the way to it,
// by as much across any element beside it, however small. Catches: refinement that does not end
// there, or ends elsewhere; cracks at the T-vertices that it makes.
TEST(HardCase, L39_AdaptiveSubdivisionEnds) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.8, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.8, 1);
  const double c = 0.984807753012208, s = 0.17364817766693033;
  builder.grid(lamp, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
  builder.grid(grey, {0, 0, 0}, {0, 1, 0}, {c, 1, s}, {c, 0, s}, 2, 2);
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

  Adapted room;
  const Scene closed = shadow_room();
  adapt(closed, limits(0.2), on_rung(Rung::kArea), &room);
  ASSERT_TRUE(room.status.ok()) << room.status.message();
  EXPECT_GT(room.elements.patch_count(), 2 * room.patches.patch_count());
  expect_within("space in a closed room", room.certificate.space.max, 1e-6);
}

// Catches: light that crosses the edge of a room; 0/0 at vertices without a lit neighbour.
/// A table of four legs on a floor of one face, in the middle under a lamp.
Scene table_under_lamp(double scale) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0, 100);
  builder.face(grey, {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  builder.face(lamp, {{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}});
  for (const double x : {-0.7, 0.6})
    for (const double y : {-0.5, 0.4})
      add_box(&builder, grey, {x, y, 0}, {Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0, 0, 0.7)});
  add_box(&builder, grey, {-0.75, -0.55, 0.7},
          {Vec3(1.5, 0, 0), Vec3(0, 1.1, 0), Vec3(0, 0, 0.05)});
  return scaled(builder.finish(), scale);
}

// Catches: contacts beside the edges of what touches; snapping that depends on the unit; cuts
// without length, and many through one point.
TEST(HardCase, L40_DiscontinuityMeshing) {
  PatchSet unscaled;
  double worst = 0;
  for (const double scale : {1.0, 0x1p-20, 0x1p20, 1e-6, 1e6}) {
    const Scene scene = table_under_lamp(scale);
    const PatchSet patches = fronts_of(scene);
    PatchSet elements;
    std::vector<radiosity::DiscontinuityLine> lines;
    radiosity::DiscontinuityReport report;
    require(radiosity::cut_discontinuities(scene, patches, {}, &elements, &lines, &report));
    expect_sound(patches, elements);
    double outline = 0, feet = 0;
    for (std::uint32_t e = 0; e < elements.patch_count() && elements.parent[e] == 0; ++e) {
      const Vec3 centre = elements.centre[e] / scale;
      if (std::fabs(std::fabs(centre.x) - 0.65) < 0.05 &&
          std::fabs(std::fabs(centre.y) - 0.45) < 0.05)
        feet += elements.area[e] / (scale * scale);
      const auto corners = elements.corners_of(e);
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (elements.light_across(elements.corner_offsets[e] + k) == radiosity::EdgeLight::kJumps)
          outline += glm::length(elements.vertices[corners[(k + 1) % corners.size()]] -
                                 elements.vertices[corners[k]]) /
                     scale;
    }
    worst = std::max({worst, std::fabs(outline / (2 * 16 * 0.1) - 1), std::fabs(feet / 0.04 - 1)});
    if (scale == 1) {
      unscaled = std::move(elements);
      continue;
    }
    ASSERT_EQ(elements.patch_count(), unscaled.patch_count()) << scale;
    ASSERT_EQ(elements.corners.size(), unscaled.corners.size()) << scale;
    for (std::size_t k = 0; k < elements.corners.size() && (scale == 0x1p-20 || scale == 0x1p20);
         ++k)
      ASSERT_EQ(elements.vertices[elements.corners[k]],
                scale * unscaled.vertices[unscaled.corners[k]]);
  }
  expect_within("contacts, relative", worst, 1e-9);
}

TEST(HardCase, L41_DisplayValues) {
  const PatchSet patches = patches_of(furnace_cube(4, 0.5, 1));
  std::vector<double> radiosity;
  for (const Vec3& normal : patches.normal)
    radiosity.push_back(normal.y > 0.5 ? 1 : 0); // the floor is lit, the walls are dark
  Buffer<float> corners;
  require(radiosity::vertex_radiosities(patches, radiosity, 1, &corners));
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1];
         ++c)
      EXPECT_EQ(corners[c], radiosity[patch]);

  SceneBuilder builder(1); // a block stands on the middle of a floor: its 2 x 2 patches are dark
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.grid(grey, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, 4, 4);
  const PatchSet floor = patches_of(builder.finish());
  std::vector<double> light;
  for (const Vec3& centre : floor.centre)
    light.push_back(std::fabs(centre.x - 2) < 1 && std::fabs(centre.y - 2) < 1 ? 0 : 1);
  require(radiosity::vertex_radiosities(floor, light, 1, &corners));
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec3& place = floor.vertices[floor.corners[c]];
    EXPECT_TRUE(corners[c] >= 0 && corners[c] <= 2) << place.x << ", " << place.y;
    if (place.x == 2 && place.y == 2) {
      EXPECT_EQ(corners[c], 0.0f) << "under the block";
    }
  }
}

/// Patch means of a room cut finer, from exact form factors.
std::vector<double> means_of_finer(const Scene& scene, const PatchSet& coarse, double max_edge) {
  PatchSet fine;
  radiosity::MeshReport report;
  const std::vector<double> edges(coarse.patch_count(), max_edge);
  require(radiosity::subdivide(coarse, edges, &fine, &report));
  radiosity::ThreadPool pool;
  require(pool.init(2));
  radiosity::Solution solution;
  radiosity::Certificate certificate;
  require(radiosity::solve_scene(scene, fine, kAreaRung.options(), pool, nullptr, &solution,
                                 &certificate));
  std::vector<double> means(coarse.patch_count() * 3, 0.0);
  for (std::uint32_t p = 0; p < fine.patch_count(); ++p)
    for (std::uint32_t band = 0; band < 3; ++band)
      means[fine.parent[p] * 3 + band] +=
          fine.area[p] / coarse.area[fine.parent[p]] * solution.radiosity[p * 3 + band];
  return means;
}

// Catches: errors of form factors that pass for those of the mesh, and the other way round.
TEST(HardCase, L42_MeshAndFormFactors) {
  for (const auto& [name, edge] : {std::pair("cube_mixed", 0.25), std::pair("room_bleed", 1.0)}) {
    const Scene scene = reference_scene(std::string("enclosures/") + name + ".obj");
    const auto truth = reference_case("enclosures.json", name)["truth"];
    for (const LadderLevel& level : kAreaRungs)
      expect_within(std::string(name) + ", " + level.name,
                    largest_error(solve(scene, level.options()), truth["constant_element_patch_B"]),
                    1e-3);
    const PatchSet coarse = patches_of(scene);
    const auto mesh_error = [&](double max_edge) {
      return deviation(means_of_finer(scene, coarse, max_edge), truth["continuous_patch_B"],
                       coarse.area.span())
          .area_rms;
    };
    const double errors[] = {mesh_error(edge), mesh_error(edge / 2), mesh_error(edge / 4)};
    for (const int k :
         {0, 1}) // an order of 1.5 or more: what is left of the error is 2^-1.5 or less
      expect_within(name + std::string(", the mesh, halved ") + std::to_string(k + 1) + "x",
                    errors[k + 1] / errors[k], std::sqrt(0.125));
  }
}

} // namespace
} // namespace hemicube::test
