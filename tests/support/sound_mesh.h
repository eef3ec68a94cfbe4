#pragma once

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_topology.h"
#include "radiosity/mesh/polygon_shape.h"
#include "tests/support/polygon_of.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

/// What every mesh of cut patches must be.
namespace hemicube::test {

inline PatchSet fronts_of(const Scene& scene) {
  PatchSet patches;
  radiosity::MeshReport report;
  require(radiosity::build_patches(scene, &patches, &report));
  return patches;
}

/// Of all edges, as often as they have a patch on one side and none on the other.
inline double border_length(const PatchSet& set) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides; // left ones minus right ones
  for (std::uint32_t p = 0; p < set.patch_count(); ++p) {
    const auto corners = set.corners_of(p);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % corners.size()];
      sides[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  double sum = 0;
  for (const auto& [edge, count] : sides)
    sum += std::abs(count) * glm::length(set.vertices[edge.first] - set.vertices[edge.second]);
  return sum;
}

/// The cells tile their patches, are convex, meet without T-vertices, and agree on the light across
/// their edges.
inline void expect_sound(const PatchSet& patches, const PatchSet& cells) {
  std::vector<double> area(patches.patch_count());
  for (std::uint32_t c = 0; c < cells.patch_count(); ++c) {
    const std::vector<Vec3> points = polygon_of(cells, c);
    const radiosity::PolygonShape shape = radiosity::measure_polygon(points);
    ASSERT_TRUE(radiosity::has_area(points, shape)) << "cell " << c;
    ASSERT_TRUE(radiosity::is_convex(points, shape)) << "cell " << c;
    ASSERT_GT(glm::dot(cells.normal[c], patches.normal[cells.parent[c]]), 0.999) << "cell " << c;
    area[cells.parent[c]] += cells.area[c];
  }
  for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
    ASSERT_NEAR(area[p] / patches.area[p], 1, 1e-9) << "patch " << p;
  const double border = border_length(patches);
  EXPECT_NEAR(border_length(cells), border, 1e-9 * (1 + border));
  radiosity::HalfEdges half_edges;
  require(radiosity::build_half_edges(cells, &half_edges));
  std::map<std::pair<std::uint32_t, std::uint32_t>, radiosity::EdgeLight> light;
  for (std::uint32_t c = 0; c < cells.patch_count(); ++c) {
    const auto corners = cells.corners_of(c);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % corners.size()];
      const radiosity::EdgeLight own = cells.light_across(cells.corner_offsets[c] + k);
      const auto [at, is_new] = light.try_emplace(std::minmax(a, b), own);
      EXPECT_EQ(at->second, own) << "edge " << a << " " << b;
    }
  }
}

} // namespace hemicube::test
