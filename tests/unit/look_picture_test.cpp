#include "radiosity/output/look_picture.h"

#include "radiosity/hemicube/five_views.h"
#include "radiosity/output/hemicube_losses.h"
#include "radiosity/output/unfolded_hemicube.h"
#include "tests/unit/output_support.h"

#include <map>
#include <set>
#include <tuple>

namespace hemicube::radiosity::test {
namespace {

constexpr std::uint32_t kResolution = 16;

/// The direction of a pixel in the axes of the view, scaled to the surface of the cube.
Vec3 on_cube(const FacePixel& pixel) {
  const raster::PixelGrid grid = raster::hemicube_grid(pixel.face, kResolution);
  EXPECT_TRUE(pixel.x >= 0 && pixel.x < grid.width && pixel.y >= 0 && pixel.y < grid.height);
  return raster::from_face(pixel.face,
                           {grid.x0 + pixel.x * grid.dx, grid.y0 + pixel.y * grid.dy, 1});
}

TEST(UnfoldedHemicube, ShowsEveryPixelOnce) {
  std::set<std::tuple<raster::Face, int, int>> seen;
  std::size_t inside = 0;
  for (std::uint32_t row = 0; row < 2 * kResolution; ++row)
    for (std::uint32_t column = 0; column < 2 * kResolution; ++column)
      if (const FacePixel pixel = unfolded_pixel(kResolution, column, row); pixel.is_inside) {
        ++inside;
        seen.insert({pixel.face, pixel.x, pixel.y});
      }
  EXPECT_EQ(inside, 3 * kResolution * kResolution);
  EXPECT_EQ(seen.size(), inside);
}

TEST(UnfoldedHemicube, NeighboursAreNeighboursOnTheCube) {
  const double step = 2.0 / kResolution;
  for (std::uint32_t row = 0; row < 2 * kResolution; ++row)
    for (std::uint32_t column = 0; column < 2 * kResolution; ++column)
      for (const auto& [right, down] : {std::pair{1u, 0u}, std::pair{0u, 1u}}) {
        if (column + right == 2 * kResolution || row + down == 2 * kResolution)
          continue;
        const FacePixel a = unfolded_pixel(kResolution, column, row);
        const FacePixel b = unfolded_pixel(kResolution, column + right, row + down);
        if (!a.is_inside || !b.is_inside)
          continue;
        // One step on a face; around an edge half a step on each side, so sqrt(1/2) of one.
        const double distance = glm::length(on_cube(a) - on_cube(b));
        EXPECT_NEAR(distance, a.face == b.face ? step : step * 0.70710678, 1e-6)
            << column << "," << row;
      }
}

TEST(UnfoldedHemicube, IsSeenFromTheReceiverAndHasTheHorizonOutside) {
  const Vec3 centre = on_cube(unfolded_pixel(kResolution, kResolution, kResolution));
  const Vec3 right = on_cube(unfolded_pixel(kResolution, kResolution + 1, kResolution)) - centre;
  const Vec3 down = on_cube(unfolded_pixel(kResolution, kResolution, kResolution + 1)) - centre;
  EXPECT_GT(glm::dot(glm::cross(right, down), centre), 0) << "mirrored";
  for (const auto& [column, row] :
       {std::pair{0u, 16u}, std::pair{31u, 16u}, std::pair{16u, 0u}, std::pair{16u, 31u}})
    EXPECT_NEAR(on_cube(unfolded_pixel(kResolution, column, row)).z, 1.0 / kResolution, 1e-12);
}

TEST(ItemColors, AreFixedBrightAndDifferent) {
  std::set<std::array<std::uint8_t, 3>> colors;
  for (std::uint32_t id = 0; id < 1000; ++id) {
    const auto color = item_color(id);
    colors.insert(color);
    for (const std::uint8_t channel : color)
      EXPECT_GE(channel, 80);
  }
  EXPECT_GT(colors.size(), 990u);
  EXPECT_EQ(item_color(0), item_color(0));
}

TEST(LookPicture, ShowsItemsDepthAndWeights) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}); // faces the first
  builder.face(grey, {{4, 0, 0}, {4, 1, 0}, {4, 1, 1}, {4, 0, 1}}); // shows its back
  const PatchSet patches = patches_of(builder.finish());
  const std::uint32_t resolution = 512; // two windows a face
  HemicubeImage hemicube;
  require(render_hemicube(patches, 0, resolution, raster::best_kernels(), &hemicube));
  std::map<raster::Item, int> pixels;
  for (const FaceImage& face : hemicube.faces)
    for (const raster::Item item : face.items)
      ++pixels[item];
  EXPECT_EQ(pixels.count(0), 0u) << "the receiver itself";
  EXPECT_EQ(pixels[1], 512 * 512 / 4) << "half the width of the top, for any turn of the frame";
  EXPECT_GT(pixels[2 | raster::kBackFacing] + pixels[2], 0);

  DeltaFormFactors weights;
  require(weights.init(resolution));
  ColorImage image;
  require(draw_look(hemicube, weights, &image));
  ASSERT_EQ(image.rgb.size(), std::size_t{image.width} * image.height * 3);
  const auto color = [&](std::uint32_t panel, std::uint32_t column, std::uint32_t row) {
    const std::size_t x = 16 + panel * (1024 + 16) + column, y = 16 + row;
    const std::uint8_t* at = image.rgb.data() + 3 * (y * image.width + x);
    return std::array<std::uint8_t, 3>{at[0], at[1], at[2]};
  };
  EXPECT_EQ(color(0, 512, 512), item_color(1));
  EXPECT_EQ(color(0, 512, 270), kSpaceColor);
  EXPECT_EQ(color(1, 512, 270), (std::array<std::uint8_t, 3>{0, 0, 0})) << "space is far";
  std::map<std::array<std::uint8_t, 3>, int> colors;
  for (std::uint32_t row = 0; row < 1024; ++row)
    for (std::uint32_t column = 0; column < 1024; ++column)
      ++colors[color(0, column, row)];
  const int backs = pixels[2 | raster::kBackFacing];
  EXPECT_NEAR(colors[kBackColor], backs / 2, backs / 10) << "every other stripe";
  EXPECT_NEAR(colors[item_color(2)], backs / 2, backs / 10);
  EXPECT_GT(color(1, 512, 512)[0], 200) << "the nearest is white";
  EXPECT_GT(color(2, 512, 512)[0], 250) << "the heaviest is white";
  EXPECT_LT(color(2, 512, 0)[0], color(2, 512, 512)[0]);
  EXPECT_EQ(color(0, 0, 0), (std::array<std::uint8_t, 3>{40, 40, 40})) << "outside the cross";
}

