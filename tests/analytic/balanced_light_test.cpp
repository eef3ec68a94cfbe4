// Options::balance on scenes with known answers: what was exact stays exact, energy closes, and the
// rest is nearer the truth than without.

#include "tests/support/lambert.h"
#include "tests/support/one_point.h"
#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

radiosity::Options balanced(bool balance = true) {
  radiosity::Options options;
  options.balance = balance;
  options.tolerance = 1e-11;
  return options;
}

/// Largest imbalance of all bands, relative.
double imbalance(const Solved& solved) {
  double worst = 0;
  for (const radiosity::EnergyBalance& energy : solved.certificate.energy)
    worst = std::max(worst, std::fabs(energy.imbalance));
  return worst;
}

// Catches: rows that no longer sum to 1 as the solver reads them, reciprocity bought with closure.
TEST(BalancedLight, FurnacesStayExact) {
  for (const std::string name : {"furnace_cube", "furnace_lroom", "furnace_boxes",
                                 "furnace_icosphere2", "furnace_torus", "furnace_cube_0999"}) {
    const auto material = reference_case("enclosures.json", name)["materials"]["all"];
    const Solved solved = solve(reference_scene("enclosures/" + name + ".obj"), balanced());
    double worst = 0;
    for (std::uint32_t patch = 0; patch < solved.patches.patch_count(); ++patch) {
      EXPECT_EQ(solved.solution.space[patch], 0.0) << name << ", patch " << patch;
      for (std::uint32_t band = 0; band < 3; ++band) {
        const double expected = material["emission"][band].get<double>() /
                                (1 - material["reflectance"][band].get<double>());
        worst = std::max(worst, std::fabs(solved.radiosity(patch, band) / expected - 1));
      }
    }
    const radiosity::Certificate& c = solved.certificate;
    std::printf("%s: B off by %.1e at most; reciprocity rms %.1e -> %.1e, RMS change %.1e, closure "
                "%.1e, %llu iterations, imbalance %.1e\n",
                name.c_str(), worst, c.reciprocity_raw.rms, c.reciprocity.rms, c.balance.rms_change,
                c.balance.closure_residual, static_cast<unsigned long long>(c.balance.iterations),
                imbalance(solved));
    EXPECT_LE(worst, 1e-9) << name;
    EXPECT_LE(c.reciprocity.rms, 1e-7) << name;
    EXPECT_LE(c.reciprocity.max, 1e-6) << name;
    EXPECT_LE(imbalance(solved), 1e-6) << name;
  }
}

// An open box with a solid block in a field of uniform radiosity: what space sends in is what
// surfaces would. Catches: space that is kept in one place and not in another, rows that do not sum
// to 1 - space.
TEST(BalancedLight, AUniformFieldStaysUniformInAnOpenBox) {
  const double field = 2, rho = 0.7;
  SceneBuilder builder(1);
  const std::uint32_t wall = builder.material("wall", rho, (1 - rho) * field);
  const std::vector<Vec3> bottom = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Vec3 up(0, 0, 0.8);
  builder.grid(wall, bottom[0], bottom[1], bottom[2], bottom[3], 6, 6);
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 &a = bottom[(k + 1) % 4], &b = bottom[k];
    builder.grid(wall, a, b, b + up, a + up, 6, 5);
  }
  builder.box({wall, wall, wall, wall, wall, wall}, {0.2, 0.3, 0.3}, {0.7, 0.6, 0.5}, {3, 3, 2},
              false);
  Scene scene = builder.finish();
  scene.space_exitance[0] = field;
  const Solved solved = solve(scene, balanced());
  EXPECT_GT(solved.certificate.space.max, 0.3);
  EXPECT_EQ(solved.certificate.back_side.max, 0);
  EXPECT_GT(solved.certificate.balance.rms_change, 1e-2) << "nothing is tested";
  EXPECT_LE(solved.certificate.reciprocity.max, 1e-6);
  for (std::uint32_t patch = 0; patch < solved.patches.patch_count(); ++patch)
    EXPECT_NEAR(solved.radiosity(patch, 0), field, 1e-10) << patch;
}

// Catches: reciprocity in the report but not in what the solver reads, areas of other patches.
TEST(BalancedLight, EnergyClosesInClosedRooms) {
  for (const std::string name : {"scenes/tableroom_a.coarse", "scenes/tworooms_a.coarse",
                                 "enclosures/room_bleed", "enclosures/nested_boxes"}) {
    const Scene scene = reference_scene(name + ".obj");
    const double before = imbalance(solve(scene, balanced(false)));
    const double after = imbalance(solve(scene, balanced()));
    std::printf("%s: imbalance %.1e -> %.1e\n", name.c_str(), before, after);
    EXPECT_GT(before, 1e-5) << name << ": nothing is tested";
    EXPECT_LE(after, 1e-6) << name;
  }
}

