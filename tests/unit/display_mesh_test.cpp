#include "radiosity/output/display_mesh.h"

#include "radiosity/elementary.h"
#include "tests/support/graded_mesh.h"
#include "tests/unit/output_support.h"

#include <set>

namespace hemicube::radiosity::test {
namespace {

/// A mesh in which every patch has a material of its own, so that its triangles are known, and
/// light that differs from vertex to vertex.
struct Displayed {
  explicit Displayed(Scene&& given)
      : scene(std::move(given)), patches(hemicube::test::patches_of(scene)) {
    for (const std::uint32_t vertex : patches.corners)
      light.push_back(static_cast<float>(1 + vertex * 7919 % 101));
    require(build_display_mesh(scene, patches, gather_corner_vertices(patches, light, 1), &mesh));
  }

  Vec3 position(std::uint32_t vertex) const { return triple(mesh.positions, vertex); }
  static Vec3 triple(const std::vector<float>& values, std::uint32_t vertex) {
    const float* at = &values[std::size_t{3} * vertex];
    return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
  }
  /// Twice the area of a triangle, along its front's normal.
  Vec3 double_area(std::size_t first) const {
    const Vec3 a = position(mesh.triangles[first]);
    return glm::cross(position(mesh.triangles[first + 1]) - a,
                      position(mesh.triangles[first + 2]) - a);
  }

  Scene scene;
  PatchSet patches;
  std::vector<float> light; ///< [corner]
  DisplayMesh mesh;
};

/// Squares of 1/4 to 1/64 with hanging vertices, in general position.
Displayed graded_sheet() {
  SceneBuilder builder(1);
  add_graded_sheet(&builder, {{0.3, -0.7, 0.2}, {0.8, 0.36, 0.48}, {-0.6, 0.48, 0.64}},
                   hemicube::test::splits_at_random(3), [&](double x, double y, double size) {
                     return builder.material(std::to_string(x) + " " + std::to_string(y) + " " +
                                                 std::to_string(size),
                                             0.5, 0);
                   });
  return Displayed(builder.finish());
}

/// Convex polygons of 3 to 9 corners.
Displayed polygons() {
  SceneBuilder builder(1);
  for (int count = 3; count < 10; ++count) {
    std::vector<Vec3> corners;
    for (int k = 0; k < count; ++k) {
      const double t = (k + 0.5) / count - 0.5; // on a parabola
      corners.push_back({t, t * t, static_cast<double>(count)});
    }
    builder.face(builder.material(std::to_string(count), 0.5, 0), corners);
  }
  return Displayed(builder.finish());
}

// Catches: triangles that overlap, leave a part out, look backwards or are flat; wrong light at a
// corner; triangles given to another material.
TEST(DisplayMesh, TrianglesCoverEveryPatchOnceAndCarryTheLightOfItsCorners) {
  for (const Displayed& shown : {graded_sheet(), polygons()})
    for (std::uint32_t patch = 0; patch < shown.patches.patch_count(); ++patch) {
      const std::uint32_t material = shown.patches.material[patch];
      double area = 0;
      std::set<std::uint32_t> vertices;
      for (std::size_t k = shown.mesh.first[material]; k < shown.mesh.first[material + 1]; k += 3) {
        const double part = glm::dot(shown.double_area(k), shown.patches.normal[patch]) / 2;
        EXPECT_GT(part, 1e-3 * shown.patches.area[patch]);
        area += part;
        vertices.insert(&shown.mesh.triangles[k], &shown.mesh.triangles[k] + 3);
      }
      EXPECT_NEAR(area / shown.patches.area[patch], 1, 1e-5);
      const auto corners = shown.patches.corners_of(patch);
      std::size_t found = 0;
      for (std::size_t k = 0; k < corners.size(); ++k)
        for (const std::uint32_t vertex : vertices)
          if (glm::distance(shown.position(vertex), shown.patches.vertices[corners[k]]) < 1e-6) {
            const float light = shown.light[shown.patches.corner_offsets[patch] + k];
            const float radiance = shown.mesh.radiances[std::size_t{3} * vertex];
            EXPECT_FLOAT_EQ(radiance, light / static_cast<float>(kPi));
            ++found;
          }
      EXPECT_EQ(found, corners.size());
      EXPECT_LE(vertices.size(), corners.size() + 1) << "a centre at most";
    }
}

// Catches: hanging vertices that are no corner of a triangle of the large patch: cracks.
TEST(DisplayMesh, EveryInnerEdgeHasATriangleOnBothSides) {
  const Displayed shown = graded_sheet();
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t k = 0; k < shown.mesh.triangles.size(); k += 3)
    for (std::size_t side = 0; side < 3; ++side)
      EXPECT_TRUE(
          edges.insert({shown.mesh.triangles[k + side], shown.mesh.triangles[k + (side + 1) % 3]})
              .second);
  double open = 0; // length of the edges without a neighbour: the circumference
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a}))
      open += glm::distance(shown.position(a), shown.position(b));
  EXPECT_NEAR(open, 4, 1e-4);
}

