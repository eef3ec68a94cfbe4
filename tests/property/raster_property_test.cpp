// The rasterizer against the naive oracle and against itself: what a pixel holds is a function of
// the set of polygons and the view, whatever the kernels, the order of the polygons and the
// windows.

#include "tests/support/drawn_face.h"
#include "tests/support/naive_raster.h"
#include "tests/support/raster_cases.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hemicube::test {
namespace {

using raster::Face;
using raster::Item;
using raster::kNoItem;
using raster::View;

class RasterCases : public testing::TestWithParam<RasterCase (*)()> {};

// Catches: any wrong coverage or depth decision, on any face, at any scale.
TEST_P(RasterCases, DrawsWhatTheNaiveOracleSees) {
  const RasterCase scene = GetParam()();
  long undecided = 0, pixels = 0;
  for (const std::string& isa : kernels_here()) {
    Drawer drawer(scene.polygons.view(), *raster::kernels_by_name(isa));
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      drawer.begin(scene.views[v]);
      for (const std::uint32_t resolution : {16u, 64u}) {
        if (resolution == 64 && v >= 2 && isa != "scalar")
          continue; // those are compared with scalar, bit for bit, below
        for (const Face face : kFaces) {
          const auto grid = raster::hemicube_grid(face, resolution);
          const NaiveImage naive = naive_image(scene.polygons.view(), scene.views[v], face, grid);
          undecided += undecided_count(naive);
          EXPECT_EQ(difference(naive, drawer.draw(face, grid)), "")
              << scene.name << ", " << isa << ", view " << v << ", resolution " << resolution
              << ", face " << static_cast<int>(face);
          pixels += grid.width * grid.height;
        }
      }
    }
  }
  RecordProperty("undecided_pixels", std::to_string(undecided));
  RecordProperty("pixels", std::to_string(pixels));
  EXPECT_LE(undecided, pixels / 1000) << "of " << pixels << ": too few were judged";
}

// Catches: a kernel that differs from the scalar one in one bit of an item or a depth, at row ends,
// partial windows and odd widths too.
TEST_P(RasterCases, AllKernelsGiveTheBitsOfTheScalarOne) {
  const RasterCase scene = GetParam()();
  Drawer scalar(scene.polygons.view(), *raster::kernels_by_name("scalar"));
  for (const std::string& isa : kernels_here()) {
    if (isa == "scalar")
      continue;
    Drawer drawer(scene.polygons.view(), *raster::kernels_by_name(isa));
    for (const View& view : scene.views) {
      scalar.begin(view);
      drawer.begin(view);
      for (const std::uint32_t resolution : {16u, 50u, 64u, 200u, 256u, 300u})
        for (const Face face : kFaces) {
          const auto grid = raster::hemicube_grid(face, resolution);
          EXPECT_TRUE(same_bits(scalar.draw(face, grid), drawer.draw(face, grid)))
              << scene.name << ", " << isa << ", resolution " << resolution;
        }
    }
  }
}

// Catches: anything that depends on the window a pixel is drawn in: spans cut at its sides, depths
// taken relative to its corner, hiding tests of a neighbour window.
TEST_P(RasterCases, WindowsDoNotChangeABit) {
  const RasterCase scene = GetParam()();
  Drawer drawer(scene.polygons.view(), raster::best_kernels());
  drawer.begin(scene.views.front());
  for (const std::uint32_t resolution : {64u, 300u})
    for (const Face face : kFaces) {
      const auto grid = raster::hemicube_grid(face, resolution);
      const DrawnFace whole = drawer.draw(face, grid);
      EXPECT_TRUE(same_bits(whole, drawer.draw(face, grid, 48, 32))) << scene.name;
      EXPECT_TRUE(same_bits(whole, drawer.draw(face, grid, 256, 17))) << scene.name;
    }
}

// The cases stand 1e-3 to 1e6 from the origin: all coordinates stay within what readers let
// through. Catches: bounds in metres, and single precision that overflows or loses small numbers.
TEST_P(RasterCases, PowersOfTwoChangeOnlyTheUnitOfDepth) {
  const RasterCase scene = GetParam()();
  for (const double factor : {0x1p-100, 0x1p-60, 0x1p70}) {
    const PolygonSet scaled = transformed(scene.polygons, factor, {0, 0, 0});
    for (const std::string& isa : kernels_here()) {
      Drawer drawer(scene.polygons.view(), *raster::kernels_by_name(isa));
      Drawer other(scaled.view(), *raster::kernels_by_name(isa));
      for (View view : scene.views) {
        drawer.begin(view);
        view.eye *= factor;
        other.begin(view);
        for (const Face face : kFaces) {
          const auto grid = raster::hemicube_grid(face, 64);
          DrawnFace expected = drawer.draw(face, grid);
          for (float& depth : expected.depths)
            depth /= static_cast<float>(factor);
          EXPECT_TRUE(same_bits(expected, other.draw(face, grid)))
              << scene.name << ", " << isa << ", times " << factor;
        }
      }
    }
  }
}

