// The scenes in scenes/ read without a complaint and are what scenes/README.md says.

#include "radiosity/scene/read_scene.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

namespace hemicube::test {
namespace {

Scene shipped(const std::string& file) {
  Scene scene;
  radiosity::ReadReport report;
  require(radiosity::read_scene(HC_SOURCE_DIR "/scenes/" + file, &scene, &report));
  EXPECT_TRUE(report.skipped.empty()) << file << ": " << report.skipped.begin()->first;
  EXPECT_EQ(report.faces_without_material, 0u) << file;
  return scene;
}

// Catches: a scene file that names a missing mesh, or a key the reader refuses.
TEST(ShippedScenes, ReadAsTheyAre) {
  const struct {
    const char* name;
    std::size_t faces;
  } scenes[] = {{"cornell", 617}, {"two_rooms", 546}, {"table", 391}};
  for (const auto& expected : scenes) {
    const Scene mesh = shipped(std::string(expected.name) + ".obj");
    const Scene scene = shipped(std::string(expected.name) + ".json");
    EXPECT_EQ(mesh.face_count(), expected.faces) << expected.name;
    EXPECT_EQ(scene.face_count(), expected.faces) << expected.name;
    EXPECT_FALSE(mesh.has_camera);
    EXPECT_TRUE(scene.has_camera);
    EXPECT_EQ(scene.face_max_edge.size(), expected.faces) << "must be subdivided";
    EXPECT_EQ(patches_of(mesh).patch_count(), expected.faces) << "a face was dropped or cut";
  }
}

// Catches: lost light in the first scene that a reader of the documentation runs.
TEST(ShippedScenes, TheFurnaceIsExact) {
  const Solved solved = solve(shipped("furnace_cube.obj"), {});
  for (std::uint32_t patch = 0; patch < solved.patches.patch_count(); ++patch) {
    EXPECT_NEAR(solved.radiosity(patch, 0), 2, 1e-6);
    EXPECT_NEAR(solved.radiosity(patch, 1), 10, 1e-5);
    EXPECT_NEAR(solved.radiosity(patch, 2), 5, 5e-6);
  }
}

} // namespace
} // namespace hemicube::test
