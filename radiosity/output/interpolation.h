#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Polygons with more corners are shown flat.
inline constexpr std::uint32_t kMaxInterpolatedCorners = 64;

/// The weights with which the corners of a convex patch make up a value at a point on it:
/// Wachspress's rational coordinates, >= 0, summing to 1, linear along every edge; on a rectangle
/// bilinear. A point slightly outside counts as on the nearest edge line.
/// @param weights  receives one weight per corner; the patch has at most kMaxInterpolatedCorners
/// Source: Wachspress 1975, "A Rational Finite Element Basis".
void wachspress_weights(const PatchSet& patches, std::uint32_t patch, const Vec3& point,
                        double* weights) noexcept;

} // namespace hemicube::radiosity
