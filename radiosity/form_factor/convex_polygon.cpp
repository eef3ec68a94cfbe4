#include "radiosity/form_factor/convex_polygon.h"

namespace hemicube::radiosity {
namespace {

/// Where the edge from a (in front, side sa > 0) to b (behind, sb < 0) meets the plane. Computed
/// from the front corner whichever way the edge runs: both polygons of a shared edge, and both
/// parts of a cut, get the same point.
Vec3 crossing(const Vec3& a, double sa, const Vec3& b, double sb) {
  return a + (b - a) * (sa / (sa - sb));
}

} // namespace

void cut(const ConvexPolygon& polygon, const double* side, double tolerance, ConvexPolygon* front,
         ConvexPolygon* back) noexcept {
  bool any_front = false, any_back = false;
  for (int k = 0; k < polygon.count; ++k) {
    any_front |= side[k] > tolerance;
    any_back |= side[k] < -tolerance;
  }
  front->count = 0;
  if (back != nullptr)
    back->count = 0;
  if (!any_back || !any_front || polygon.is_full()) {
    const bool full_cut = any_back && any_front;
    if (any_front)
      *front = polygon;
    if (back != nullptr && any_back && (!any_front || full_cut))
      *back = polygon;
    return;
  }
  for (int k = 0; k < polygon.count; ++k) {
    const int next = k + 1 == polygon.count ? 0 : k + 1;
    const double here = side[k], there = side[next];
    if (here >= -tolerance)
      front->append(polygon.corners[k]);
    if (back != nullptr && here <= tolerance)
      back->append(polygon.corners[k]);
    const bool leaves = here > tolerance && there < -tolerance;
    const bool enters = here < -tolerance && there > tolerance;
    if (!leaves && !enters)
      continue;
    const Vec3 point = leaves ? crossing(polygon.corners[k], here, polygon.corners[next], there)
                              : crossing(polygon.corners[next], there, polygon.corners[k], here);
    front->append(point);
    if (back != nullptr)
      back->append(point);
  }
}

ConvexPolygon clip(const ConvexPolygon& polygon, const Plane& plane, double tolerance) noexcept {
  double side[ConvexPolygon::kMaxCorners];
  for (int k = 0; k < polygon.count; ++k)
    side[k] = plane.side(polygon.corners[k]);
  ConvexPolygon front;
  cut(polygon, side, tolerance, &front, nullptr);
  return front;
}

Vec3 area_vector(std::span<const Vec3> corners) noexcept {
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 2; k < corners.size(); ++k)
    sum += glm::cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  return sum * 0.5;
}

} // namespace hemicube::radiosity
