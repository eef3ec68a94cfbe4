#include "tests/fuzz/polygon_pair.h"

#include "radiosity/elementary.h"

#include <algorithm>
#include <cmath>

namespace hemicube::test {

PairSide::PairSide(const PatchSet& patches, std::uint32_t patch)
    : normal(patches.normal[patch]), centre(patches.centre[patch]), area(patches.area[patch]) {
  for (const std::uint32_t corner : patches.corners_of(patch))
    corners.push_back(patches.vertices[corner]);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double edge = glm::length(corners[(k + 1) % corners.size()] - corners[k]);
    perimeter += edge;
    longest = std::max(longest, edge);
    radius = std::max(radius, glm::length(corners[k] - centre));
    for (int axis = 0; axis < 3; ++axis)
      coordinate = std::max(coordinate, std::fabs(corners[k][axis]));
  }
}

namespace {

/// To how much a point of either is known over the plane of the other.
double resolution(const PairSide& p, const PairSide& q) {
  const double reach = glm::length(p.centre - q.centre) + p.radius + q.radius;
  return 0x1p-49 * std::max(p.coordinate, q.coordinate) *
         (1 + reach * std::max(p.longest / p.area, q.longest / q.area));
}

double height_over(const PairSide& p, const PairSide& q) {
  double height = 0;
  for (const Vec3& corner : p.corners)
    height = std::max(height, std::fabs(glm::dot(q.normal, corner - q.centre)));
  return height;
}

} // namespace

double rounding_of(const PairSide& p, const PairSide& q) {
  const double between = glm::length(p.centre - q.centre), r = resolution(p, q);
  const double perimeter = p.perimeter + q.perimeter;
  const double near = r * perimeter * (1 + std::log(1 + perimeter / r)) / radiosity::kPi;
  const double distance = between - p.radius - q.radius;
  const double far = 4 * r * p.area * q.area / (radiosity::kPi * distance * distance * distance);
  return distance > 0 ? std::min(near, far) : near;
}

bool lie_in_one_plane(const PairSide& p, const PairSide& q) {
  return std::min(height_over(p, q), height_over(q, p)) <= 4 * resolution(p, q);
}

bool are_well_apart(const PairSide& p, const PairSide& q) {
  return glm::length(p.centre - q.centre) > 1.05 * (p.radius + q.radius);
}

} // namespace hemicube::test
