#pragma once

#include "radiosity/mesh/build_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace hemicube::radiosity::mesh_scenes {

using Face = std::vector<std::uint32_t>;

/// A scene of faces over given vertices; material 0 is one-sided, material 1 two-sided.
inline Scene scene_of(const std::vector<Vec3>& vertices, const std::vector<Face>& faces) {
  Scene scene;
  EXPECT_TRUE(scene.vertices.assign(vertices).ok());
  EXPECT_TRUE(scene.two_sided.push_back(0).ok() && scene.two_sided.push_back(1).ok());
  EXPECT_TRUE(scene.corner_offsets.push_back(0).ok());
  for (const Face& face : faces) {
    EXPECT_TRUE(scene.corners.append(face).ok());
    EXPECT_TRUE(scene.corner_offsets.push_back(scene.corners.size()).ok());
    EXPECT_TRUE(scene.face_material.push_back(0).ok() && scene.face_group.push_back(0).ok());
  }
  return scene;
}

/// One face with a vertex of its own for each corner.
inline Scene scene_of_polygon(const std::vector<Vec3>& points) {
  Face face;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    face.push_back(i);
  return scene_of(points, {face});
}

/// The same points in another unit and at another place.
inline std::vector<Vec3> moved(std::vector<Vec3> points, double scale, const Vec3& offset) {
  for (Vec3& point : points)
    point = scale * point + offset;
  return points;
}

/// A cube seen from inside or outside, 8 vertices, 6 quads.
inline Scene cube(double size, const Vec3& origin = Vec3(0, 0, 0)) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  return scene_of(
      moved(corners, size, origin),
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}});
}

struct Built {
  PatchSet patches;
  MeshReport report;
  Status status;
};

inline Built build(const Scene& scene) {
  Built built;
  built.status = build_patches(scene, &built.patches, &built.report);
  return built;
}

inline std::vector<std::uint32_t> list(std::span<const std::uint32_t> values) {
  return {values.begin(), values.end()};
}
inline std::vector<std::uint32_t> list(const Buffer<std::uint32_t>& values) {
  return list(values.span());
}

/// Seeded whole numbers below a bound: the same on every machine.
class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t operator()(std::uint32_t bound) {
    return static_cast<std::uint32_t>(engine_() % bound);
  }

private:
  std::mt19937 engine_;
};

inline double total_area(const PatchSet& patches) {
  double sum = 0;
  for (const double area : patches.area)
    sum += area;
  return sum;
}

} // namespace hemicube::radiosity::mesh_scenes
