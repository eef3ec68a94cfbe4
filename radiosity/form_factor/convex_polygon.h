#pragma once

#include "raster/math.h"

#include <span>

namespace hemicube::radiosity {

/// The points x with dot(normal, x - origin) = 0; the front is where it is positive.
struct Plane {
  Vec3 origin{0, 0, 0}, normal{0, 0, 0};

  double side(const Vec3& point) const noexcept { return glm::dot(normal, point - origin); }
};

/// A planar convex polygon by value: what clipping takes and makes. Corners run counter-clockwise
/// seen from the front. Empty polygons have no corners.
struct ConvexPolygon {
  static constexpr int kMaxCorners = 64;

  int count = 0;
  Vec3 corners[kMaxCorners];

  ConvexPolygon() noexcept {} // the corners stay unset: these are made by the million
  /// @param from  at most kMaxCorners
  explicit ConvexPolygon(std::span<const Vec3> from) noexcept {
    for (const Vec3& corner : from)
      append(corner);
  }
  ConvexPolygon(const ConvexPolygon& other) noexcept { *this = other; }
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): does no harm
  ConvexPolygon& operator=(const ConvexPolygon& other) noexcept {
    count = other.count;
    for (int k = 0; k < count; ++k)
      corners[k] = other.corners[k];
    return *this;
  }

  bool empty() const noexcept { return count == 0; }
  bool is_full() const noexcept { return count == kMaxCorners; }
  void append(const Vec3& corner) noexcept { corners[count++] = corner; }
  std::span<const Vec3> span() const noexcept { return {corners, static_cast<std::size_t>(count)}; }
};

/// Cuts a polygon by a plane. Corners within `tolerance` of it belong to both sides, so that a
/// polygon that only touches the plane is not cut.
/// @param side       [corner] the plane's value at each corner, any scale
/// @param tolerance  >= 0, in the scale of `side`
/// @param front      receives the part where side > 0; empty if there is none
/// @param back       receives the part where side < 0; may be null
/// A polygon that is full is given back whole on both sides: a caller that counts on an exact cut
/// asks is_full() first.
void cut(const ConvexPolygon& polygon, const double* side, double tolerance, ConvexPolygon* front,
         ConvexPolygon* back) noexcept;

/// The part of a polygon in front of a plane; see cut.
ConvexPolygon clip(const ConvexPolygon& polygon, const Plane& plane, double tolerance) noexcept;

/// Half the sum of the cross products of a polygon's corners, from its first: along its normal, as
/// long as its area.
Vec3 area_vector(std::span<const Vec3> corners) noexcept;

} // namespace hemicube::radiosity