// Catches: results that depend on drawing order: accumulation, ties broken by "last one wins".
TEST_P(RasterCases, OrderOfPolygonsChangesOnlyTheirIds) {
  const RasterCase scene = GetParam()();
  const std::uint32_t count = scene.polygons.count();
  std::vector<std::uint32_t> old_id(count);
  for (std::uint32_t i = 0; i < count; ++i)
    old_id[i] = i;
  Random random(2024);
  for (std::uint32_t i = count; i > 1; --i)
    std::swap(old_id[i - 1], old_id[random.index(i)]);
  PolygonSet shuffled;
  for (const std::uint32_t id : old_id)
    shuffled.add(scene.polygons.polygon(id));

  Drawer drawer(scene.polygons.view(), raster::best_kernels());
  Drawer other(shuffled.view(), raster::best_kernels());
  long differing = 0, pixels = 0;
  for (const View& view : scene.views) {
    View other_view = view;
    if (view.skip != kNoItem)
      other_view.skip = static_cast<std::uint32_t>(
          std::find(old_id.begin(), old_id.end(), view.skip) - old_id.begin());
    drawer.begin(view);
    other.begin(other_view);
    for (const Face face : kFaces) {
      const auto grid = raster::hemicube_grid(face, 64);
      const DrawnFace expected = drawer.draw(face, grid);
      DrawnFace drawn = other.draw(face, grid);
      for (Item& item : drawn.items)
        if (item != kNoItem)
          item = old_id[raster::item_id(item)] | (item & raster::kBackFacing);
      EXPECT_TRUE(drawn.depths == expected.depths) << scene.name;
      for (std::size_t i = 0; i < drawn.items.size(); ++i)
        differing += drawn.items[i] != expected.items[i];
      pixels += static_cast<long>(drawn.items.size());
    }
  }
  // Two different surfaces may have equal float depths where they cross: there the ids decide.
  EXPECT_LE(differing, scene.crossing ? pixels / 20000 : 0) << scene.name << ", of " << pixels;
}

INSTANTIATE_TEST_SUITE_P(, RasterCases, testing::ValuesIn(kRasterCases),
                         [](const auto& made) { return made.param().name; });

// ---------------------------------------------------------------------------------------------------

class ClosedScenes : public testing::TestWithParam<ClosedScene (*)()> {};

// Catches: cracks between patches (a background pixel) and backs seen through them, from every
// patch.
TEST_P(ClosedScenes, NoPatchSeesSpaceOrABack) {
  const ClosedScene scene = GetParam()();
  const PatchSet patches = patches_of(scene.scene);
  Drawer drawer(radiosity::polygons_of(patches), raster::best_kernels());
  long open = 0, back = 0, own = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    drawer.begin(radiosity::hemicube_view(patches, patch));
    for (const Face face : kFaces)
      for (const Item item : drawer.draw(face, raster::hemicube_grid(face, 128)).items) {
        open += item == kNoItem;
        back += item != kNoItem && raster::is_back_facing(item);
        own += item == patch;
      }
  }
  EXPECT_EQ(open, 0);
  EXPECT_EQ(back, 0);
  EXPECT_EQ(own, 0) << "a patch is in its own view";
}

INSTANTIATE_TEST_SUITE_P(, ClosedScenes, testing::ValuesIn(kClosedScenes),
                         [](const auto& made) { return made.param().name; });

// T-edges that run exactly through pixel centres may leave single pixels open, never more.
// Catches: cracks along T-edges.
TEST(Raster, TVerticesLeaveAtMostStrayPixelsOpen) {
  const PatchSet patches = patches_of(t_vertex_room());
  Drawer drawer(radiosity::polygons_of(patches), raster::best_kernels());
  long open = 0, pixels = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    drawer.begin(radiosity::hemicube_view(patches, patch));
    for (const Face face : kFaces)
      for (const Item item : drawer.draw(face, raster::hemicube_grid(face, 256)).items) {
        open += item == kNoItem || raster::is_back_facing(item);
        ++pixels;
      }
  }
  EXPECT_LE(open, pixels / 1000000) << "of " << pixels;
}

} // namespace
} // namespace hemicube::test
