#include "radiosity/form_factor/visible_part.h"

#include "radiosity/form_factor/lambert.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Corners closer than this to a side of a shadow, relative to the terms of their distance, lie in
/// it.
constexpr double kCutTolerance = 0x1p-44;

double largest_distance(const ConvexPolygon& polygon) {
  double largest = 0;
  for (const Vec3& corner : polygon.span())
    largest = std::max(largest, glm::dot(corner, corner));
  return std::sqrt(largest);
}

bool reaches(const Shadow& shadow, const ConvexPolygon& polygon, double tolerance) {
  for (int k = 0; k < shadow.side_count; ++k) {
    bool any_inside = false;
    for (const Vec3& corner : polygon.span())
      any_inside |= shadow.sides[k].inside(corner) > tolerance;
    if (!any_inside)
      return false;
  }
  return shadow.side_count != 0;
}

} // namespace

Shadow::Shadow(const Vec3& eye, const Blocker& blocker) noexcept {
  const Facet& facet = *blocker.facet;
  const double height = facet.plane.side(eye);
  if (height == 0)
    return;
  const bool sees_front = height > 0;
  const std::size_t count = facet.corners.size();
  distance = std::fabs(height);
  if (!blocker.in_target_plane)
    sides[side_count++] = {sees_front ? -facet.plane.normal : facet.plane.normal, -distance};
  Vec3 a = facet.corners[count - 1] - eye;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 b = facet.corners[k] - eye;
    const Vec3 normal = sees_front ? glm::cross(b, a) : glm::cross(a, b);
    const double length = glm::length(normal);
    if (length > 0)
      sides[side_count++] = {normal / length, 0};
    a = b;
  }
}

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
                         std::span<const Shadow* const> shadows, PointFormFactors* form_factors) {
  *form_factors = {};
  if (!(target.plane.side(eye) > 0))
    return {};
  const Vec3 origin(0, 0, 0);
  ConvexPolygon polygon;
  for (const Vec3& corner : target.corners)
    polygon.append(corner - eye);
  const double whole = std::max(0.0, point_to_polygon(origin, normal, polygon.span()));
  const double reach = largest_distance(polygon);
  bool is_whole = true;
  double visible = 0;
  for (std::size_t next = 0;;) {
    for (; next < shadows.size() && !polygon.empty(); ++next) {
      const Shadow& shadow = *shadows[next];
      const double tolerance = kCutTolerance * (reach + shadow.distance);
      if (!reaches(shadow, polygon, tolerance))
        continue;
      is_whole = false;
      for (int s = 0; s < shadow.side_count && !polygon.empty(); ++s) {
        double side[ConvexPolygon::kMaxCorners];
        for (int k = 0; k < polygon.count; ++k)
          side[k] = shadow.sides[s].inside(polygon.corners[k]);
        ConvexPolygon inside, outside;
        cut(polygon, side, tolerance, &inside, &outside);
        if (!outside.empty())
          HC_TRY(push(outside, next + 1));
        polygon = inside;
      }
      polygon.count = 0; // what is left is hidden
    }
    if (is_whole)
      visible = whole;
    else if (!polygon.empty())
      visible += std::max(0.0, point_to_polygon(origin, normal, polygon.span()));
    if (pieces_.empty())
      break;
    pop(&polygon, &next);
  }
  *form_factors = {whole, std::min(visible, whole)};
  return {};
}

} // namespace hemicube::radiosity
