#include "radiosity/output/interpolation.h"

namespace hemicube::radiosity {
namespace {

/// Triangles over the edges, as shares of the patch. A point on an edge leaves none over it; the
/// smallest share stands in, and the ends of that edge take all the weight.
constexpr double kSmallestShare = 1e-14;

} // namespace

void interpolation_weights(const PatchSet& patches, std::span<const std::uint8_t> is_straight,
                           std::uint32_t patch, const Vec3& point, double* weights) noexcept {
  for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1]; ++c)
    if (is_straight[c]) {
      mean_value_weights(patches, patch, point, weights);
      return;
    }
  wachspress_weights(patches, patch, point, weights);
}

void wachspress_weights(const PatchSet& patches, std::uint32_t patch, const Vec3& point,
                        double* weights) noexcept {
  const auto corners = patches.corners_of(patch);
  const std::size_t count = corners.size();
  HC_ASSERT(count <= kMaxInterpolatedCorners);
  const Vec3& normal = patches.normal[patch];
  const double area = 2 * patches.area[patch];
  Vec3 towards[kMaxInterpolatedCorners];
  double share[kMaxInterpolatedCorners]; // [k]: point, corner k, corner k + 1
  for (std::size_t k = 0; k < count; ++k)
    towards[k] = patches.vertices[corners[k]] - point;
  for (std::size_t k = 0; k < count; ++k) {
    share[k] = glm::dot(normal, glm::cross(towards[k], towards[(k + 1) % count])) / area;
    if (!(share[k] > kSmallestShare))
      share[k] = kSmallestShare;
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

void mean_value_weights(const PatchSet& patches, std::uint32_t patch, const Vec3& point,
                        double* weights) noexcept {
  const auto corners = patches.corners_of(patch);
  const std::size_t count = corners.size();
  HC_ASSERT(count <= kMaxInterpolatedCorners);
  const double area = 2 * patches.area[patch];
  Vec3 towards[kMaxInterpolatedCorners];
  double distance[kMaxInterpolatedCorners];
  for (std::size_t k = 0; k < count; ++k) {
    towards[k] = patches.vertices[corners[k]] - point;
    distance[k] = glm::length(towards[k]);
    weights[k] = 0;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (!(distance[k] * distance[k] > kSmallestShare * kSmallestShare * area)) { // at the corner
      weights[k] = 1;
      return;
    }
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t after = (k + 1) % count;
    const double cosine = glm::dot(towards[k], towards[after]) / area; // times both distances
    const double product = distance[k] * distance[after] / area;
    double sine = glm::dot(patches.normal[patch], glm::cross(towards[k], towards[after])) / area;
    if (!(sine > kSmallestShare))
      sine = kSmallestShare;
    // The tangent of half the angle at the point, in the form that does not cancel.
    const double tangent = cosine > 0 ? sine / (product + cosine) : (product - cosine) / sine;
    weights[k] += tangent / distance[k];
    weights[after] += tangent / distance[after];
    sum += tangent / distance[k] + tangent / distance[after];
  }
  for (std::size_t k = 0; k < count; ++k)
    weights[k] /= sum;
}

} // namespace hemicube::radiosity
