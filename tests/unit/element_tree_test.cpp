// Patches cut into elements: nothing is lost, nothing overlaps, no crack opens.

#include "radiosity/mesh/polygon_shape.h"
#include "tests/unit/refine_support.h"

#include <cmath>

namespace hemicube::test {
namespace {

/// Whether every corner of the scene has a vertex of its own.
class ElementTrees : public testing::TestWithParam<bool> {
protected:
  static Scene sheet(std::uint32_t seed) {
    return GetParam() ? with_own_vertices(mixed_sheet(seed)) : mixed_sheet(seed);
  }
};
INSTANTIATE_TEST_SUITE_P(, ElementTrees, testing::Bool(), [](const auto& made) {
  return made.param ? "OwnVertices" : "SharedVertices";
});

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double t = glm::dot(point - a, way) / glm::dot(way, way);
  return glm::length(point - (a + std::clamp(t, 0.0, 1.0) * way));
}

/// Corners of elements in the middle of an edge of another, by their places.
int t_vertices(const PatchSet& mesh) {
  int found = 0;
  for (std::uint32_t e = 0; e < mesh.patch_count(); ++e) {
    const std::vector<Vec3> polygon = polygon_of(mesh, e);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      for (const std::uint32_t corner : mesh.corners) {
        const Vec3& v = mesh.vertices[corner];
        found += v != a && v != b && distance_to_segment(v, a, b) < 1e-9;
      }
    }
  }
  return found;
}

// Catches: a piece that is missing, overlaps another or is turned over; a count that is not that of
// the mesh; elements that name another patch, face or material.
TEST_P(ElementTrees, ElementsFillTheirPatch) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    Cuttable cuttable(sheet(seed));
    const PatchSet& patches = cuttable.patches;
    ASSERT_EQ(patches.patch_count(), 6u);
    cuttable.cut_at_random(seed, 40);
    const PatchSet mesh = cuttable.mesh();
    EXPECT_GT(mesh.patch_count(), 80u);
    EXPECT_EQ(mesh.patch_count(), cuttable.tree.element_count());
    EXPECT_EQ(mesh.front_count, cuttable.tree.leaves().size());
    std::vector<double> area(patches.patch_count());
    for (std::uint32_t e = 0; e < mesh.patch_count(); ++e) {
      const std::uint32_t patch = mesh.parent[e];
      ASSERT_LT(patch, patches.patch_count());
      EXPECT_EQ(e >= mesh.front_count, patch >= patches.front_count);
      if (e < mesh.front_count) {
        EXPECT_EQ(patch, cuttable.tree.patch_of(cuttable.tree.leaves()[e]));
      }
      EXPECT_EQ(mesh.face[e], patches.face[patch]);
      EXPECT_EQ(mesh.material[e], patches.material[patch]);
      EXPECT_EQ(mesh.group[e], patches.group[patch]);
      area[patch] += mesh.area[e];

      const std::vector<Vec3> polygon = polygon_of(mesh, e);
      const radiosity::PolygonShape shape = radiosity::measure_polygon(polygon);
      EXPECT_TRUE(radiosity::is_convex(polygon, shape)) << "element " << e;
      EXPECT_TRUE(radiosity::is_planar(polygon, shape)) << "element " << e;
      EXPECT_NEAR(glm::dot(mesh.normal[e], patches.normal[patch]), 1, 1e-12);
      EXPECT_GT(glm::dot(shape.area_vector, mesh.normal[e]), 0);
    }
    for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
      EXPECT_NEAR(area[patch], patches.area[patch], 1e-12) << "patch " << patch;
  }
}

// Catches: a hanging vertex that is a corner on one side only, halves of an edge that are rounded
// differently from its two sides, edges that are not found where a file repeats vertices.
TEST_P(ElementTrees, NoVertexLiesOnAnEdgeOfANeighbour) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    Cuttable cuttable(sheet(seed));
    cuttable.cut_at_random(seed, 30);
    EXPECT_EQ(t_vertices(cuttable.mesh()), 0) << "seed " << seed;
  }
  // The measure itself: one patch beside two halves of another.
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{1, 0, 0}, {2, 0, 0}, {2, 0.5, 0}, {1, 0.5, 0}});
  builder.face(grey, {{1, 0.5, 0}, {2, 0.5, 0}, {2, 1, 0}, {1, 1, 0}});
  EXPECT_EQ(t_vertices(patches_of(builder.finish())), 2);
}

