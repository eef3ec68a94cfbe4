#include "radiosity/output/orbit.h"

#include "tests/unit/picture_support.h"

namespace hemicube::radiosity::test {
namespace {

// Catches: a turn about another axis or place, a frame too few for a loop without a jump.
TEST(Orbit, GoesAroundTheTarget) {
  Camera camera;
  camera.position = {3, 1, 5};
  camera.target = {1, 2, 3};
  camera.up = {0, 0, 2};
  EXPECT_EQ(orbit_camera(camera, 0, 8).position, camera.position);
  const Camera quarter = orbit_camera(camera, 2, 8);
  EXPECT_NEAR(glm::length(quarter.position - Vec3{2, 4, 5}), 0, 1e-14); // (2, -1) becomes (1, 2)
  EXPECT_EQ(quarter.target, camera.target);
  EXPECT_EQ(quarter.up, camera.up);
  const Vec3 last = orbit_camera(camera, 7, 8).position;
  EXPECT_NEAR(glm::length(last - camera.position),
              glm::length(orbit_camera(camera, 1, 8).position - camera.position), 1e-14);
  for (std::uint32_t frame = 0; frame < 720; ++frame) {
    const Vec3 arm = orbit_camera(camera, frame, 720).position - camera.target;
    ASSERT_NEAR(glm::length(arm), 3, 1e-14);
    ASSERT_NEAR(arm.z, 2, 1e-14);
  }
}

} // namespace
} // namespace hemicube::radiosity::test
