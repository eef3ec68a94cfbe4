// Nothing that is done for speed may change a pixel: neither what is left out because it cannot be
// seen, nor the instruction set, nor how polygons are numbered and grouped, nor the windows.

#include "tests/support/looks.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/random_looks.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

namespace hemicube::test {
namespace {

using raster::Culling;
using raster::Item;
using raster::kNoItem;

class Culled : public testing::TestWithParam<RandomScenes> {
protected:
  Culled() : scenes_(GetParam().make()) {}

  std::string name(std::size_t scene, std::size_t look) const {
    return std::string(GetParam().name) + ", scene " + std::to_string(scene) + ", look " +
           std::to_string(look) + ": ";
  }

  std::vector<RandomScene> scenes_;
};

std::vector<std::vector<DrawnFace>> draw_all(const RandomScene& scene, const std::string& isa,
                                             Culling culling) {
  Drawer drawer(scene.polygons.view(), *raster::kernels_by_name(isa), culling);
  std::vector<std::vector<DrawnFace>> drawn;
  for (const Look& look : scene.looks)
    drawn.push_back(draw_look(&drawer, look));
  return drawn;
}

// Catches: anything left out that a pixel shows - boxes without the margin of their rounding,
// normal cones that are too narrow, a horizon that is too strict, tiles that hide by a rounding or
// that miss a row or a column, a queue that loses a visit - and, on any instruction set, one bit
// that is not the scalar kernels'. An instruction set is compared with and without culling, so that
// a failure says which of the two it is.
TEST_P(Culled, NeitherCullingNorKernelsChangeABit) {
  for (std::size_t s = 0; s < scenes_.size(); ++s) {
    const RandomScene& scene = scenes_[s];
    const auto expected = draw_all(scene, "scalar", Culling::kOff);
    for (const std::string& isa : kernels_here())
      for (const Culling culling : {Culling::kOff, Culling::kOn}) {
        if (isa == "scalar" && culling == Culling::kOff)
          continue;
        const auto drawn = draw_all(scene, isa, culling);
        for (std::size_t k = 0; k < drawn.size(); ++k)
          ASSERT_EQ(difference(scene.looks[k], expected[k], drawn[k]), "")
              << name(s, k) << isa << (culling == Culling::kOn ? " with" : " without")
              << " culling";
      }
  }
}

// Catches: a pixel that depends on anything but the polygons that cover it: ties not decided by the
// lower item, depths or edges that depend on what shares a polygon's batch (its number of corners
// among it), pixels left from an earlier window, View::skip that misses a copy. And what the test
// above cannot see, as it compares drawings that are made in the same order: a tile that hides too
// much in every one of them.
TEST_P(Culled, AnImageIsWhatItsPolygonsAreAlone) {
  if (!GetParam().small)
    GTEST_SKIP() << "too many polygons to draw each alone";
  int scenes_left = 60; // of those that come in large numbers
  for (std::size_t s = 0; s < scenes_.size() && scenes_left > 0; ++s, --scenes_left) {
    const RandomScene& scene = scenes_[s];
    Drawer drawer(scene.polygons.view(), raster::best_kernels());
    for (std::size_t k = 0; k < scene.looks.size(); ++k) {
      const auto drawn = draw_look(&drawer, scene.looks[k]);
      ASSERT_EQ(difference(scene.looks[k], composed_look(scene.polygons, scene.looks[k]), drawn),
                "")
          << name(s, k);
    }
  }
}

/// The same polygons over an array of vertices in which each position occurs once, in another
/// order, and every polygon given from another corner on.
PolygonSet reindexed(const PolygonSet& polygons, Random& random) {
  PolygonSet result;
  std::map<std::tuple<double, double, double>, std::uint32_t> index_of;
  for (const std::uint32_t k :
       random_order(random, static_cast<std::uint32_t>(polygons.vertices.size()))) {
    const Vec3& v = polygons.vertices[k];
    const auto next = static_cast<std::uint32_t>(result.vertices.size());
    if (index_of.try_emplace({v.x, v.y, v.z}, next).second)
      result.vertices.push_back(v);
  }
  for (std::uint32_t id = 0; id < polygons.count(); ++id) {
    const std::vector<Vec3> corners = polygons.polygon(id);
    const auto first = random.index(static_cast<std::uint32_t>(corners.size()));
    for (const Vec3& v : turned(corners, static_cast<int>(first)))
      result.corners.push_back(index_of.at({v.x, v.y, v.z}));
    result.corner_offsets.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }
  return result;
}

// Catches: planes, depths or groups that depend on indices instead of positions, or on the corner a
// polygon starts with.
TEST_P(Culled, IndicesAndFirstCornersDoNotChangeABit) {
  Random random(71);
  for (std::size_t s = 0; s < scenes_.size(); ++s) {
    const RandomScene& scene = scenes_[s];
    const PolygonSet other = reindexed(scene.polygons, random);
    Drawer drawer(scene.polygons.view(), raster::best_kernels());
    Drawer other_drawer(other.view(), raster::best_kernels());
    for (std::size_t k = 0; k < scene.looks.size(); k += 3)
      ASSERT_EQ(difference(scene.looks[k], draw_look(&drawer, scene.looks[k]),
                           draw_look(&other_drawer, scene.looks[k])),
                "")
          << name(s, k);
  }
}

/// Checks that a drawing of renumbered polygons shows the same but for exact ties.
/// @param alone  draws one polygon of the original numbers
void expect_same_but_for_ties(const DrawnFace& expected, const DrawnFace& drawn,
                              const std::vector<std::uint32_t>& old_id,
                              const std::function<const DrawnFace&(std::uint32_t)>& alone) {
  ASSERT_EQ(expected.depths, drawn.depths);
  for (std::size_t i = 0; i < drawn.items.size(); ++i) {
    if (drawn.items[i] == kNoItem) {
      ASSERT_EQ(expected.items[i], kNoItem);
      continue;
    }
    const std::uint32_t old = old_id[raster::item_id(drawn.items[i])];
    ASSERT_EQ(raster::is_back_facing(drawn.items[i]), raster::is_back_facing(expected.items[i]));
    if (old == raster::item_id(expected.items[i]))
      continue;
    ASSERT_EQ(alone(old).depths[i], expected.depths[i]) << "no tie, yet polygon " << old;
    ASSERT_NE(alone(old).items[i], kNoItem) << "no tie, yet polygon " << old;
  }
}

// Catches: results that depend on drawing order or on which polygons share a cluster: renumbered
// polygons are sorted into other clusters. Only exact ties may go to another polygon.
TEST_P(Culled, NumbersChangeOnlyWhoWinsATie) {
  Random random(72);
  for (const RandomScene& scene : scenes_) {
    const std::uint32_t count = scene.polygons.count();
    const std::vector<std::uint32_t> old_id = random_order(random, count);
    const PolygonSet renumbered = reordered(scene.polygons, old_id);
    Drawer drawer(scene.polygons.view(), raster::best_kernels());
    Drawer other(renumbered.view(), raster::best_kernels());
    for (std::size_t k = random.index(2) % scene.looks.size(); k < scene.looks.size(); k += 3) {
      Look look = scene.looks[k];
      const auto expected = draw_look(&drawer, look);
      for (std::uint32_t id = 0; id < count && scene.looks[k].view.skip != kNoItem; ++id)
        if (old_id[id] == scene.looks[k].view.skip)
          look.view.skip = id;
      const auto drawn = draw_look(&other, look);
      std::map<std::uint32_t, std::vector<DrawnFace>> lone;
      for (std::size_t d = 0; d < drawn.size(); ++d)
        expect_same_but_for_ties(expected[d], drawn[d], old_id,
                                 [&](std::uint32_t id) -> const DrawnFace& {
                                   auto& faces = lone[id];
                                   if (faces.empty()) {
                                     Look unskipped = look;
                                     unskipped.view.skip = kNoItem;
                                     PolygonSet one;
                                     one.add(scene.polygons.polygon(id));
                                     faces = composed_look(one, unskipped);
                                   }
                                   return faces[d];
                                 });
      ASSERT_FALSE(HasFatalFailure()) << GetParam().name << ", look " << k;
    }
  }
}

// Catches: whatever depends on the window a pixel is drawn in: boxes cut at its sides, tiles
// counted from the grid instead of the window, bounds of depth taken from the wrong corner.
TEST_P(Culled, WindowsDoNotChangeABit) {
  static constexpr int kSizes[][2] = {{16, 16}, {48, 31}, {7, 256}, {256, 5}, {65, 64}};
  Random random(73);
  for (std::size_t s = 0; s < scenes_.size(); ++s) {
    const RandomScene& scene = scenes_[s];
    Drawer drawer(scene.polygons.view(), raster::best_kernels());
    for (std::size_t k = random.index(3); k < scene.looks.size(); k += 4) {
      const auto whole = draw_look(&drawer, scene.looks[k]);
      const int* size = kSizes[random.index(5)];
      ASSERT_EQ(
          difference(scene.looks[k], whole, draw_look(&drawer, scene.looks[k], size[0], size[1])),
          "")
          << name(s, k) << "windows of " << size[0] << " x " << size[1];
    }
  }
}

/// A wall of strips over all of a grid, every border a little before or behind a pixel's centre.
/// @param vertical  whether the borders are columns
PolygonSet strips_between_pixels(Random& random, const raster::PixelGrid& grid, bool vertical) {
  const auto count = static_cast<std::uint32_t>(vertical ? grid.width : grid.height);
  const double begin = vertical ? grid.x0 : grid.y0, step = vertical ? grid.dx : grid.dy;
  std::vector<double> borders = {begin - step, begin + count * step};
  for (int k = 0; k < 300; ++k) {
    const double off = std::pow(10.0, random.between(-7, -0.7)) * (k % 2 == 0 ? 1 : -1);
    borders.push_back(begin + (random.index(count) + off) * step);
  }
  std::sort(borders.begin(), borders.end());
  const double z = std::pow(10.0, random.between(-2, 2));
  PolygonSet strips;
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    const double a = borders[k] * z, b = borders[k + 1] * z;
    strips.add(vertical ? card(a, b, -2 * z, 2 * z, z) : card(-2 * z, 2 * z, a, b, z));
  }
  return strips;
}

// Catches: bounds of polygons, or of boxes, that are rounded by more than their margin where pixels
// have large numbers: the largest hemicubes, and pictures of thousands of pixels a side.
TEST(Culling, NoPixelIsLostBetweenNeighboursOnLargeGrids) {
  Random random(74);
  for (const int size : {512, 2048, 16384, 65536})
    for (const bool vertical : {false, true})
      for (const double half_side : {1.0, 0.01, 9.0}) {
        const double half_height = vertical ? half_side * 16 / size : half_side;
        const Drawing drawing = vertical
                                    ? camera_drawing(size, 16, half_height, random.index(2) == 0)
                                    : camera_drawing(16, size, half_height, random.index(2) == 0);
        const PolygonSet strips = strips_between_pixels(random, drawing.grid, vertical);
        Drawer drawer(strips.view(), raster::best_kernels());
        drawer.begin(straight_view());
        const DrawnFace drawn = drawer.draw(drawing.face, drawing.grid);
        EXPECT_EQ(std::count(drawn.items.begin(), drawn.items.end(), kNoItem), 0)
            << size << (vertical ? " columns" : " rows") << ", half a side is " << half_side;
      }
}

INSTANTIATE_TEST_SUITE_P(, Culled, testing::ValuesIn(kRandomScenes),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace hemicube::test
