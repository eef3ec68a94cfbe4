// Enclosures whose radiosity is known exactly whatever the form factors between their patches: only
// the sums of the rows matter, and those must be exact.

#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

struct Furnace {
  const char* name;
  std::uint32_t resolution;
};

std::vector<Furnace> furnaces() {
  std::vector<Furnace> all;
  for (const char* name : {"furnace_cube", "furnace_lroom", "furnace_boxes", "furnace_icosphere2",
                           "furnace_torus", "furnace_cube_0999", "furnace_cube_0999999"})
    for (const std::uint32_t resolution : {64u, 256u})
      all.push_back({name, resolution});
  return all;
}

class Furnaces : public testing::TestWithParam<Furnace> {};

// Catches: any background pixel in a closed scene, any row that does not sum to 1, a solver that
// stops on the residual although the error is 1 / (1 - rho) times as large.
TEST_P(Furnaces, RadiosityIsExitanceOverAbsorption) {
  const std::string name = GetParam().name;
  const auto material = reference_case("enclosures.json", name)["materials"]["all"];
  radiosity::Options options;
  options.resolution = GetParam().resolution;
  options.tolerance = 1e-11;
  const Solved solved = solve(reference_scene("enclosures/" + name + ".obj"), options);

  const double bound = name == "furnace_cube_0999999" ? 1e-6 : 1e-9;
  double worst = 0;
  for (std::uint32_t patch = 0; patch < solved.patches.patch_count(); ++patch) {
    EXPECT_EQ(solved.solution.space[patch], 0.0) << "patch " << patch;
    EXPECT_EQ(solved.solution.back_side[patch], 0.0) << "patch " << patch;
    EXPECT_NEAR(solved.solution.row_sum[patch], 1.0, 1e-15) << "patch " << patch;
    for (std::uint32_t band = 0; band < 3; ++band) {
      const double expected = material["emission"][band].get<double>() /
                              (1 - material["reflectance"][band].get<double>());
      const double error = std::fabs(solved.radiosity(patch, band) / expected - 1);
      EXPECT_LE(error, bound) << "patch " << patch << ", band " << band;
      worst = std::max(worst, error);
    }
  }
  EXPECT_TRUE(solved.certificate.converged);
  EXPECT_EQ(solved.certificate.space.max, 0.0);
  EXPECT_EQ(solved.certificate.back_side.max, 0.0);
  std::printf("%s at %u: largest relative error %.2e, %llu sweeps\n", name.c_str(),
              options.resolution, worst,
              static_cast<unsigned long long>(solved.certificate.sweeps));
}

INSTANTIATE_TEST_SUITE_P(, Furnaces, testing::ValuesIn(furnaces()), [](const auto& made) {
  return std::string(made.param.name) + "_" + std::to_string(made.param.resolution);
});

/// Checks B of every patch against the value its material has in truth.group_B.
void expect_group_values(const std::string& name, double relative) {
  const auto truth = reference_case("enclosures.json", name)["truth"]["group_B"];
  const Scene scene = reference_scene("enclosures/" + name + ".obj");
  radiosity::Options options;
  options.tolerance = 1e-11;
  const Solved solved = solve(scene, options);
  for (std::uint32_t patch = 0; patch < solved.patches.patch_count(); ++patch) {
    const std::string material(scene.materials[solved.patches.material[patch]]);
    ASSERT_TRUE(truth.contains(material)) << material;
    for (std::uint32_t band = 0; band < 3; ++band) {
      const double expected = truth[material][band];
      EXPECT_NEAR(solved.radiosity(patch, band), expected, relative * expected)
          << name << ", patch " << patch << ", " << material << ", band " << band;
    }
  }
}

// Catches: light that crosses from one component to another, and 0 / 0 in components without light.
TEST(Enclosures, DisconnectedComponentsDoNotSeeEachOther) {
  expect_group_values("disconnected", 1e-9);
}

// A convex body in a black room sees the room alone: B = E + rho E_room, whatever the form factors.
// Catches: inner patches that see each other, or themselves; black patches that reflect.
TEST(Enclosures, AConvexBodyInABlackRoomSeesTheRoomAlone) {
  expect_group_values("nested_boxes", 1e-9);
}

// Catches: B = E + rho H with rho = 0 that is not exactly E.
TEST(Enclosures, BlackRoomsHaveExactlyTheirExitance) {
  for (const char* name : {"black_room", "black_room_blocker"}) {
    const Scene scene = reference_scene(std::string("enclosures/") + name + ".obj");
    const Solved solved = solve(scene, {});
    for (std::uint32_t patch = 0; patch < solved.patches.patch_count(); ++patch)
      for (std::uint32_t band = 0; band < 3; ++band)
        EXPECT_EQ(solved.radiosity(patch, band),
                  scene.exitance[solved.patches.material[patch] * 3 + band])
            << name << ", patch " << patch;
    EXPECT_LE(solved.certificate.sweeps, 1u) << name << ": nothing reflects";
  }
}

} // namespace
} // namespace hemicube::test
