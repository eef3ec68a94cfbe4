#pragma once

#include "raster/math.h"

#include <span>

namespace hemicube::radiosity {

/// What a polygon's vertices say about it. Every tolerance derives from `resolution`, so that
/// nothing depends on the unit of the scene, and coordinates far from the origin are judged as
/// coarsely as double precision holds them.
struct PolygonShape {
  Vec3 area_vector{0, 0, 0}; ///< Newell: along the front's normal, as long as the area
  double area = 0;           ///< units squared
  double size = 0;           ///< diagonal of the bounding box
  double resolution = 0;     ///< distance below which two places cannot be told apart
};

/// Measures a polygon of three or more points, counter-clockwise seen from the front. Areas are
/// summed relative to the first point, so that an offset of the whole polygon costs no digits.
/// Numbers that overflow show up as an area that is not finite.
PolygonShape measure_polygon(std::span<const Vec3> points);

/// False if the area is zero or nothing but rounding: repeated or collinear points, or parts of
/// opposite orientation that cancel. Slivers have area down to the resolution of their coordinates.
bool has_area(std::span<const Vec3> points, const PolygonShape& shape);

/// True if every point lies within 1e-3 of the size from the plane through the points' mean along
/// the Newell normal.
bool is_planar(std::span<const Vec3> points, const PolygonShape& shape);

/// True if the polygon, seen along its normal, is convex and winds once. Points on an edge
/// (T-vertices) do not make it concave; spikes do.
bool is_convex(std::span<const Vec3> points, const PolygonShape& shape);

/// The area centroid: of a slightly warped polygon, that of its fan of triangles weighted by their
/// areas seen along the normal. The shape must have area.
Vec3 centroid(std::span<const Vec3> points, const PolygonShape& shape);

/// The side to which the path along u, then v, turns seen against `normal`: 1 left, -1 right, 0 if
/// it is straight (or reverses) within the resolution of the coordinates.
int turn_side(const Vec3& normal, double resolution, const Vec3& u, const Vec3& v);

} // namespace hemicube::radiosity
