#include "tests/support/facets.h"

#include "radiosity/elementary.h"

#include <cmath>

namespace hemicube::test {

using radiosity::Blocker;
using radiosity::Facet;
using radiosity::PointFormFactors;

OwnedFacet::OwnedFacet(Polygon polygon)
    : corners(std::move(polygon)),
      facet(Facet::of(corners, unit(radiosity::area_vector(corners)))) {}

OwnedFacet::OwnedFacet(const Vec3& point, const Vec3& normal)
    : corners{point}, facet(Facet::of(corners, unit(normal))) {}

namespace {

/// Of a point in the plane of a polygon from the nearest edge; negative outside.
double depth_inside(const Vec3& point, const Facet& polygon) {
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Vec3& from = polygon.corners[k];
    const Vec3 edge = polygon.corners[(k + 1) % polygon.corners.size()] - from;
    const Vec3 inward = unit(glm::cross(polygon.plane.normal, edge));
    least = std::fmin(least, glm::dot(inward, point - from));
  }
  return least;
}

} // namespace

Crossing crossing(const Vec3& a, const Vec3& b, const Facet& polygon, double margin) {
  const double side_a = polygon.plane.side(a), side_b = polygon.plane.side(b);
  if ((side_a > margin && side_b > margin) || (side_a < -margin && side_b < -margin))
    return Crossing::kMisses;
  if (std::fabs(side_a) <= margin || std::fabs(side_b) <= margin)
    return Crossing::kTooCloseToSay;
  const double inside = depth_inside(a + (b - a) * (side_a / (side_a - side_b)), polygon);
  if (std::fabs(inside) <= margin)
    return Crossing::kTooCloseToSay;
  return inside > 0 ? Crossing::kCrosses : Crossing::kMisses;
}

Vec3 random_place(Random& random, const Facet& facet) {
  const auto& corners = facet.corners;
  if (corners.size() < 3)
    return corners[0];
  double area = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    area += glm::length(glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]));
  double left = random.unit() * area;
  for (std::size_t k = 1;; ++k) {
    const Vec3 u = corners[k] - corners[0], v = corners[k + 1] - corners[0];
    left -= glm::length(glm::cross(u, v));
    if (left > 0 && k + 2 < corners.size())
      continue;
    double s = random.unit(), t = random.unit();
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    return corners[0] + u * s + v * t;
  }
}

Vec3 spot(const Polygon& parallelogram, double u, double v) {
  return parallelogram[0] + (parallelogram[1] - parallelogram[0]) * u +
         (parallelogram[3] - parallelogram[0]) * v;
}

PointFormFactors sampled(const Vec3& eye, const Vec3& normal, const OwnedFacet& target,
                         std::span<const Blocker> blockers, int n) {
  const double cell = glm::length(radiosity::area_vector(target.corners)) / (n * n);
  PointFormFactors found;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 to = spot(target.corners, (i + 0.5) / n, (j + 0.5) / n) - eye;
      const double square = glm::dot(to, to);
      const double kernel = glm::dot(normal, to) * glm::dot(target.facet.plane.normal, -to) /
                            (radiosity::kPi * square * square) * cell;
      if (!(glm::dot(normal, to) > 0) || !(kernel > 0))
        continue;
      bool is_seen = true;
      for (const Blocker& blocker : blockers)
        is_seen = is_seen && (blocker.in_target_plane ? depth_inside(eye + to, *blocker.facet) < 0
                                                      : crossing(eye, eye + to, *blocker.facet,
                                                                 0) != Crossing::kCrosses);
      found.whole += kernel;
      found.visible += is_seen ? kernel : 0;
    }
  return found;
}

PointFormFactors visible_part(const Vec3& eye, const Vec3& normal, const Facet& target,
                              std::span<const Blocker> blockers) {
  std::vector<radiosity::Shadow> shadows;
  for (const Blocker& blocker : blockers)
    shadows.emplace_back(eye, blocker);
  std::vector<const radiosity::Shadow*> pointers;
  for (const radiosity::Shadow& shadow : shadows)
    pointers.push_back(&shadow);
  radiosity::VisiblePart part;
  PointFormFactors found;
  require(part.find(eye, normal, target, pointers, &found));
  return found;
}

} // namespace hemicube::test
