// Unoccluded scenes with known radiosity, judged in two steps: the program against exact form
// factors from the patch centres (their difference is the aliasing of the hemicube's pixels), and
// those against the area form factors of the truth (their difference is the proximity error of one
// point a patch).

#include "radiosity/hemicube/five_views.h"
#include "tests/support/lambert.h"
#include "tests/support/one_point.h"
#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

radiosity::Options at_resolution(std::uint32_t resolution) {
  radiosity::Options options;
  options.resolution = resolution;
  options.tolerance = 1e-10;
  return options;
}

/// @param truth  the key of [patch][band] values made with area form factors, or null
struct Enclosure {
  const char* name;
  const char* truth;
  double aliasing;  ///< bound on the area-weighted RMS error of B against exact point form factors
                    ///< at 256
  double proximity; ///< bound on that of exact point form factors against the truth
};

// Aliasing and proximity: at most twice what was measured once, since neither has a useful closed
// form for B. The entries of F have one and are held to it below.
const Enclosure kConvex[] = {
    {"sphere_l1_1", "patch_B_polyhedron", 3.1e-4, 5e-3},
    {"sphere_l2_2", "patch_B_polyhedron", 3.8e-4, 1.1e-3},
    {"sphere_l1_4", "patch_B_polyhedron", 1.6e-4, 2.4e-3},
    {"cube_mixed", "constant_element_patch_B", 2.2e-4, 4.2e-3},
    {"room_bleed", "constant_element_patch_B", 2.3e-4, 8e-3},
    {"corner_lumped", nullptr, 6.7e-6, 0},
    {"plates_lumped", nullptr, 9.3e-5, 0}, // two patches: one pair's luck with the pixels
    {"plates_wide", nullptr, 3.6e-5, 0},
};

class Convex : public testing::TestWithParam<Enclosure> {};

// Catches: any entry that is off by more than pixels can be: wrong weights, a wrong axis, a shifted
// grid, polygons clipped at a near plane, patches missing at the horizon.
TEST_P(Convex, EveryFormFactorIsThePointFormFactorUpToPixels) {
  const PatchSet patches =
      patches_of(reference_scene(std::string("enclosures/") + GetParam().name + ".obj"));
  const std::uint32_t n = patches.patch_count();
  const std::vector<double> exact = one_point_form_factors(patches);
  for (const std::uint32_t resolution : {64u, 256u, 512u}) {
    FormFactors factors;
    compute_all(patches, at_resolution(resolution), 0, &factors);
    double squares = 0, largest = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::vector<double> row = factors.dense_row(i);
      const raster::View view = radiosity::hemicube_view(patches, i);
      for (std::uint32_t j = 0; j < n; ++j) {
        const double error = std::fabs(row[j] - exact[static_cast<std::size_t>(i) * n + j]);
        const double bound = aliasing_bound(view, corners_of(patches, j), resolution);
        ASSERT_LE(error, bound + 1e-9) << "F(" << i << ", " << j << ") at " << resolution;
        squares += error * error;
        largest = std::max(largest, error);
      }
    }
    const double rms = std::sqrt(squares / n / n);
    std::printf("%s at %u: RMS error of F %.2e, largest %.2e\n", GetParam().name, resolution, rms,
                largest);
    if (resolution == 512) {
      EXPECT_LE(largest, 2.5e-4) << "orientation aliasing";
    }
  }
}

// Catches: a solution that is not the solution of its own form factors; errors that do not fall
// with the resolution.
TEST_P(Convex, RadiosityIsThatOfPointFormFactorsUpToPixels) {
  const Scene scene = reference_scene(std::string("enclosures/") + GetParam().name + ".obj");
  const PatchSet patches = patches_of(scene);
  const std::vector<double> point = solve_dense(scene, patches, one_point_form_factors(patches));
  for (const std::uint32_t resolution : {64u, 256u, 512u}) {
    const Solved solved = solve(scene, at_resolution(resolution));
    const double aliasing = area_rms(patches, solved.solution.radiosity.span(), point);
    std::printf("%s at %u: B against exact point form factors: RMS %.2e, largest %.2e\n",
                GetParam().name, resolution, aliasing,
                largest_relative(solved.solution.radiosity.span(), point));
    if (resolution == 256) {
      EXPECT_LE(aliasing, GetParam().aliasing);
    }
  }
  if (GetParam().truth == nullptr)
    return;
  const auto truth = reference_case("enclosures.json", GetParam().name)["truth"][GetParam().truth];
  const Deviation proximity = deviation(point, truth, patches.area.span());
  const Deviation total = deviation(solve(scene, at_resolution(256)).solution.radiosity.span(),
                                    truth, patches.area.span());
  std::printf("%s: exact point form factors against the truth: RMS %.2e, largest %.2e\n"
              "%s at 256 against the truth: RMS %.2e, largest %.2e\n",
              GetParam().name, proximity.area_rms, proximity.largest, GetParam().name,
              total.area_rms, total.largest);
  EXPECT_LE(proximity.area_rms, GetParam().proximity);
  EXPECT_LE(total.area_rms, GetParam().proximity + GetParam().aliasing);
}

INSTANTIATE_TEST_SUITE_P(, Convex, testing::ValuesIn(kConvex),
                         [](const auto& made) { return std::string(made.param.name); });

// ---------------------------------------------------------------------------------------------------
// A convex body in a convex room: all of the body that faces a patch of the room is seen, and the
// rest of its view is room. So the exact form factor from a patch's centre to the body is a sum of
// Lambert's.

