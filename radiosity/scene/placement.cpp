#include "radiosity/scene/placement.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

Vec3 transformed(const std::array<double, 12>& m, const Vec3& p) {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

/// A vector of length 1, also where the squares of v over- or underflow; 0 for 0.
Vec3 direction(const Vec3& v) {
  const double largest = largest_component(v);
  return largest == 0 ? v : unit(v / largest);
}

} // namespace

double largest_component(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double relative_determinant(const Placement& placement) {
  const auto& m = placement.rows;
  const Vec3 a = direction({m[0], m[1], m[2]});
  const Vec3 b = direction({m[4], m[5], m[6]});
  const Vec3 c = direction({m[8], m[9], m[10]});
  const double determinant = glm::dot(a, glm::cross(b, c));
  return std::abs(determinant) >= 1e-12 ? determinant : 0; // NaN gives 0 too
}

bool place_vertices(const Placement& placement, std::span<Vec3> vertices) {
  for (Vec3& vertex : vertices) {
    if (placement.has_transform)
      vertex = transformed(placement.rows, vertex);
    vertex *= placement.metres_per_unit;
    if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.z))
      return false;
  }
  return true;
}

bool place_mesh(const Placement& placement, FileMesh* mesh) {
  if (!place_vertices(placement, mesh->vertices.span()))
    return false;
  if (placement.has_transform && relative_determinant(placement) < 0)
    for (std::size_t face = 0; face < mesh->face_count(); ++face)
      std::reverse(mesh->corners.data() + mesh->corner_offsets[face] + 1,
                   mesh->corners.data() + mesh->corner_offsets[face + 1]);
  return true;
}

} // namespace hemicube::radiosity
