#pragma once

#include "raster/math.h"

#include <span>

namespace hemicube::radiosity {

/// The form factor from a small area to a planar convex polygon with nothing between them:
/// Lambert's contour sum near by, Gauss-Legendre where that sum would cancel. The part of the
/// polygon behind the small area's plane does not count.
/// @param eye      where the small area is; on the polygon's edge or corner the value is one of
/// 0..1
/// @param normal   of the small area, of length 1
/// @param corners  counter-clockwise seen from the polygon's front; repeated corners do no harm
/// @return dimensionless, -1 .. 1; positive where `eye` sees the polygon's front, negative where it
/// sees the back
/// Error: 1e-12 of the value and a few 1e-16 at grazing incidence, and what the rounding of
/// corners - eye leaves.
/// Deterministic: + - * / sqrt only. Scaling everything by a power of two changes no bit.
/// Source: Baum, Rushmeier, Winget 1989, "Improving radiosity solutions through the use of
/// analytically determined form-factors".
double point_to_polygon(const Vec3& eye, const Vec3& normal,
                        std::span<const Vec3> corners) noexcept;

} // namespace hemicube::radiosity
