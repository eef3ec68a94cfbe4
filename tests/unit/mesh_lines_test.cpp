#include "radiosity/output/mesh_lines.h"

#include "radiosity/output/camera_view.h"
#include "tests/unit/picture_support.h"

namespace hemicube::radiosity::test {
namespace {

/// How strong the lines of a picture are along a row, in pixels.
double lines_in_row(const Picture& picture, std::size_t y) {
  double sum = 0;
  for (std::size_t x = 0; x < picture.width; ++x)
    sum += picture.lines[y * picture.width + x];
  return sum / (picture.samples * picture.samples);
}

Picture draw_mesh(const Scene& scene, const PatchSet& patches, const Solution& solution,
                  const Camera& camera, std::uint32_t samples) {
  SerialExecutor serial;
  Picture picture;
  require(draw_picture(scene, patches, values_of(patches, solution), camera,
                       {raster::best_kernels(), samples, true}, serial, &picture));
  return picture;
}

// Catches: lines that grow with the samples, edges missed at the borders of windows or against the
// background, a hanging corner drawn as an edge.
TEST(MeshLines, AreOnePixelWideWhereverPatchesMeet) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  // Two patches side by side in the middle of the picture; the left one has a third corner in line
  // on its upper edge and on the edge between them.
  builder.face(grey, {{-0.5, -0.5, -1},
                      {0, -0.5, -1},
                      {0, 0, -1},
                      {0, 0.5, -1},
                      {-0.2, 0.5, -1},
                      {-0.5, 0.5, -1}});
  builder.face(grey, {{0, -0.5, -1}, {0.5, -0.5, -1}, {0.5, 0.5, -1}, {0, 0.5, -1}});
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  ASSERT_EQ(patches.patch_count(), 2u);
  const Solution solution =
      solution_with(scene, patches, [](std::uint32_t, std::uint32_t) { return 1.0; });
  Camera camera;
  camera.vertical_field_of_view = 90;
  for (const std::size_t size : {40u, 104u})
    for (std::uint32_t samples = 1; samples <= kMaxSamples; ++samples) {
      camera.width = camera.height = static_cast<std::uint32_t>(size);
      const Picture picture = draw_mesh(scene, patches, solution, camera, samples);
      const std::size_t middle = size / 2;
      // Left edge, middle, right edge.
      for (const std::size_t y : {middle - size / 8, middle, middle + size / 8})
        EXPECT_NEAR(lines_in_row(picture, y), 3, 1e-12) << size << " " << samples << " " << y;
      EXPECT_EQ(lines_in_row(picture, size / 8), 0) << "background";
      for (std::size_t x = 0; x < size; ++x) {
        bool is_near = false;
        for (const std::size_t edge : {size / 4, middle, 3 * size / 4})
          is_near = is_near || x == edge || x + 1 == edge;
        EXPECT_TRUE(is_near || picture.lines[middle * size + x] == 0) << x << " " << samples;
      }
    }
}

// Catches: lines of another colour than the ink, or on top of pixels that have none.
TEST(MeshLines, AreBrightOnDarkAndDarkOnBright) {
  Picture picture;
  picture.width = 4;
  picture.height = 1;
  picture.samples = 2;
  for (const int lines : {0, 4, 4, 2})
    require(picture.lines.push_back(static_cast<std::uint8_t>(lines)));
  ColorImage image;
  require(image.init(4, 1, 40));
  image.set(2, 0, {200, 180, 160});
  draw_mesh_lines(picture, &image);
  EXPECT_EQ(image.rgb[0], 40);
  EXPECT_EQ(image.rgb[3], (40 + 255 + 1) / 2);
  EXPECT_EQ(image.rgb[6], 100);
  EXPECT_EQ(image.rgb[8], 80);
  EXPECT_EQ(image.rgb[9], (3 * 40 + 255 + 2) / 4);
}

} // namespace
} // namespace hemicube::radiosity::test
