#pragma once

#include "radiosity/mesh/polygon_shape.h"
#include "raster/memory.h"

#include <cstdint>
#include <span>

namespace hemicube::radiosity {

/// Cuts a convex quad along its shorter diagonal; of two equal ones along that from corner 0.
/// Appends three corner numbers (0..3) a triangle, counter-clockwise like the quad.
Status cut_quad(std::span<const Vec3> points, Buffer<std::uint32_t>* triangles);

/// Cuts a polygon into triangles by ear clipping, seen along its normal. The triangles use its own
/// points only, have its orientation and an area, and together cover it; points on an edge stay
/// corners. Of all ears the best shaped (area over the sum of squared edges) goes first, so that
/// the cut does not depend on the starting corner; equal ears go by corner number. A polygon that
/// intersects itself has no such cut: ears are then clipped as if nothing was in their way, and
/// what is wound the wrong way is left out.
/// @param points     of an area (has_area), no two neighbours equal
/// @param triangles  three corner numbers a triangle, lowest first, are appended
/// Takes time proportional to the square of the number of points.
/// @return kOutOfMemory
Status clip_ears(std::span<const Vec3> points, const PolygonShape& shape,
                 Buffer<std::uint32_t>* triangles);

} // namespace hemicube::radiosity
