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

// ---------------------------------------------------------------------------------------------------

View simple_view() {
  return {};
} // at the origin, along +z

DrawnFace draw_top(const PolygonSet& polygons, const View& view, std::uint32_t resolution = 64) {
  Drawer drawer(polygons.view(), raster::best_kernels());
  drawer.begin(view);
  return drawer.draw(Face::kTop, raster::hemicube_grid(Face::kTop, resolution));
}

std::vector<Vec3> reversed(std::vector<Vec3> polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

std::vector<Vec3> rotated(std::vector<Vec3> polygon, int by) {
  std::rotate(polygon.begin(), polygon.begin() + by, polygon.end());
  return polygon;
}

/// A tilted quad over the origin that faces it.
std::vector<Vec3> facing_quad() {
  return {{-1.1, 1.3, 1.7}, {1.2, 1.3, 1.4}, {1.2, -0.9, 1.2}, {-1.1, -0.9, 1.5}};
}

// Catches: depth planes that depend on the direction or the start of the corners.
TEST(Raster, TheFacingCopyOfAQuadWinsInAnyOrder) {
  for (int rotation = 0; rotation < 4; ++rotation)
    for (const bool facing_first : {true, false}) {
      PolygonSet polygons;
      const auto quad = facing_quad();
      const auto back = rotated(reversed(quad), rotation);
      polygons.add(facing_first ? quad : back);
      polygons.add(facing_first ? back : quad);
      const Item facing = facing_first ? 0 : 1;
      int seen = 0;
      for (const Item item : draw_top(polygons, simple_view()).items) {
        EXPECT_TRUE(item == facing || item == kNoItem) << item;
        seen += item == facing;
      }
      EXPECT_GT(seen, 1000);
    }
}

// Catches: "last drawn wins", and ties broken by anything but the id.
TEST(Raster, TheLowestIdWinsAmongCoincidentPolygons) {
  PolygonSet polygons;
  for (const int rotation : {2, 0, 1, 3})
    polygons.add(rotated(facing_quad(), rotation));
  for (const Item item : draw_top(polygons, simple_view()).items)
    EXPECT_TRUE(item == 0 || item == kNoItem) << item;

  PolygonSet backs;
  for (const int rotation : {2, 0, 1})
    backs.add(rotated(reversed(facing_quad()), rotation));
  for (const Item item : draw_top(backs, simple_view()).items)
    EXPECT_TRUE(item == (0 | raster::kBackFacing) || item == kNoItem) << item;
}

// Catches: backs drawn although not asked for, or not drawn although asked for.
TEST(Raster, BacksAreDrawnOnlyIfAskedFor) {
  PolygonSet polygons;
  polygons.add(reversed(facing_quad()));
  View view = simple_view();
  const DrawnFace with = draw_top(polygons, view);
  EXPECT_GT(std::count(with.items.begin(), with.items.end(), Item(0) | raster::kBackFacing), 1000);
  view.draw_backs = false;
  for (const Item item : draw_top(polygons, view).items)
    EXPECT_EQ(item, kNoItem);
}

// Catches: View::skip taken as something else than the one id.
TEST(Raster, TheSkippedPolygonIsNotDrawn) {
  PolygonSet polygons;
  polygons.add(facing_quad());
  polygons.add(facing_quad());
  View view = simple_view();
  view.skip = 0;
  for (const Item item : draw_top(polygons, view).items)
    EXPECT_TRUE(item == 1 || item == kNoItem);
}

// Real quads are bent a little: here by half of what still counts as planar.
// Catches: a patch that sees its own corners rise over its horizon.
TEST(Raster, ABentPatchIsNotInItsOwnView) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 2e-3}, {0, 1, 0}});
  builder.face(grey, {{0.1, 0, 0}, {1, 0.3, 0}, {1.1, 1, 2e-3}, {0, 1, 0}});
  const PatchSet patches = patches_of(builder.finish());
  ASSERT_EQ(patches.patch_count(), 2u) << "they count as planar";
  Drawer drawer(radiosity::polygons_of(patches), raster::best_kernels());
  for (std::uint32_t patch = 0; patch < 2; ++patch) {
    const View view = radiosity::hemicube_view(patches, patch);
    EXPECT_EQ(view.skip, patch);
    drawer.begin(view);
    for (const Face face : kFaces)
      for (const Item item : drawer.draw(face, raster::hemicube_grid(face, 2048)).items)
        ASSERT_TRUE(item == kNoItem || raster::item_id(item) != patch);
  }
}

// Catches: NaN or garbage from polygons in the eye's plane, in the receiver's plane, or through the
// eye.
TEST(Raster, EdgeOnPolygonsAreNotDrawn) {
  PolygonSet polygons;
  polygons.add({{0, -1, 1}, {0, 1, 1}, {0, 1, 3}, {0, -1, 3}});     // the plane x = 0 holds the eye
  polygons.add({{1, -1, 1}, {1, 1, 1}, {3, 1, 3}, {3, -1, 3}});     // x = z too
  polygons.add({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});       // in the receiver's plane
  polygons.add({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});   // and under the eye
  polygons.add({{1, 0, 1e-7}, {2, 0, 0}, {2, 1, 1e-7}, {1, 1, 0}}); // within 2^-20 of it
  for (const std::string& isa : kernels_here()) {
    Drawer drawer(polygons.view(), *raster::kernels_by_name(isa));
    drawer.begin(simple_view());
    for (const Face face : kFaces)
      for (const Item item : drawer.draw(face, raster::hemicube_grid(face, 64)).items)
        EXPECT_EQ(item, kNoItem) << isa << ", face " << static_cast<int>(face);
  }
}

