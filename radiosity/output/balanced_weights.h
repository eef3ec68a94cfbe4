#pragma once

#include "raster/math.h"

#include <span>

namespace hemicube::radiosity {

// Both change weights >= 0 of points as little as it takes (each by a factor that is linear in
// space: a moving least-squares fit of a linear function) to move their weighted mean; none falls
// below a thousandth of what it was, so the mean may stop short where the points lie badly.
// Deterministic: + - * / sqrt only.

/// Moves the mean to the origin, seen along the normal.
void balance_about_point(std::span<const Vec3> points, const Vec3& normal,
                         std::span<double> weights) noexcept;

/// Moves the mean onto the line through the origin along `direction`, seen along the normal. Points
/// that all lie on one side of it are left alone.
void balance_about_line(std::span<const Vec3> points, const Vec3& normal, const Vec3& direction,
                        std::span<double> weights) noexcept;

} // namespace hemicube::radiosity