// Catches: directions in the axes of the hemicube, a back counted as a front.
TEST(HemicubeLosses, SayWhereLightIsLost) {
  SceneBuilder builder(1); // a closed box without its wall at x = 1, whose ceiling is inside out
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
  builder.face(grey, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  builder.face(grey, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  builder.face(grey, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}});
  const PatchSet patches = patches_of(builder.finish());
  HemicubeImage hemicube;
  require(render_hemicube(patches, 0, 256, raster::best_kernels(), &hemicube));
  DeltaFormFactors weights;
  require(weights.init(256));
  HemicubeLosses losses;
  require(find_losses(hemicube, weights, hemicube_view(patches, 0), &losses));
  const double ceiling = 0.239456; // from the centre; each wall has a fourth of the rest
  EXPECT_NEAR(losses.space, (1 - ceiling) / 4, 2e-3);
  ASSERT_EQ(losses.backs.size(), 1u);
  EXPECT_EQ(losses.backs[0].patch, 1u);
  EXPECT_NEAR(losses.backs[0].fraction, ceiling, 2e-3);
  EXPECT_NEAR(glm::length(losses.space_towards), 1, 1e-12);
  EXPECT_GT(losses.space_towards.x, 0.4);
}

TEST(LookPicture, APatchThatDoesNotExistIsRefused) {
  const PatchSet patches = patches_of(hemicube::test::furnace_cube(1, 0.5, 1));
  HemicubeImage hemicube;
  const Status status = render_hemicube(patches, 6, 16, raster::best_kernels(), &hemicube);
  EXPECT_EQ(status.message(), "patch 6 does not exist; the last is 5");
}

} // namespace
} // namespace hemicube::radiosity::test
