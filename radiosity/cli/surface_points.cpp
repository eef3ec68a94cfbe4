#include "radiosity/cli/surface_points.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity::cli {
namespace {

constexpr double kBehind = 1e-6, kBefore = 1e-12; ///< of the size of the scene
/// Cosine between the normals of a patch and of a point that looks the way the patch does.
constexpr double kSameWay = 0.999;

double length(const Vec3& v) {
  return std::sqrt(glm::dot(v, v));
}

/// The length of the diagonal of the box around all patches.
double size_of(const PatchSet& patches) {
  Vec3 low = patches.vertices[patches.corners[0]], high = low;
  for (const std::uint32_t corner : patches.corners) {
    low = glm::min(low, patches.vertices[corner]);
    high = glm::max(high, patches.vertices[corner]);
  }
  return length(high - low);
}

/// True if the point is within the patch, seen along the patch's normal.
bool is_over(const PatchSet& patches, std::uint32_t patch, const Vec3& point, double tolerance) {
  const auto corners = patches.corners_of(patch);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3& a = patches.vertices[corners[k]];
    const Vec3 edge = patches.vertices[corners[(k + 1) % corners.size()]] - a;
    const double side = glm::dot(glm::cross(edge, point - a), patches.normal[patch]);
    if (side < -tolerance * length(edge))
      return false;
  }
  return true;
}

} // namespace

void move_to_front(const PatchSet& patches, std::vector<Receiver>* points) {
  const double size = size_of(patches);
  for (Receiver& point : *points) {
    // By the largest component first: the squares of a normal of any length may be out of range.
    const Vec3& n = point.normal;
    const Vec3 scaled = n / std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
    const Vec3 normal = scaled / length(scaled);
    double advance = 0;
    for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
      const double before = glm::dot(point.position - patches.centre[patch], patches.normal[patch]);
      if (before < kBefore * size && before > -kBehind * size) {
        const double cosine = glm::dot(patches.normal[patch], normal);
        if (cosine > kSameWay && is_over(patches, patch, point.position, kBehind * size))
          advance = std::max(advance, (kBefore * size - before) / cosine);
      }
    }
    point.position += advance * normal;
  }
}

} // namespace hemicube::radiosity::cli
