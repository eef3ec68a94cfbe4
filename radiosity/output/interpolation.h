#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Polygons with more corners are shown flat.
inline constexpr std::uint32_t kMaxInterpolatedCorners = 64;

// The weights with which the corners of a convex patch make up a value at a point on it: >= 0,
// summing to 1, reproducing linear light, linear between neighbouring corners, so that patches that
// share an edge and its values agree along it. A point slightly outside counts as on the nearest
// edge. All receive one weight per corner; the patch has at most kMaxInterpolatedCorners.
// Deterministic: + - * / sqrt only.

/// Those a patch is shown with: Wachspress's, or mean values where it has straight corners, which
/// the former do not see.
/// @param is_straight  [corner of the mesh] from find_straight_corners()
void interpolation_weights(const PatchSet& patches, std::span<const std::uint8_t> is_straight,
                           std::uint32_t patch, const Vec3& point, double* weights) noexcept;

/// Wachspress's rational coordinates; on a rectangle bilinear. For patches all of whose corners
/// turn.
/// Source: Wachspress 1975, "A Rational Finite Element Basis".
void wachspress_weights(const PatchSet& patches, std::uint32_t patch, const Vec3& point,
                        double* weights) noexcept;

/// Mean value coordinates. For all patches.
/// Source: Floater 2003, "Mean value coordinates".
void mean_value_weights(const PatchSet& patches, std::uint32_t patch, const Vec3& point,
                        double* weights) noexcept;

} // namespace hemicube::radiosity
