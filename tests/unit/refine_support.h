#pragma once

#include "radiosity/refine/element_tree.h"
#include "tests/support/polygon_of.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

/// Patches that are cut by hand, for the tests of what adaptive meshing is made of.
namespace hemicube::test {

using radiosity::ElementTree;

/// A scene, its patches with backs, and how they are cut. Stays where it was made.
struct Cuttable {
  explicit Cuttable(Scene made) : scene(std::move(made)), patches(patches_of(scene)) {
    require(tree.init(scene, patches));
  }
  Cuttable(const Cuttable&) = delete;
  Cuttable& operator=(const Cuttable&) = delete;

  PatchSet mesh() const {
    PatchSet elements;
    require(tree.make_mesh(&elements));
    return elements;
  }
  /// Cuts leaves drawn by lot; those near the last one drawn more often, so that cuts are deep.
  void cut_at_random(std::uint32_t seed, int cuts) {
    Random random(seed);
    for (int k = 0; k < cuts; ++k) {
      const std::vector<std::uint32_t> leaves = tree.leaves();
      const bool is_near = random.index(2) == 0;
      const auto few = static_cast<std::uint32_t>(std::min<std::size_t>(leaves.size(), 4));
      const std::uint32_t leaf =
          leaves[random.index(is_near ? few : static_cast<std::uint32_t>(leaves.size()))];
      if (tree.pieces_of(leaf, 1e-6) > 0)
        tree.split(leaf);
    }
  }
  /// Cuts a leaf that must be one.
  void cut(std::uint32_t leaf) {
    ASSERT_TRUE(tree.is_leaf(leaf));
    ASSERT_GT(tree.pieces_of(leaf, 0), 0u);
    tree.split(leaf);
  }

  Scene scene;
  PatchSet patches;
  ElementTree tree;
};

/// A square, a quad 4 times as long as wide, a triangle and a pentagon, each with an edge in common
/// with the square, and a two-sided square that stands on one of those edges: turned at random.
inline Scene mixed_sheet(std::uint32_t seed) {
  Random random(seed);
  const auto frame = random_frame(random);
  const auto at = [&](double x, double y, double z = 0) {
    return x * frame[0] + y * frame[1] + z * frame[2];
  };
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  const std::uint32_t screen = builder.material("screen", 0.3, 0);
  builder.two_sided(screen);
  builder.face(grey, {at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
  builder.face(grey, {at(1, 0), at(5, 0), at(5, 1), at(1, 1)});
  builder.face(screen, {at(0, 1), at(1, 1), at(1, 1, 1), at(0, 1, 1)});
  builder.face(grey, {at(0, 1), at(1, 1), at(0.5, 2)});
  builder.face(grey, {at(0, 0), at(-0.3, -0.7), at(0.5, -1.2), at(1.3, -0.7), at(1, 0)});
  return builder.finish();
}

/// The same faces, every corner with a vertex of its own, as some files have it.
inline Scene with_own_vertices(Scene scene) {
  std::vector<Vec3> vertices;
  for (std::uint32_t& corner : scene.corners) {
    vertices.push_back(scene.vertices[corner]);
    corner = static_cast<std::uint32_t>(vertices.size() - 1);
  }
  require(scene.vertices.assign(std::span<const Vec3>(vertices)));
  return scene;
}

} // namespace hemicube::test
