#include "radiosity/output/interpolation.h"

namespace hemicube::radiosity {

void wachspress_weights(const PatchSet& patches, std::uint32_t patch, const Vec3& point,
                        double* weights) noexcept {
  const auto corners = patches.corners_of(patch);
  const std::size_t count = corners.size();
  HC_ASSERT(count <= kMaxInterpolatedCorners);
  const Vec3& normal = patches.normal[patch];
  const double area = 2 * patches.area[patch];
  // Triangles over the edges, as shares of the patch. A point on an edge leaves none over it; the
  // smallest share stands in, and the ends of that edge take all the weight.
  constexpr double kSmallest = 1e-14;
  Vec3 towards[kMaxInterpolatedCorners];
  double share[kMaxInterpolatedCorners]; // [k]: point, corner k, corner k + 1
  for (std::size_t k = 0; k < count; ++k)
    towards[k] = patches.vertices[corners[k]] - point;
  for (std::size_t k = 0; k < count; ++k) {
    share[k] = glm::dot(normal, glm::cross(towards[k], towards[(k + 1) % count])) / area;
    if (!(share[k] > kSmallest))
      share[k] = kSmallest;
  }
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t before = (k + count - 1) % count, after = (k + 1) % count;
    const double ear =
        glm::dot(normal, glm::cross(towards[k] - towards[before], towards[after] - towards[k])) /
        area;
    weights[k] = ear > 0 ? ear / (share[before] * share[k]) : 0;
    sum += weights[k];
  }
  for (std::size_t k = 0; k < count; ++k)
    weights[k] /= sum;
}

} // namespace hemicube::radiosity