/// The form factor from the centre of every patch of material `room` to all of material `body`; 0
/// for other patches. `bounds` gets what the pixels may make of it.
std::vector<double> point_form_factors_to_body(const Scene& scene, const PatchSet& patches,
                                               std::uint32_t resolution,
                                               std::vector<double>* bounds) {
  const auto material_of = [&](std::uint32_t p) { return scene.materials[patches.material[p]]; };
  std::vector<double> exact(patches.patch_count(), 0.0);
  bounds->assign(patches.patch_count(), 1e-9);
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    for (std::uint32_t j = 0; material_of(i) == "outer" && j < patches.patch_count(); ++j)
      if (material_of(j) == "inner") {
        const std::vector<Vec3> polygon = corners_of(patches, j);
        exact[i] += lambert_form_factor(patches.centre[i], patches.normal[i], polygon);
        (*bounds)[i] += aliasing_bound(radiosity::hemicube_view(patches, i), polygon, resolution);
      }
  return exact;
}

// Catches: black patches whose irradiance is not gathered, or with another row than theirs; an
// inner body that is seen wrongly against the walls behind it.
TEST(NestedBoxes, IrradianceOfTheBlackRoomIsThatOfPointFormFactors) {
  const auto truth = reference_case("enclosures.json", "nested_boxes")["truth"];
  const Scene scene = reference_scene("enclosures/nested_boxes.obj");
  for (const std::uint32_t resolution : {128u, 256u, 512u}) {
    const Solved solved = solve(scene, at_resolution(resolution));
    std::vector<double> bounds;
    const std::vector<double> to_body =
        point_form_factors_to_body(scene, solved.patches, resolution, &bounds);
    for (std::uint32_t band = 0; band < 3; ++band) {
      const double body = truth["group_B"]["inner"][band], room = truth["group_B"]["outer"][band];
      double power = 0, point_power = 0;
      for (std::uint32_t p = 0; p < solved.patches.patch_count(); ++p) {
        if (scene.materials[solved.patches.material[p]] != "outer")
          continue;
        const double exact = to_body[p] * body + (1 - to_body[p]) * room;
        const double irradiance = solved.solution.irradiance[p * 3 + band];
        EXPECT_NEAR(irradiance, exact, bounds[p] * std::fabs(body - room)) << "patch " << p;
        power += solved.patches.area[p] * irradiance;
        point_power += solved.patches.area[p] * exact;
      }
      const double expected = truth["outer_total_incident_power"][band];
      std::printf("nested_boxes at %u, band %u: power to the room, relative to point form factors "
                  "%.2e; those relative to the truth %.2e\n",
                  resolution, band, power / point_power - 1, point_power / expected - 1);
      // Aliasing of single patches averages out over the room.
      EXPECT_NEAR(power, point_power, 3e-4 * point_power) << resolution;
      // A midpoint rule over the patches of the room: measured 2.7e-3.
      EXPECT_NEAR(point_power, expected, 4e-3 * expected);
    }
  }
}

// Two concentric spheres: by symmetry each has one radiosity, and a 2 x 2 system gives it once the
// form factor from the outer to the inner one is known. Catches: wrong visibility between an inner
// body and the walls that see it against each other.
TEST(Shells, MeansAreThoseOfTwoSurfacesWithThePointFormFactor) {
  const auto one = reference_case("enclosures.json", "shells_l2");
  const Scene scene = reference_scene("enclosures/shells_l2.obj");
  for (const std::uint32_t resolution : {64u, 256u, 512u}) {
    const Solved solved = solve(scene, at_resolution(resolution));
    const PatchSet& patches = solved.patches;
    std::vector<double> bounds;
    const std::vector<double> to_body =
        point_form_factors_to_body(scene, patches, resolution, &bounds);
    double outer_area = 0, inner_area = 0, mean = 0;
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
      const bool inner = scene.materials[patches.material[p]] == "inner";
      (inner ? inner_area : outer_area) += patches.area[p];
      mean += inner ? 0 : patches.area[p] * to_body[p];
    }
    const double to_inner = mean / outer_area;
    for (std::uint32_t band = 0; band < 3; ++band) {
      const double rho1 = one["materials"]["inner"]["reflectance"][band];
      const double rho2 = one["materials"]["outer"]["reflectance"][band];
      const double e1 = one["materials"]["inner"]["emission"][band];
      const double e2 = one["materials"]["outer"]["emission"][band];
      // B1 = e1 + rho1 B2,  B2 = e2 + rho2 (F B1 + (1 - F) B2)
      const double outer =
          (e2 + rho2 * to_inner * e1) / (1 - rho2 * (1 - to_inner) - rho2 * to_inner * rho1);
      const double inner = e1 + rho1 * outer;
      double inner_sum = 0, outer_sum = 0;
      for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
        (scene.materials[patches.material[p]] == "inner" ? inner_sum : outer_sum) +=
            patches.area[p] * solved.radiosity(p, band);
      const double smooth_inner = one["truth"]["group_B_smooth"]["inner"][band];
      const double smooth_outer = one["truth"]["group_B_smooth"]["outer"][band];
      const double error1 = inner_sum / inner_area / inner - 1;
      const double error2 = outer_sum / outer_area / outer - 1;
      std::printf(
          "shells_l2 at %u, band %u: means relative to point form factors: inner %.2e, outer "
          "%.2e; those relative to smooth spheres: inner %.2e, outer %.2e\n",
          resolution, band, error1, error2, inner / smooth_inner - 1, outer / smooth_outer - 1);
      if (resolution >= 256) { // measured: 2.5e-4 at most
        EXPECT_NEAR(error1, 0, 5e-4);
        EXPECT_NEAR(error2, 0, 5e-4);
        EXPECT_NEAR(outer, smooth_outer, 1.5e-2 * smooth_outer) << "proximity: measured 8.9e-3";
      }
    }
  }
}

} // namespace
} // namespace hemicube::test
