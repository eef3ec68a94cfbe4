// The rasterizer on one polygon or a few, of which it is known what they show.

#include "tests/support/drawn_face.h"
#include "tests/support/naive_raster.h"
#include "tests/support/polygon_shapes.h"
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

View simple_view() {
  return {};
} // at the origin, along +z

DrawnFace draw_top(const PolygonSet& polygons, const View& view, std::uint32_t resolution = 64) {
  Drawer drawer(polygons.view(), raster::best_kernels());
  drawer.begin(view);
  return drawer.draw(Face::kTop, raster::hemicube_grid(Face::kTop, resolution));
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
      const auto back = turned(reversed(quad), rotation);
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
    polygons.add(turned(facing_quad(), rotation));
  for (const Item item : draw_top(polygons, simple_view()).items)
    EXPECT_TRUE(item == 0 || item == kNoItem) << item;

  PolygonSet backs;
  for (const int rotation : {2, 0, 1})
    backs.add(turned(reversed(facing_quad()), rotation));
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