// Catches: a wall that starts exactly in the receiver's plane, clipped away by a near plane.
TEST(Raster, AWallThatTouchesTheReceiversPlaneCoversItsHalfOfASide) {
  PolygonSet polygons;
  polygons.add({{1e-3, -1, 0}, {1e-3, -1, 2}, {1e-3, 1, 2}, {1e-3, 1, 0}});
  Drawer drawer(polygons.view(), raster::best_kernels());
  drawer.begin(simple_view());
  for (const Item item : drawer.draw(Face::kPlusX, raster::hemicube_grid(Face::kPlusX, 64)).items)
    EXPECT_EQ(item, 0u);
  for (const Item item : drawer.draw(Face::kMinusX, raster::hemicube_grid(Face::kMinusX, 64)).items)
    EXPECT_EQ(item, kNoItem);
}

// Catches: faces that overlap or leave a gap between them, and axes that disagree with the
// documented ones: every direction above the horizon belongs to the window of exactly one face.
TEST(Raster, EveryDirectionBelongsToOneFace) {
  Random random(14);
  for (int i = 0; i < 100000; ++i) {
    Vec3 direction = random.point(-1, 1);
    direction.z = std::fabs(direction.z);
    int owners = 0;
    for (const Face face : kFaces) {
      const Vec3 v = raster::to_face(face, direction);
      EXPECT_EQ(raster::from_face(face, v), direction);
      owners += v.z > 0 && std::fabs(v.x) < v.z && std::fabs(v.y) < v.z;
    }
    EXPECT_EQ(owners, 1);
  }
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Vec3 expected[5][3] = {{x, y, z}, {y, z, x}, {-y, z, -x}, {-x, z, y}, {x, z, -y}};
  for (int f = 0; f < raster::kFaceCount; ++f) {
    EXPECT_EQ(raster::from_face(kFaces[f], x), expected[f][0]);
    EXPECT_EQ(raster::from_face(kFaces[f], y), expected[f][1]);
    EXPECT_EQ(raster::from_face(kFaces[f], z), expected[f][2]);
    EXPECT_EQ(glm::cross(expected[f][0], expected[f][1]), expected[f][2]);
  }
}

// Catches: pixels that two faces draw differently at a seam: a polygon over a corner of the
// hemicube must cover, on the three faces together, what its exact outline covers. The pixel rows
// of two faces meet at the seam without a gap: the last row of a side and the first column of the
// top are neighbours.
TEST(Raster, APolygonOverACornerIsWholeOnItsThreeFaces) {
  PolygonSet polygons;
  polygons.add({{0.7, 0.9, 1.1}, {0.9, 1.2, 0.8}, {1.3, 0.8, 0.9}});
  polygons.add(reversed(polygons.polygon(0)));
  for (const std::string& isa : kernels_here()) {
    Drawer drawer(polygons.view(), *raster::kernels_by_name(isa));
    drawer.begin(simple_view());
    int faces = 0;
    for (const Face face : kFaces) {
      const auto grid = raster::hemicube_grid(face, 256);
      const NaiveImage naive = naive_image(polygons.view(), simple_view(), face, grid);
      int covered = 0, expected = 0;
      const DrawnFace drawn = drawer.draw(face, grid);
      for (std::size_t i = 0; i < drawn.items.size(); ++i) {
        covered += drawn.items[i] != kNoItem;
        expected += naive.pixels[i].item != kNoItem;
      }
      EXPECT_EQ(covered, expected) << isa << ", face " << static_cast<int>(face);
      faces += covered > 0;
    }
    EXPECT_EQ(faces, 3);
  }
}

// Catches: a polygon seen exactly edge-on, but for rounding, that is drawn with rounding errors for
// depth: the eye lies in its plane, on its border or beside it, so it covers nothing.
TEST(Raster, APolygonWhosePlaneHoldsTheEyeIsNotDrawn) {
  Random random(21);
  for (int round = 0; round < 300; ++round) {
    const Vec3 u = unit(random.point(-1, 1)), across = unit(glm::cross(u, random.point(-1, 1)));
    View view = simple_view();
    view.eye = round % 2 == 0 ? Vec3(0, 0, 0) : random.point(-3, 3);
    const double a = random.between(-1, 1), b = random.between(0, 1);
    PolygonSet polygons; // one corner of some is the eye itself
    const Vec3 start = view.eye + (round % 3 == 0 ? Vec3(0, 0, 0) : u * a + across * b);
    polygons.add({start, start + u, start + u + across, start + across});
    Drawer drawer(polygons.view(), *raster::kernels_by_name("scalar"));
    drawer.begin(view);
    for (const Face face : kFaces)
      for (const Item item : drawer.draw(face, raster::hemicube_grid(face, 64)).items)
        ASSERT_EQ(item, kNoItem) << "round " << round;
  }
}

} // namespace
} // namespace hemicube::test
