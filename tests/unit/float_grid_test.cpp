#include "radiosity/scene/float_grid.h"

#include "tests/support/file_bytes.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

/// A unit triangle as text, moved along all axes.
std::string off_triangle(double offset) {
  std::string text = "OFF\n3 1 0\n";
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.7, 0, 0), Vec3(0, 0.7, 0)})
    for (int axis = 0; axis < 3; ++axis)
      text += std::to_string(corner[axis] + offset) + (axis == 2 ? "\n" : " ");
  return text + "3 0 1 2\n";
}

/// The same as floats.
std::string stl_triangle(double offset) {
  std::string bytes(80, ' ');
  bytes += bytes_of(std::uint32_t{1}) + std::string(12, '\0');
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.7, 0, 0), Vec3(0, 0.7, 0)})
    for (int axis = 0; axis < 3; ++axis)
      bytes += bytes_of(static_cast<float>(corner[axis] + offset));
  return bytes + "at";
}

// 0x1p-4 is the distance of floats near 1e6.
TEST(FloatGrid, IsTheirDistanceOverTheSizeOfTheMesh) {
  const auto step = [](double x) {
    const Vec3 vertices[] = {Vec3(x, 0, 1), Vec3(x - 2, 0, 0)};
    return float_grid_step(vertices);
  };
  EXPECT_EQ(step(1e6), 0x1p-5);
  EXPECT_EQ(step(-1e6), 0x1p-5);
  EXPECT_EQ(step(1), 0x1p-24 / 2);
  EXPECT_EQ(step(1e6 + 0.01), 0) << "no float";
  EXPECT_EQ(step(1e300), 0) << "beyond all floats";
}

TEST(FloatGrid, OfNothingAndOfAPointIs0) {
  EXPECT_EQ(float_grid_step({}), 0);
  const Vec3 point[] = {Vec3(1e6), Vec3(1e6)};
  EXPECT_EQ(float_grid_step(point), 0);
}

class FloatGridOfFiles : public SceneFiles {};

// Catches: files whose corners were rounded before we saw them, and that nobody is told.
TEST_F(FloatGridOfFiles, IsSeenWhereFloatsAreFarFromTheOrigin) {
  write("a.off", off_triangle(1e6));
  expect_read("a.off");
  EXPECT_EQ(report_.float_grid_step, 0);

  write("near.stl", stl_triangle(0));
  expect_read("near.stl");
  EXPECT_LT(report_.float_grid_step, 1e-7);

  write("far.stl", stl_triangle(1e6));
  expect_read("far.stl");
  EXPECT_EQ(report_.float_grid_step, 0x1p-4 / 0.6875) << "0.7 rounded to 1/16";

  write("scene.json", R"({"format": "hemicube-scene", "version": 1,
                           "meshes": [{"file": "near.stl"}, {"file": "far.stl"}]})");
  expect_read("scene.json");
  EXPECT_EQ(report_.float_grid_step, 0x1p-4 / 0.6875) << "the coarser one";
}

} // namespace
} // namespace hemicube::radiosity::test
