#include "radiosity/form_factor/visible_part.h"

#include "radiosity/form_factor/lambert.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Corners closer than this to a cut, relative to the terms of their distance, lie in it.
constexpr double kCutTolerance = 0x1p-44;

/// What an eye sees through a blocker: beyond its plane, and inside the planes through the eye and
/// its edges.
struct Shadow {
  static constexpr std::size_t kMaxPlanes = VisiblePart::kMaxBlockerCorners + 1;

  std::size_t plane_count = 0;
  Plane planes[kMaxPlanes]; ///< inside is in front

  /// Leaves no planes if the blocker is seen edge-on.
  Shadow(const Vec3& eye, const Blocker& hider) {
    const Facet& blocker = *hider.facet;
    const double eye_side = blocker.plane.side(eye);
    if (eye_side == 0)
      return;
    const bool sees_front = eye_side > 0;
    const std::size_t count = blocker.corners.size();
    if (!hider.in_target_plane)
      planes[plane_count++] = {blocker.plane.origin,
                               sees_front ? -blocker.plane.normal : blocker.plane.normal};
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 a = blocker.corners[k] - eye;
      const Vec3 b = blocker.corners[k + 1 == count ? 0 : k + 1] - eye;
      const Vec3 normal = sees_front ? glm::cross(b, a) : glm::cross(a, b);
      const double length = glm::length(normal);
      planes[plane_count++] = {eye, length > 0 ? normal / length : normal};
    }
  }
};

/// The plane's value at each corner.
/// @return the tolerance that goes with them
double find_sides(const Plane& plane, const ConvexPolygon& polygon, double* side) {
  double reach = 0;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3 apart = polygon.corners[k] - plane.origin;
    side[k] = glm::dot(plane.normal, apart);
    reach = std::fmax(reach, std::fabs(apart.x) + std::fabs(apart.y) + std::fabs(apart.z));
  }
  return kCutTolerance * reach;
}

bool touches(const Shadow& shadow, const ConvexPolygon& polygon) {
  double side[ConvexPolygon::kMaxCorners];
  for (std::size_t p = 0; p < shadow.plane_count; ++p) {
    const double tolerance = find_sides(shadow.planes[p], polygon, side);
    bool any_inside = false;
    for (int k = 0; k < polygon.count; ++k)
      any_inside |= side[k] > tolerance;
    if (!any_inside)
      return false;
  }
  return shadow.plane_count != 0;
}

} // namespace

Status VisiblePart::push(const ConvexPolygon& polygon, std::size_t next) {
  HC_TRY(pieces_.push_back({corners_.size(), next}));
  return corners_.append(polygon.span());
}

void VisiblePart::pop(ConvexPolygon* polygon, std::size_t* next) {
  const Piece piece = pieces_.back();
  pieces_.pop_back();
  polygon->count = 0;
  for (std::size_t k = piece.first_corner; k < corners_.size(); ++k)
    polygon->append(corners_[k]);
  while (corners_.size() > piece.first_corner)
    corners_.pop_back();
  *next = piece.next;
}

Status VisiblePart::find(const Vec3& eye, const Vec3& normal, const Facet& target,
                         std::span<const Blocker> blockers, PointFormFactors* form_factors) {
  *form_factors = {};
  if (!(target.plane.side(eye) > 0))
    return {};
  form_factors->whole = std::fmax(0, point_to_polygon(eye, normal, target.corners));
  ConvexPolygon polygon;
  for (const Vec3& corner : target.corners)
    polygon.append(corner);
  HC_TRY(push(polygon, 0));
  bool is_whole = true;
  while (!pieces_.empty()) {
    std::size_t next = 0;
    pop(&polygon, &next);
    for (; next < blockers.size() && !polygon.empty(); ++next) {
      const Shadow shadow(eye, blockers[next]);
      if (!touches(shadow, polygon))
        continue;
      is_whole = false;
      for (std::size_t p = 0; p < shadow.plane_count && !polygon.empty(); ++p) {
        double side[ConvexPolygon::kMaxCorners];
        const double tolerance = find_sides(shadow.planes[p], polygon, side);
        ConvexPolygon inside, outside;
        cut(polygon, side, tolerance, &inside, &outside);
        if (!outside.empty())
          HC_TRY(push(outside, next + 1));
        polygon = inside;
      }
      polygon.count = 0; // what is left is hidden
    }
    if (is_whole)
      form_factors->visible = form_factors->whole;
    else if (!polygon.empty())
      form_factors->visible += std::fmax(0, point_to_polygon(eye, normal, polygon.span()));
  }
  form_factors->visible = std::fmin(form_factors->visible, form_factors->whole);
  return {};
}

} // namespace hemicube::radiosity
