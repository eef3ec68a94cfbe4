#include "radiosity/form_factor/occluder_tree.h"

#include "tests/support/face_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hemicube::test {
namespace {

using radiosity::OccluderFaces;
using radiosity::OccluderTree;

OccluderTree tree_of(const OccluderFaces& faces) {
  OccluderTree tree;
  require(tree.build(faces));
  return tree;
}

std::vector<std::uint32_t> found(const OccluderTree& tree, const Vec3& low, const Vec3& high) {
  std::vector<std::uint32_t> faces;
  tree.for_each_in_box(low, high, [&](std::uint32_t face) {
    faces.push_back(face);
    return true;
  });
  return faces;
}

/// By the words of the promise, axis by axis.
bool overlap(double a, double b, double c, double d) {
  if (a == b && c == d)
    return a == c;
  if (a == b)
    return c < a && a < d;
  if (c == d)
    return a < c && c < b;
  return a < d && c < b;
}

std::set<std::uint32_t> expected(const OccluderFaces& faces, const Vec3& low, const Vec3& high) {
  std::set<std::uint32_t> all;
  for (std::uint32_t f = 0; f < faces.face_count(); ++f) {
    bool overlaps = true;
    for (int axis = 0; axis < 3; ++axis) {
      double a = INFINITY, b = -INFINITY;
      for (const Vec3& corner : faces.corners_of(f)) {
        a = std::min(a, corner[axis]);
        b = std::max(b, corner[axis]);
      }
      overlaps = overlaps && overlap(a, b, low[axis], high[axis]);
    }
    if (overlaps)
      all.insert(f);
  }
  return all;
}

void expect_as_brute_force(const PatchSet& patches, double (*coordinate)(Random&)) {
  const OccluderFaces faces = faces_of(patches);
  const OccluderTree tree = tree_of(faces);
  ASSERT_EQ(tree.face_count(), faces.face_count());
  Random random(9);
  for (int k = 0; k < 3000; ++k) {
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = coordinate(random), b = random.index(4) == 0 ? a : coordinate(random);
      low[axis] = std::min(a, b);
      high[axis] = std::max(a, b);
    }
    const std::vector<std::uint32_t> actual = found(tree, low, high);
    const std::set<std::uint32_t> wanted = expected(faces, low, high);
    EXPECT_EQ(actual.size(), wanted.size()); // none twice
    EXPECT_EQ(std::set(actual.begin(), actual.end()), wanted);
  }
}

// Flat boxes, and sides that touch, against strict and closed comparisons mixed up: all coordinates
// are multiples of a quarter, so that every case of the promise occurs often.
TEST(OccluderTree, FlatAndTouchingBoxesAsBruteForce) {
  Random random(10);
  PolygonList tiles;
  for (int k = 0; k < 400; ++k) {
    const int axis = static_cast<int>(random.index(3));
    const Vec3 corner(random.index(8) * 0.25, random.index(8) * 0.25, random.index(8) * 0.25);
    Vec3 u(0, 0, 0), v(0, 0, 0);
    u[(axis + 1) % 3] = 0.25 * (1 + random.index(4));
    v[(axis + 2) % 3] = 0.25 * (1 + random.index(4));
    tiles.push_back({corner, corner + u, corner + u + v, corner + v});
  }
  expect_as_brute_force(patches_of(tiles), [](Random& r) { return r.index(13) * 0.25; });
}

// Nodes that lose faces.
TEST(OccluderTree, SoupAsBruteForce) {
  PolygonList list;
  const PolygonSet soup = polygon_soup(4, 1500, 1, 0.02, 0.4);
  for (std::uint32_t k = 0; k < soup.count(); ++k)
    list.push_back(soup.polygon(k));
  expect_as_brute_force(patches_of(list), [](Random& r) { return r.between(-1.2, 1.2); });
  expect_as_brute_force(patches_of(t_vertex_room()), [](Random& r) { return r.between(-1, 5); });
}

// The promise in one picture: a box that fills a room is not blocked by its walls.
TEST(OccluderTree, WallsOfTheBoxDoNotBlockIt) {
  const OccluderFaces faces = faces_of(patches_of(cube8()));
  const OccluderTree tree = tree_of(faces);
  EXPECT_TRUE(found(tree, {0, 0, 0}, {1, 1, 1}).empty());
  EXPECT_EQ(found(tree, {-1, 0, 0}, {1, 1, 1}).size(), 1u); // x = 0 lies inside
  EXPECT_EQ(found(tree, {-1, -1, -1}, {2, 2, 2}).size(), 6u);
  EXPECT_EQ(found(tree, {0, 0, 0}, {0, 1, 1}).size(), 1u); // flat in the wall x = 0
  EXPECT_TRUE(found(tree, {0.5, 0, 0}, {0.5, 1, 1}).empty());
}

// Going on after visit said stop; no faces; many in one place, where halving cannot tell them
// apart.
TEST(OccluderTree, StopsAndExtremes) {
  EXPECT_TRUE(found(tree_of(OccluderFaces()), {-1, -1, -1}, {1, 1, 1}).empty());
  PolygonList same;
  for (int k = 0; k < 1000; ++k)
    same.push_back({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}});
  const OccluderTree tree = tree_of(faces_of(patches_of(same)));
  EXPECT_EQ(found(tree, {0, 0, 0}, {1, 1, 1}).size(), 1000u);
  int visits = 0;
  tree.for_each_in_box({0, 0, 0}, {1, 1, 1}, [&](std::uint32_t) { return ++visits < 7; });
  EXPECT_EQ(visits, 7);
}

} // namespace
} // namespace hemicube::test
