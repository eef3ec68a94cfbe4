// What pictures show: quantities, patch ids.

#include "radiosity/elementary.h"
#include "radiosity/output/look_picture.h"
#include "radiosity/output/patch_id_picture.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/unit/picture_support.h"

#include <algorithm>

namespace hemicube::radiosity::test {
namespace {

// Catches: the wrong column of the solution, a quantity divided by pi that is not to be.
TEST(Quantity, EachIsWhatThePatchesHave) {
  const FloorPicture floor;
  for (std::size_t x = 0; x < 4; ++x) {
    const double h = static_cast<double>(x) + 1;
    EXPECT_NEAR(red(floor.of(Quantity::kIrradiance, true), x, 0), h, 1e-6);
    EXPECT_NEAR(red(floor.of(Quantity::kRadiosity, true), x, 0), 0.25 + 0.5 * h, 1e-6);
    EXPECT_NEAR(red(floor.of(Quantity::kRadiance, true), x, 0), (0.25 + 0.5 * h) / kPi, 1e-6);
    EXPECT_NEAR(red(floor.of(Quantity::kExitance, false), x, 0), 0.25, 1e-6);
  }
}

// Catches: --flat without effect, irradiance that is never reconstructed.
TEST(Quantity, FlatShowsOneValueAPatch) {
  FloorPicture floor;
  floor.camera.width = 8;
  floor.camera.height = 2;
  const Picture flat = floor.of(Quantity::kIrradiance, true);
  const Picture smooth = floor.of(Quantity::kIrradiance, false);
  for (std::size_t x = 0; x < 8; x += 2) {
    EXPECT_EQ(red(flat, x, 0), red(flat, x + 1, 0));
    EXPECT_LT(red(smooth, x, 0), red(smooth, x + 1, 0) - 0.1);
  }
}

// Catches: a mean that counts emitted light, a difference to the wrong patch, NaN without light.
TEST(Quantity, TheErrorIsTheVariationInsideAPatchOverTheMeanReflected) {
  FloorPicture floor;
  const PictureValues error = values_of(floor.patches, floor.solution, Quantity::kError);
  // B runs from 0.75 to 2.25 in steps of 0.5; corners between patches hold the mean of the two.
  for (std::size_t patch = 0; patch < 4; ++patch)
    EXPECT_NEAR(error.patch[patch], 0.25 / 1.25, 1e-6);
  EXPECT_TRUE(error.corner.empty());
  floor.solution.radiosity.fill(0.25);
  for (const double value : values_of(floor.patches, floor.solution, Quantity::kError).patch)
    EXPECT_EQ(value, 0);
}

// Catches: NaN in a picture, or spread to a neighbour whose value is known.
TEST(Quantity, WhatIsNotKnownIsBackground) {
  FloorPicture floor;
  floor.solution.irradiance[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(unknown_count(values_of(floor.patches, floor.solution, Quantity::kIrradiance)), 1u);
  EXPECT_EQ(unknown_count(values_of(floor.patches, floor.solution, Quantity::kRadiance)), 0u);
  const Picture picture = floor.of(Quantity::kIrradiance, false);
  EXPECT_EQ(picture.kind[1], PixelKind::kBackground);
  EXPECT_EQ(picture.hits[1], 0);
  EXPECT_EQ(red(picture, 1, 0), 0);
  EXPECT_NEAR(red(picture, 0, 0), 1, 1e-6) << "flat: the patch beside it is not known";
  EXPECT_NEAR(red(picture, 2, 0), 3, 1e-6);
  EXPECT_NEAR(red(picture, 3, 0), 4, 0.6);
}

// Catches: ids averaged or off by a pixel, two patches of one colour.
TEST(PatchIds, AreThoseOfTheNearestPatch) {
  const FloorPicture floor;
  Camera camera = floor.camera;
  camera.width = 400;
  camera.height = 200; // twice as high as the floor
  camera.vertical_field_of_view = 90;
  SerialExecutor serial;
  ThreadPool pool;
  require(pool.init(3));
  PatchIdPicture ids, others;
  require(draw_patch_ids(floor.patches, camera, raster::best_kernels(), serial, &ids));
  require(draw_patch_ids(floor.patches, camera, *raster::kernels_by_name("scalar"), pool, &others));
  ColorImage image;
  require(patch_id_image(ids, &image));
  for (std::uint32_t y = 0; y < 200; ++y)
    for (std::uint32_t x = 0; x < 400; ++x) {
      const std::uint32_t id = ids.ids[y * 400 + x];
      const bool is_floor = y >= 50 && y < 150;
      ASSERT_EQ(id, is_floor ? x / 100 : raster::kNoItem) << x << " " << y;
      ASSERT_EQ(others.ids[y * 400 + x], id);
      const std::uint8_t* rgb = image.pixel(x, y);
      ASSERT_EQ((Color{rgb[0], rgb[1], rgb[2]}), is_floor ? item_color(id) : Color{});
    }
}

TEST(PatchIds, HaveDifferentColours) {
  std::vector<std::uint32_t> colors;
  for (std::uint32_t id = 0; id < 1000000; ++id) {
    const Color color = item_color(id * 5);
    colors.push_back(color[0] << 16 | color[1] << 8 | color[2]);
  }
  std::sort(colors.begin(), colors.end());
  EXPECT_EQ(std::adjacent_find(colors.begin(), colors.end()), colors.end());
}

} // namespace
} // namespace hemicube::radiosity::test
