#include "bench/refinement/merged_quads.h"

#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hemicube::bench {
namespace {

using radiosity::Scene;

struct Face {
  std::vector<std::uint32_t> corners;
  std::uint32_t material, group;
};

std::vector<Face> faces_of(const Scene& scene) {
  std::vector<Face> faces;
  for (std::size_t f = 0; f < scene.face_count(); ++f)
    faces.push_back({{scene.corners.begin() + scene.corner_offsets[f],
                      scene.corners.begin() + scene.corner_offsets[f + 1]},
                     scene.face_material[f],
                     scene.face_group[f]});
  return faces;
}

/// Whether b lies on the way from a to c.
bool is_between(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 way = c - a;
  return glm::length(glm::cross(b - a, way)) < 1e-3 * glm::dot(way, way);
}

/// The corner of a quad that is `steps` after a vertex.
std::uint32_t after(const Face& quad, std::uint32_t vertex, std::size_t steps) {
  const auto at = std::find(quad.corners.begin(), quad.corners.end(), vertex);
  return quad.corners[(static_cast<std::size_t>(at - quad.corners.begin()) + steps) % 4];
}

/// The quad that four quads around a vertex make up; without corners if they make up none.
Face merged(const Scene& scene, std::vector<const Face*> around, std::uint32_t vertex) {
  Face whole{{}, around[0]->material, around[0]->group};
  // Each quad follows the one whose last edge is its first.
  for (std::size_t k = 0; k + 1 < around.size(); ++k)
    for (std::size_t m = k + 1; m < around.size(); ++m)
      if (after(*around[m], vertex, 1) == after(*around[k], vertex, 3))
        std::swap(around[k + 1], around[m]);
  for (std::size_t k = 0; k < 4; ++k) {
    const Face& quad = *around[k];
    const Face& next = *around[(k + 1) % 4];
    if (quad.material != whole.material || after(next, vertex, 1) != after(quad, vertex, 3) ||
        !is_between(scene.vertices[after(quad, vertex, 2)], scene.vertices[after(quad, vertex, 3)],
                    scene.vertices[after(next, vertex, 2)]))
      return {{}, 0, 0};
    whole.corners.push_back(after(quad, vertex, 2));
  }
  return whole;
}

} // namespace

Scene merge_quads(const Scene& scene, int rounds) {
  std::vector<Face> faces = faces_of(scene);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::vector<std::size_t>> around(scene.vertices.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const std::uint32_t corner : faces[f].corners)
        around[corner].push_back(f);
    for (std::uint32_t vertex = 0; vertex < around.size(); ++vertex) {
      std::vector<const Face*> quads;
      for (const std::size_t f : around[vertex])
        if (faces[f].corners.size() == 4)
          quads.push_back(&faces[f]);
      if (around[vertex].size() != 4 || quads.size() != 4)
        continue;
      const Face whole = merged(scene, quads, vertex);
      if (whole.corners.empty())
        continue;
      for (const std::size_t f : around[vertex])
        faces[f].corners.clear(); // used up for this round
      faces.push_back(whole);
    }
    std::erase_if(faces, [](const Face& face) { return face.corners.empty(); });
  }
  Scene coarse;
  const auto assign = [](const auto& from, auto* to) { test::require(to->assign(from)); };
  for (std::uint32_t b = 0; b < scene.bands.size(); ++b)
    test::require(coarse.bands.add(scene.bands[b]));
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
    test::require(coarse.materials.add(scene.materials[m]));
  for (std::uint32_t g = 0; g < scene.groups.size(); ++g)
    test::require(coarse.groups.add(scene.groups[g]));
  assign(scene.reflectance, &coarse.reflectance);
  assign(scene.exitance, &coarse.exitance);
  assign(scene.two_sided, &coarse.two_sided);
  assign(scene.space_exitance, &coarse.space_exitance);
  assign(scene.vertices, &coarse.vertices);
  test::require(coarse.corner_offsets.push_back(0));
  for (const Face& face : faces) {
    test::require(coarse.corners.append(std::span<const std::uint32_t>(face.corners)));
    test::require(coarse.corner_offsets.push_back(coarse.corners.size()));
    test::require(coarse.face_material.push_back(face.material));
    test::require(coarse.face_group.push_back(face.group));
  }
  return coarse;
}

} // namespace hemicube::bench