// Catches: backs that are cut otherwise than their fronts, miss hanging vertices, or come in
// another order.
TEST_P(ElementTrees, BacksAreFrontsReversed) {
  Cuttable cuttable(sheet(3));
  cuttable.cut(2);
  cuttable.cut(cuttable.tree.child(2, 1));
  cuttable.cut_at_random(5, 60); // among them the square it stands on
  const PatchSet mesh = cuttable.mesh();
  std::uint32_t back = mesh.front_count;
  for (std::uint32_t front = 0; front < mesh.front_count; ++front) {
    if (mesh.material[front] == 0)
      continue;
    ASSERT_LT(back, mesh.patch_count());
    std::vector<Vec3> expected = polygon_of(mesh, front);
    std::reverse(expected.begin() + 1, expected.end());
    EXPECT_EQ(polygon_of(mesh, back), expected) << "front " << front;
    EXPECT_EQ(mesh.normal[back], -mesh.normal[front]);
    EXPECT_EQ(mesh.parent[back], 5u);
    ++back;
  }
  EXPECT_EQ(back, mesh.patch_count());
  EXPECT_GT(back - mesh.front_count, 4u);
}

// Catches: leaves in the order they were made, on which the order of elements would depend then.
TEST_P(ElementTrees, OrderOfCutsDoesNotMatter) {
  Cuttable one(sheet(1)), other(sheet(1));
  one.cut(0);
  one.cut(one.tree.child(0, 2));
  one.cut(3);
  other.cut(3);
  other.cut(0);
  other.cut(other.tree.child(0, 2));
  const PatchSet a = one.mesh(), b = other.mesh();
  ASSERT_EQ(a.patch_count(), b.patch_count());
  for (std::uint32_t e = 0; e < a.patch_count(); ++e) {
    EXPECT_EQ(polygon_of(a, e), polygon_of(b, e)) << "element " << e;
    EXPECT_EQ(a.parent[e], b.parent[e]);
  }
}

// Catches: a shape that is cut into other pieces than promised, a count that is not what split
// makes, corners of a node with hanging vertices among them.
TEST_P(ElementTrees, PiecesAreThoseOfTheShape) {
  Cuttable cuttable(sheet(2));
  const std::uint32_t expected[] = {4, 2, 4, 4, 5};
  std::vector<Vec3> corners;
  for (std::uint32_t patch = 0; patch < 5; ++patch) {
    EXPECT_EQ(cuttable.tree.pieces_of(patch, 0), expected[patch]);
    cuttable.cut(patch);
    EXPECT_EQ(cuttable.tree.child_count(patch), expected[patch]);
    EXPECT_FALSE(cuttable.tree.is_leaf(patch));
    for (std::uint32_t k = 0; k < expected[patch]; ++k) {
      const std::uint32_t child = cuttable.tree.child(patch, k);
      EXPECT_TRUE(cuttable.tree.is_leaf(child));
      EXPECT_EQ(cuttable.tree.parent(child), patch);
      EXPECT_EQ(cuttable.tree.patch_of(child), patch);
      EXPECT_EQ(cuttable.tree.side_count(child), patch == 2 ? 2u : 1u);
      cuttable.tree.corners_of(child, &corners);
      EXPECT_EQ(corners.size(), patch == 3 ? 3u : 4u);
    }
  }
  EXPECT_EQ(cuttable.tree.node_count(), 5u + 19u);
}

// Catches: an edge shorter than min_edge, or one that could be halved and is not; the short edges
// of a long quad, which stay whole, counted as well.
TEST_P(ElementTrees, MinEdgeIsTheShortestEdgeACutLeaves) {
  Cuttable cuttable(sheet(4)); // edges are 1 but for rounding
  EXPECT_EQ(cuttable.tree.pieces_of(0, 0.5 - 1e-9), 4u);
  EXPECT_EQ(cuttable.tree.pieces_of(0, 0.5 + 1e-9), 0u);
  EXPECT_EQ(cuttable.tree.pieces_of(1, 2 - 1e-9), 2u);
  EXPECT_EQ(cuttable.tree.pieces_of(1, 2 + 1e-9), 0u);
  EXPECT_EQ(cuttable.tree.pieces_of(3, 0.5 - 1e-9), 4u);
  EXPECT_EQ(cuttable.tree.pieces_of(3, 0.5 + 1e-9), 0u);
}

