#include "radiosity/form_factor/prepared_area.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Opposite edges that differ by less, as a share of the radius, are equal.
constexpr double kEqualEdges = 0x1p-44;

double larger(double a, double b) {
  return a > b ? a : b;
}

} // namespace

PreparedArea prepare_area(std::span<const Vec3> corners, const Vec3& normal) noexcept {
  PreparedArea made;
  made.corners = corners;
  const std::size_t count = corners.size();
  made.normal = normal;
  if (count < 3)
    return made;
  // Offsets from the first corner: small numbers wherever the polygon is.
  const Vec3 origin = corners[0];
  Vec3 sum(0, 0, 0);
  double longest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& c = corners[k];
    const Vec3 edge = corners[k + 1 == count ? 0 : k + 1] - c;
    sum += c - origin;
    longest = larger(longest, glm::dot(edge, edge));
    made.coordinate =
        larger(made.coordinate, larger(std::fabs(c.x), larger(std::fabs(c.y), std::fabs(c.z))));
  }
  const Vec3 middle = sum * (1.0 / static_cast<double>(count));
  made.centre = origin + middle;
  double square = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 arm = (corners[k] - origin) - middle;
    square = larger(square, glm::dot(arm, arm));
  }
  made.radius = std::sqrt(square);
  made.area = glm::dot(area_vector(corners), normal);
  if (longest > 0)
    made.width = made.area / std::sqrt(longest);
  if (count == 4) {
    const Vec3* c = corners.data();
    const Vec3 skew = (c[0] - c[1]) + (c[2] - c[3]);
    made.parallelogram = glm::dot(skew, skew) <= kEqualEdges * kEqualEdges * square;
    made.half_u = ((c[1] - c[0]) + (c[2] - c[3])) * 0.25;
    made.half_v = ((c[3] - c[0]) + (c[2] - c[1])) * 0.25;
    made.length_u = glm::length(made.half_u);
    made.length_v = glm::length(made.half_v);
  }
  return made;
}

} // namespace hemicube::radiosity
