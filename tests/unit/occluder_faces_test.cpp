#include "radiosity/form_factor/occluder_faces.h"

#include "tests/support/face_checks.h"
#include "tests/support/reference.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hemicube::test {
namespace {

using radiosity::OccluderFaces;

/// Expects one face with that many corners.
void expect_one_face(const PolygonList& polygons, std::size_t corners) {
  const PatchSet patches = patches_of(polygons);
  const OccluderFaces faces = faces_of(patches);
  expect_faces_cover(patches, faces);
  EXPECT_EQ(faces.face_count(), 1u);
  EXPECT_EQ(faces.corners.size(), corners);
}

std::uint32_t reference_count(const std::string& name) {
  return checked_count(patches_of(reference_scene("scenes/" + name + ".coarse.obj")));
}

// Rows that do not join to walls, corners that stay in the middle of edges.
TEST(OccluderFaces, CubeIsSixSquares) {
  const PatchSet patches = patches_of(cube8());
  const OccluderFaces faces = faces_of(patches);
  expect_faces_cover(patches, faces);
  EXPECT_EQ(faces.face_count(), 6u);
  EXPECT_EQ(faces.corners.size(), 24u);
}

// Rooms of real scenes: walls that meet in T-vertices, door holes, an L-shaped corridor, furniture.
TEST(OccluderFaces, ReferenceRooms) {
  EXPECT_EQ(reference_count("tworooms_a"), 20u);  // of 546 patches
  EXPECT_EQ(reference_count("corridor_a"), 46u);  // of 376; it has nine corners
  EXPECT_EQ(reference_count("tableroom_a"), 37u); // of 391
  EXPECT_EQ(checked_count(patches_of(l_room(8, 0.5, 1))), 10u);
  EXPECT_EQ(checked_count(patches_of(t_vertex_room())), 6u);
}

// A tolerance that is not one of rounding: the left wall is off its plane by 10 um, and no two of
// its pieces are coplanar. The floor's odd quads, around the blocks, join only in places.
TEST(OccluderFaces, CornellKeepsItsWarpedWall) {
  const Scene scene = reference_scene("scenes/cornell.coarse.obj");
  const PatchSet patches = patches_of(scene);
  const OccluderFaces faces = faces_of(patches);
  expect_faces_cover(patches, faces);
  EXPECT_EQ(patches.patch_count(), 617u);
  EXPECT_EQ(faces.face_count(), 263u);
  for (const auto& [name, patch_count, face_count] :
       {std::tuple("red", 81u, 81u), std::tuple("green", 81u, 1u)}) {
    const auto group = static_cast<std::uint32_t>(scene.groups.find(name));
    std::vector<bool> used(faces.face_count());
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
      if (patches.group[p] == group)
        used[faces.face_of_patch[p]] = true;
    EXPECT_EQ(std::count(patches.group.begin(), patches.group.end(), group), patch_count);
    EXPECT_EQ(std::count(used.begin(), used.end(), true), face_count) << name;
  }
}

// Pairing triangles across the wrong side, which leaves slanted strips; relying on shared vertices,
// on an axis, on the order of the patches.
TEST(OccluderFaces, GridsAndTriangulatedGridsAreOneFace) {
  Random random(3);
  for (const auto& [nx, ny] : {std::pair(1, 1), {1, 9}, {8, 8}, {5, 13}, {40, 31}})
    for (int turn = 0; turn < 4; ++turn) {
      PolygonList grid = rectangle_grid(-1, 0.3, 1.7, 2.9, nx, ny);
      if (turn > 0)
        grid = turned(grid, random_frame(random));
      if (turn > 1)
        grid = moved(grid, 1, random.point(-30, 30));
      if (turn > 2)
        for (Polygon& quad : grid) // a parallelogram
          for (Vec3& point : quad)
            point.x += 0.75 * point.y;
      const auto seed = static_cast<std::uint32_t>(nx * 10 + turn);
      expect_one_face(grid, 4);
      expect_one_face(shuffled(grid, seed), 4);
      expect_one_face(in_triangles(grid, seed), 4);
      expect_one_face(shuffled(in_triangles(grid, seed), seed), 4);
    }
}

// Corners that one side has and the other has not: between grids of other counts, in quadtrees,
// where the cells at a T-vertex must not be cut apart.
TEST(OccluderFaces, TVertices) {
  PolygonList halves = rectangle_grid(0, 0, 1, 1, 5, 5);
  append(&halves, rectangle_grid(1, 0, 2, 1, 7, 7));
  expect_one_face(halves, 4);
  PolygonList bricks;
  for (int row = 0; row < 6; ++row)
    append(&bricks, rectangle_grid(0, row, 12, row + 1, row % 2 == 0 ? 6 : 5, 1));
  expect_one_face(bricks, 4);
  PolygonList tree = rectangle_grid(0, 0, 3, 3, 3, 3);
  Random random(5);
  for (int k = 0; k < 40; ++k) {
    const std::size_t split = random.index(static_cast<std::uint32_t>(tree.size()));
    const Polygon cell = tree[split];
    tree.erase(tree.begin() + static_cast<std::ptrdiff_t>(split));
    append(&tree, rectangle_grid(cell[0].x, cell[0].y, cell[2].x, cell[2].y, 2, 2));
    if (k % 5 == 0) {
      const auto seed = static_cast<std::uint32_t>(k);
      expect_one_face(shuffled(tree, seed), 4);
      expect_one_face(turned(tree, random_frame(random)), 4);
    }
  }
}

// Holes that are covered, and notches: no union of areas may pass for a convex one.
TEST(OccluderFaces, HolesStayOpen) {
  const PolygonList wall = rectangle_grid(0, 0, 6, 6, 6, 6);
  const PolygonList door = without(wall, {2, 8, 14});
  const PolygonList window = without(wall, {14, 15, 20, 21});
  const PolygonList notched = without(wall, {35});
  EXPECT_EQ(checked_count(door), 3u);
  EXPECT_EQ(checked_count(window), 4u);
  EXPECT_EQ(checked_count(notched), 2u);
  EXPECT_EQ(checked_count(in_triangles(door, 1)), 3u);
  EXPECT_EQ(checked_count(shuffled(in_triangles(window, 2), 3)), 4u);
  Random random(6);
  EXPECT_EQ(checked_count(turned(window, random_frame(random))), 4u);
  EXPECT_EQ(checked_count(without(rectangle_grid(0, 0, 2, 2, 2, 2), {1, 2})), 2u); // at one point
  for (std::uint32_t seed = 0; seed < 20; ++seed) { // many holes at once
    PolygonList torn = shuffled(rectangle_grid(0, 0, 9, 7, 9, 7), seed);
    torn.resize(40);
    checked_count(torn);
    checked_count(in_triangles(torn, seed));
  }
}

// Decisions that hang on ties or on the unit: what is found may depend on the order only for odd
// outlines, what is covered never.
TEST(OccluderFaces, OrderPlaceAndUnitDoNotMatter) {
  for (const char* name : {"tworooms_a", "corridor_a", "tableroom_a"}) {
    const PolygonList list =
        list_of(patches_of(reference_scene(std::string("scenes/") + name + ".coarse.obj")));
    const std::uint32_t count = checked_count(list);
    EXPECT_EQ(checked_count(moved(list, 1, {1e6, -1e6, 1e6})), count) << name;
    EXPECT_EQ(checked_count(moved(list, 1e-6, {0, 0, 0})), count) << name;
    EXPECT_EQ(checked_count(shuffled(list, 1)), count) << name;
    EXPECT_EQ(checked_count(in_triangles(list, 2)), count) << name;
    const OccluderFaces faces = faces_of(patches_of(list));
    const OccluderFaces scaled = faces_of(patches_of(moved(list, 0x1p20, {0, 0, 0})));
    ASSERT_EQ(scaled.corners.size(), faces.corners.size());
    for (std::size_t k = 0; k < faces.corners.size(); ++k)
      EXPECT_EQ(scaled.corners[k], 0x1p20 * faces.corners[k]); // bit for bit
    EXPECT_TRUE(std::equal(faces.normal.begin(), faces.normal.end(), scaled.normal.begin()));
  }
}

// A fixed tolerance, or one of the scene's size: two pieces that differ by more than the rounding
// of their own coordinates are two.
TEST(OccluderFaces, FoldsAreKept) {
  for (const double fold : {1e-3, 1e-9, 100 * 0x1p-52}) {
    PolygonList two = rectangle_grid(0, 0, 2, 1, 2, 1);
    for (Vec3& point : two[1])
      if (point.x == 2)
        point.z += fold;
    two.push_back({{1e6, 0, 0}, {2e6, 0, 0}, {1e6, 1e6, 0}}); // far away: must not blur it
    EXPECT_EQ(checked_count(two), 3u) << fold;
    two.pop_back();
    EXPECT_EQ(checked_count(moved(two, 1, {8, 0, 4096 * fold})), fold > 1e-10 ? 2u : 1u) << fold;
  }
}

// Bends and curved outlines so slow that no two neighbours show them: the whole must be measured,
// or errors add up. (expect_faces_cover bounds them.)
TEST(OccluderFaces, SlowCurvesDoNotAddUp) {
  for (double bend = 1e-17; bend < 1e-14; bend *= 1.25)
    for (const int axis : {1, 2}) {
      PolygonList strip = rectangle_grid(0, 0, 200, 1, 200, 1);
      for (Polygon& quad : strip)
        for (Vec3& point : quad)
          point[axis] += bend * point.x * point.x;
      checked_count(strip);
      checked_count(shuffled(strip, 1));
    }
}

// Fronts joined with backs.
TEST(OccluderFaces, FrontsAndBacksStayApart) {
  PolygonList sheet = rectangle_grid(0, 0, 3, 2, 3, 2);
  append(&sheet, reversed(sheet));
  EXPECT_EQ(checked_count(sheet), 2u);
  EXPECT_EQ(checked_count(shuffled(sheet, 4)), 2u);
  PolygonList board = rectangle_grid(0, 0, 4, 4, 4, 4);
  for (std::size_t k = 0; k < board.size(); ++k)
    if ((k + k / 4) % 2 == 1)
      std::reverse(board[k].begin(), board[k].end());
  EXPECT_EQ(checked_count(board), 16u);
}

// Areas that add up by chance: a doubled cell and a hole of its size.
TEST(OccluderFaces, DuplicatesAreLeftAlone) {
  PolygonList wall = rectangle_grid(0, 0, 3, 3, 3, 3);
  wall.push_back(wall[4]);
  EXPECT_EQ(checked_count(wall), 6u); // four around the middle, twice the middle
  PolygonList holed = without(rectangle_grid(0, 0, 5, 5, 5, 5), {12});
  holed.push_back(holed[3]);
  checked_count(holed);
  PolygonList twice = rectangle_grid(0, 0, 3, 3, 3, 3);
  append(&twice, twice);
  EXPECT_EQ(checked_count(twice), 18u);
  PolygonList overlapping = rectangle_grid(0, 0, 4, 4, 4, 4); // a tile on a wall: both stay whole
  append(&overlapping, rectangle_grid(1.25, 1.25, 2.75, 2.75, 2, 2));
  EXPECT_EQ(checked_count(overlapping), 2u);
  PolygonList shifted = rectangle_grid(0, 0, 4, 1, 4, 1); // half over the other, corner on corner
  append(&shifted, rectangle_grid(2, 0, 6, 1, 4, 1));
  checked_count(shifted);
}

// Normals of slivers, which are mostly rounding.
TEST(OccluderFaces, Slivers) {
  Random random(8);
  for (const double width : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const PolygonList blinds = rectangle_grid(0, 0, 1, 30 * width, 1, 30);
    expect_one_face(blinds, 4);
    expect_one_face(in_triangles(blinds, 1), 4);
    checked_count(turned(blinds, random_frame(random)));
    PolygonList wall = rectangle_grid(0, 0, 1, 1, 1, 1); // a sliver beside a wall
    wall.push_back({{0, 1, 0}, {1, 1, 0}, {1, 1 + width, 0}, {0, 1 + width, 0}});
    expect_one_face(wall, 4);
    for (const std::array<Vec3, 3>& frame : {random_frame(random), random_frame(random)})
      checked_count(turned(wall, frame));
    for (Vec3& point : wall[1]) // upright on it
      if (point.y != 1)
        point = {point.x, 1, width};
    EXPECT_EQ(checked_count(wall), 2u) << width;
  }
}

// More corners than a face can have, of one patch and of joined ones.
TEST(OccluderFaces, ManyCorners) {
  EXPECT_EQ(checked_count(PolygonList{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), 1u);
  EXPECT_EQ(checked_count(PolygonList{regular(32)}), 1u);
  EXPECT_EQ(checked_count(PolygonList{regular(33)}), 2u);
  EXPECT_EQ(checked_count(PolygonList{regular(48), regular(4)}), 3u);
  EXPECT_EQ(checked_count(PolygonList{regular(400)}), 14u);
  PolygonList pie;
  for (const int corners : {30, 48}) {
    pie.clear();
    const Polygon disk = regular(corners);
    for (std::size_t k = 0; k < disk.size(); ++k)
      pie.push_back({{2, 0, 1}, disk[k], disk[(k + 1) % disk.size()]});
    EXPECT_LE(checked_count(shuffled(pie, 2)), corners == 30 ? 1u : 6u);
  }
  Polygon ruler; // corners on an edge: the fan must not have pieces without area
  for (int k = 0; k <= 100; ++k)
    ruler.push_back({k * 0.25, 0, 0});
  ruler.push_back({25, 1, 0});
  ruler.push_back({0, 1, 0});
  const PatchSet patches = patches_of(PolygonList{ruler});
  const OccluderFaces faces = faces_of(patches);
  expect_faces_cover(patches, faces);
  for (std::uint32_t f = 0; f < faces.face_count(); ++f)
    EXPECT_GT(glm::length(glm::cross(faces.corners_of(f).back() - faces.corners_of(f)[0],
                                     faces.corners_of(f)[1] - faces.corners_of(f)[0])),
              0.1);
}

// Anything joined that should not be: patches without neighbours come out as they were.
TEST(OccluderFaces, SoupsStayAsTheyAre) {
  for (const PolygonSet& soup : {polygon_soup(1, 2000, 1, 0.05, 0.5), sliver_soup(2, 1000, 1e5),
                                 polygon_soup(3, 500, 1e-3, 1, 2, {1e6, 0, 0})}) {
    PolygonList list;
    for (std::uint32_t k = 0; k < soup.count(); ++k)
      list.push_back(soup.polygon(k));
    const PatchSet patches = patches_of(list);
    const OccluderFaces faces = faces_of(patches);
    ASSERT_EQ(faces.face_count(), patches.patch_count());
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
      EXPECT_EQ(faces.face_of_patch[p], p);
      EXPECT_EQ(faces.normal[p], patches.normal[p]);
      const auto corners = faces.corners_of(p);
      EXPECT_TRUE(std::equal(corners.begin(), corners.end(), list[p].begin(), list[p].end()));
    }
  }
  EXPECT_EQ(faces_of(PatchSet()).face_count(), 0u);
}

} // namespace
} // namespace hemicube::test