// Catches: neighbours that are cut finer by two steps and not found, or by one and found; sides of
// the edge that a third element shares.
TEST_P(ElementTrees, UnevenLeavesAreThoseBesideTwoSteps) {
  Cuttable cuttable(sheet(1));
  cuttable.cut(0);
  EXPECT_TRUE(cuttable.tree.uneven_leaves().empty());
  cuttable.cut(cuttable.tree.child(0, 0)); // at the corner of the pentagon
  EXPECT_EQ(cuttable.tree.uneven_leaves(), (std::vector<std::uint32_t>{4}));
  cuttable.cut(cuttable.tree.child(0, 2)); // at the quad, the triangle and the screen
  EXPECT_EQ(cuttable.tree.uneven_leaves(), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  for (std::vector<std::uint32_t> uneven; !(uneven = cuttable.tree.uneven_leaves()).empty();)
    for (const std::uint32_t leaf : uneven)
      cuttable.cut(leaf);
  EXPECT_LT(cuttable.tree.element_count(), 60u);
}

/// Cuts one piece after another until no piece can be cut. @return how often
int cut_to_the_end(Cuttable* cuttable, Random* random) {
  int cuts = 0;
  for (std::uint32_t leaf = 0; cuttable->tree.pieces_of(leaf, 0) > 0; ++cuts) {
    cuttable->tree.split(leaf);
    const std::uint32_t piece =
        random == nullptr ? 0 : random->index(cuttable->tree.child_count(leaf));
    leaf = cuttable->tree.child(leaf, piece);
  }
  return cuts;
}

// Catches: pieces that cannot be measured, after pieces_of said they could; a check of resolution
// that is blind to where the polygon lies, or to slivers; cutting without end at the origin.
TEST(ElementTree, WhatCanBeCutCanBeMeasured) {
  Random random(7);
  const Vec3 far[] = {{0, 0, 0}, {1e3, -2e3, 5e2}, {1e9, 1e9, 0}, {0, 0, 1e14}};
  for (const Vec3& origin : far)
    for (const PolygonSet& set :
         {polygon_soup(1, 20, 1, 0.5, 2), sliver_soup(2, 20, 1e3), sliver_soup(3, 20, 1e6)}) {
      const PolygonSet moved = transformed(set, 1, origin);
      for (std::uint32_t k = 0; k < moved.count(); ++k) {
        SceneBuilder builder(1);
        builder.face(builder.material("grey", 0.5, 1), moved.polygon(k));
        Scene scene = builder.finish();
        PatchSet patches;
        try {
          patches = patches_of(scene);
        } catch (const std::runtime_error&) {
          continue; // no area at that place
        }
        Cuttable cuttable(std::move(scene));
        const int cuts = cut_to_the_end(&cuttable, &random);
        PatchSet mesh;
        const Status status = cuttable.tree.make_mesh(&mesh);
        EXPECT_TRUE(status.ok()) << status.message() << "\nafter " << cuts << " cuts";
        EXPECT_LT(cuts, 600);
      }
    }
  SceneBuilder builder(1);
  builder.face(builder.material("grey", 0.5, 1), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  Cuttable cuttable(builder.finish());
  EXPECT_GT(cut_to_the_end(&cuttable, nullptr), 40);
  PatchSet mesh;
  const Status status = cuttable.tree.make_mesh(&mesh);
  EXPECT_TRUE(status.ok()) << status.message();
}

// Catches: halves that are one of the ends, of which a piece without area would be made.
TEST(ElementTree, WhatDoublesDoNotHalveIsNotCut) {
  const double far = 1e16; // numbers there are 2 apart
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.face(grey, {{far, 0, 0}, {far + 2, 0, 0}, {far + 2, 1e3, 0}, {far, 1e3, 0}});
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  Scene scene = builder.finish();
  PatchSet patches; // measured by hand: the first would be dropped as noise
  require(patches.vertices.append(scene.vertices.span()));
  require(patches.corners.append(scene.corners.span()));
  for (const std::uint32_t offset : {0u, 4u, 8u})
    require(patches.corner_offsets.push_back(offset));
  for (int k = 0; k < 2; ++k) {
    require(patches.material.push_back(0));
    require(patches.area.push_back(1));
    require(patches.normal.push_back(Vec3(0, 0, 1)));
  }
  patches.front_count = 2;
  ElementTree tree;
  require(tree.init(scene, patches));
  EXPECT_EQ(tree.pieces_of(0, 0), 0u);
  EXPECT_EQ(tree.pieces_of(1, 0), 4u);
}

} // namespace
} // namespace hemicube::test
