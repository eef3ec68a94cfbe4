// What the page in the browser computes, computed here: the same light as the program's.
#include "radiosity/web/page_picture.h"
#include "radiosity/web/page_solver.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hemicube::radiosity::web {
namespace {

Buffer<std::byte> packed(const Scene& scene) {
  PageScene page;
  page.patches = test::patches_of(scene);
  for (const auto& [from, to] : {std::pair{&scene.bands, &page.scene.bands},
                                 {&scene.materials, &page.scene.materials},
                                 {&scene.groups, &page.scene.groups}})
    for (std::uint32_t k = 0; k < from->size(); ++k)
      test::require(to->add((*from)[k]));
  test::require(page.scene.reflectance.assign(scene.reflectance.span()));
  test::require(page.scene.exitance.assign(scene.exitance.span()));
  test::require(page.scene.space_exitance.assign(scene.space_exitance.span()));
  test::require(page.scene.two_sided.assign(scene.two_sided.span()));
  page.scene.camera = scene.camera;
  Buffer<std::byte> bytes;
  test::require(pack_page_scene(page, &bytes));
  return bytes;
}

/// The program's progressive refinement on the page's rung.
test::Solved native(const Scene& scene, std::uint32_t resolution) {
  Options options;
  options.resolution = resolution;
  options.solver = SolverKind::kProgressive;
  return test::solve(scene, options);
}

std::uint64_t native_hash(const Scene& scene, std::uint32_t resolution) {
  Options options;
  options.resolution = resolution;
  test::FormFactors rows;
  test::compute_all(test::patches_of(scene), options, 1, &rows);
  return rows.certificate.form_factor_hash;
}

class Page : public ::testing::Test {
protected:
  void open(const Scene& scene, std::uint32_t resolution) {
    const Buffer<std::byte> bytes = packed(scene);
    test::require(solver.open(bytes.span()));
    test::require(solver.set_resolution(resolution));
    test::require(solver.set_light(1, 1));
  }
  void converge() {
    while (!solver.is_converged())
      test::require(solver.shoot());
  }
  void expect_light_of(const test::Solved& want) {
    Solution got;
    test::require(solver.displayed(&got));
    EXPECT_TRUE(test::same_bits(got.radiosity.span(), want.solution.radiosity.span()));
    EXPECT_TRUE(test::same_bits(got.ambient.span(), want.solution.ambient.span()));
    EXPECT_EQ(solver.shots(), want.certificate.shots);
    EXPECT_EQ(solver.unshot(), want.certificate.unshot);
  }

  PageSolver solver;
};

// Catches: another order of shots than the program's, rows mixed up, light of the last run left.
TEST_F(Page, ShootsTheLightOfTheProgram) {
  Scene scene = test::cornell_like(4);
  open(scene, 32);
  converge();
  const test::Solved want = native(scene, 32);
  ASSERT_TRUE(want.certificate.converged);
  expect_light_of(want);
  test::require(solver.set_light(1, 1));
  EXPECT_EQ(solver.shots(), 0u);
  EXPECT_EQ(solver.unshot(), 1);
  converge();
  expect_light_of(want);
  test::require(solver.set_light(0.5, 3));
  converge();
  for (double& reflectance : scene.reflectance)
    reflectance *= 0.5;
  for (double& exitance : scene.exitance)
    exitance *= 3;
  expect_light_of(native(scene, 32));
}

TEST_F(Page, ItsFormFactorsAreThoseOfTheProgram) {
  const Scene scene = test::cornell_like(4);
  open(scene, 32);
  for (const std::uint32_t resolution : {32u, 64u, 32u}) {
    test::require(solver.set_resolution(resolution));
    test::require(solver.set_light(1, 1));
    EXPECT_EQ(solver.row_count(), 0u);
    for (int shot = 0; shot < 10; ++shot)
      test::require(solver.shoot());
    EXPECT_GT(solver.row_count(), 0u);
    EXPECT_LE(solver.row_count(), 10u);
    EXPECT_EQ(solver.form_factor_hash(), 0u);
    while (solver.row_count() < solver.patch_count())
      test::require(solver.fill());
    EXPECT_EQ(solver.form_factor_hash(), native_hash(scene, resolution)) << resolution;
    test::require(solver.fill());
    converge();
    EXPECT_EQ(solver.row_count(), solver.patch_count()); // rows are kept
    EXPECT_EQ(solver.form_factor_hash(), native_hash(scene, resolution)) << resolution;
  }
}

TEST_F(Page, LightThatIsStillUnshotIsNotGuessedAt) {
  open(test::cornell_like(4), 32);
  test::require(solver.shoot());
  Solution shown;
  test::require(solver.displayed(&shown));
  EXPECT_TRUE(shown.ambient.empty());
}

TEST_F(Page, RefusesWhatItCannotShow) {
  Scene scene = test::cornell_like(4);
  open(scene, 32);
  EXPECT_EQ(solver.set_light(10, 1).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(solver.set_light(1, -1).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(solver.set_resolution(33).code(), StatusCode::kInvalidArgument);
  scene.space_exitance[0] = 1;
  EXPECT_EQ(solver.open(packed(scene).span()).code(), StatusCode::kInvalidArgument);
}

TEST_F(Page, ASceneThatIsCutOffIsRefused) {
  const Buffer<std::byte> bytes = packed(test::cornell_like(4));
  for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 97)
    EXPECT_EQ(solver.open(bytes.span().first(size)).code(), StatusCode::kBadScene) << size;
}

TEST(PageOrbit, IsTheScenesCameraUntilItMoves) {
  Camera camera;
  camera.position = {0.278, 0.273, -0.8};
  camera.target = {0.278, 0.273, 0.2};
  const Camera same = orbited(camera, {});
  EXPECT_EQ(same.position, camera.position);
  EXPECT_EQ(same.up, camera.up);
  const auto arm = [&](const Orbit& orbit) {
    return orbited(camera, orbit).position - camera.target;
  };
  const auto expect_near = [](const Vec3& a, const Vec3& b) {
    EXPECT_LE(glm::length(a - b), 1e-12);
  };
  constexpr std::uint32_t kQuarter = Orbit::kFullTurn / 4;
  expect_near(arm({kQuarter, 0, 1}), {-1, 0, 0}); // counter-clockwise, seen from above
  expect_near(arm({0, kQuarter, 2}), {0, 2, 0});
  expect_near(arm({0, 3 * kQuarter, 0.5}), {0, -0.5, 0});
  const double half = std::sqrt(0.5);
  expect_near(arm({kQuarter, kQuarter / 2, 1}), {-half, half, 0});
}

} // namespace
} // namespace hemicube::radiosity::web