/// sqrt(sum (F - f)^2 / sum f^2) over the rows of one corner quarter of a face of cube8: by
/// symmetry that of the whole matrix. f: exact point form factors, 8 x 8 Gauss-Legendre points a
/// patch.
double cube8_error(const PatchSet& patches, const FormFactors& factors) {
  const double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                          0.9602898564975363};
  const double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                            0.1012285362903763};
  double squares = 0, all = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    if (i % 8 > 3 || i / 8 > 3)
      continue;
    const std::vector<double> row = factors.dense_row(i);
    const std::vector<Vec3> at = corners_of(patches, i);
    for (std::uint32_t j = 64; j < patches.patch_count(); ++j) {
      double exact = 0;
      for (int u = 0; u < 8; ++u)
        for (int v = 0; v < 8; ++v) {
          const double x = u < 4 ? -node[u] : node[u - 4], y = v < 4 ? -node[v] : node[v - 4];
          const Vec3 point =
              patches.centre[i] + (at[1] - at[0]) * (x / 2) + (at[3] - at[0]) * (y / 2);
          exact += weight[u % 4] * weight[v % 4] / 4 *
                   lambert_form_factor(point, patches.normal[i], corners_of(patches, j));
        }
      squares += (row[j] - exact) * (row[j] - exact);
      all += exact * exact;
    }
  }
  return std::sqrt(squares / all);
}

// Catches: a correction that closes and is reciprocal, but moves away from the truth; symmetric
// scaling (3.9e-2) in place of least squares.
TEST(BalancedLight, FormFactorsOfACubeAreNearerTheTruth) {
  const PatchSet patches = patches_of(cube8());
  FormFactors before, after;
  compute_all(patches, balanced(false), 0, &before);
  compute_all(patches, balanced(), 0, &after);
  const double was = cube8_error(patches, before), is = cube8_error(patches, after);
  std::printf("cube8: RMS error of F %.2e -> %.2e\n", was, is);
  EXPECT_NEAR(was, 6.2e-2, 2e-3);
  EXPECT_LE(is, 2.8e-2);
}

// Catches: the same with occluders, patches of unequal size and an open front (cornell).
TEST(BalancedLight, RadiosityOfRoomsIsNearerTheTruth) {
  for (const std::string name : {"cornell", "tableroom_a", "tworooms_a"}) {
    const Scene scene = reference_scene("scenes/" + name + ".coarse.obj");
    const auto truth = reference_json("scenes/" + name + ".truth.json");
    double error[2];
    for (const bool balance : {false, true}) {
      const Solved solved = solve(scene, balanced(balance));
      error[balance] = deviation(solved.solution.radiosity.span(),
                                 truth["coarse_constant_element_B"], solved.patches.area.span())
                           .area_rms;
    }
    std::printf("%s: area RMS of B %.2e -> %.2e\n", name.c_str(), error[0], error[1]);
    EXPECT_LE(error[1], 0.8 * error[0]) << name;
  }
}

// Catches: black patches left out of the balance, or swept; irradiance from the rows before it.
TEST(BalancedLight, BlackPatchesTakePart) {
  const Scene scene = reference_scene("enclosures/nested_boxes.obj");
  const Solved with = solve(scene, balanced());
  radiosity::Options options = balanced();
  options.black_irradiance = false;
  const Solved without = solve(scene, options);
  EXPECT_TRUE(same_bits(with.solution.radiosity.span(), without.solution.radiosity.span()));
  EXPECT_EQ(with.certificate.form_factor_hash, without.certificate.form_factor_hash);
  EXPECT_EQ(with.certificate.hemicubes, with.certificate.patches);
  EXPECT_TRUE(without.certificate.energy.empty());
  std::uint32_t black = 0;
  for (std::size_t at = 0; at < with.solution.irradiance.size(); ++at) {
    EXPECT_FALSE(std::isnan(with.solution.irradiance[at])) << at;
    black += std::isnan(without.solution.irradiance[at]) ? 1 : 0;
  }
  EXPECT_GT(black, 0u);
}

// Catches: sums that depend on the number of threads, anywhere between rows and light.
TEST(BalancedLight, AnyNumberOfThreadsGivesTheSameBits) {
  const Scene scene = reference_scene("scenes/cornell.coarse.obj");
  const Solved one = solve(scene, balanced(), 1);
  for (const std::uint32_t threads : {2u, 3u, 7u}) {
    const Solved other = solve(scene, balanced(), threads);
    EXPECT_TRUE(same_bits(one.solution.radiosity.span(), other.solution.radiosity.span()));
    EXPECT_EQ(one.certificate.form_factor_hash, other.certificate.form_factor_hash);
    EXPECT_EQ(one.certificate.balance.rms_change, other.certificate.balance.rms_change);
    EXPECT_EQ(one.certificate.reciprocity.max, other.certificate.reciprocity.max);
  }
}

// Catches: part of a matrix balanced as if it were all.
TEST(BalancedLight, SomeRowsAndPointsAreRefused) {
  const PatchSet patches = patches_of(furnace_cube(2, 0.5, 1));
  radiosity::SerialExecutor executor;
  radiosity::FormFactorMatrix matrix;
  radiosity::Certificate certificate;
  const std::vector<std::uint32_t> rows = {0, 1};
  EXPECT_EQ(radiosity::compute_form_factors(patches, rows, balanced(), executor, nullptr, &matrix,
                                            &certificate)
                .code(),
            StatusCode::kInvalidArgument);
  const std::vector<radiosity::Receiver> points = {{{0.5, 0.5, 0.5}, {0, 0, 1}}};
  EXPECT_EQ(radiosity::compute_point_form_factors(patches, points, balanced(), executor, nullptr,
                                                  &matrix, &certificate)
                .code(),
            StatusCode::kInvalidArgument);
}

} // namespace
} // namespace hemicube::test