// Catches: quads cut along the diagonal that makes a ridge or a valley.
TEST(DisplayMesh, QuadsAreCutBetweenTheCornersOfMostEqualLight) {
  const auto diagonal = [](const std::vector<Vec3>& corners, const std::vector<float>& light) {
    SceneBuilder builder(1);
    builder.face(builder.material("grey", 0.5, 0), corners);
    const Scene scene = builder.finish();
    const PatchSet patches = patches_of(scene);
    DisplayMesh mesh;
    require(build_display_mesh(scene, patches, gather_corner_vertices(patches, light, 1), &mesh));
    EXPECT_EQ(mesh.triangles.size(), 6u);
    std::set<std::uint32_t> first(mesh.triangles.begin(), mesh.triangles.begin() + 3), both;
    for (std::size_t k = 3; k < 6; ++k)
      if (first.contains(mesh.triangles[k]))
        both.insert(mesh.triangles[k]);
    return both;
  };
  const std::set<std::uint32_t> even = {0, 2}, odd = {1, 3};
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(diagonal(square, {5, 1, 6, 9}), even);
  EXPECT_EQ(diagonal(square, {1, 5, 9, 6}), odd);
  const std::vector<Vec3> kite = {{0, 0, 0}, {1, -1, 0}, {4, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(diagonal(kite, {3, 3, 3, 3}), odd) << "the shorter one where light does not tell";
}

// Catches: triangles without area, which normals and ray casters of other programs stumble over.
TEST(DisplayMesh, PatchesThatFloatPositionsCollapseAreLeftOut) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.face(grey, {{1e8, 0, 0}, {1e8 + 1, 0, 0}, {1e8 + 1, 1, 0}, {1e8, 1, 0}});
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Displayed shown(builder.finish());
  EXPECT_EQ(shown.patches.patch_count(), 2u);
  EXPECT_EQ(shown.mesh.triangles.size(), 3u);
}

// Catches: a patch of more corners than are interpolated, read beyond its weights.
TEST(DisplayMesh, PatchesOfManyHangingVerticesHaveACentreToo) {
  SceneBuilder builder(1);
  std::vector<Vec3> corners;
  for (int k = 0; k < 100; ++k)
    corners.push_back({k / 100.0, 0, 0});
  corners.push_back({1, 0, 0});
  corners.push_back({0, 1, 0});
  builder.face(builder.material("grey", 0.5, 0), corners);
  const Displayed shown(builder.finish());
  EXPECT_EQ(shown.mesh.triangles.size(), 3 * corners.size());
  EXPECT_EQ(shown.mesh.vertex_count(), corners.size() + 1);
}

} // namespace
} // namespace hemicube::radiosity::test
