#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Radiosities at the corners of patches, for display: what a patch shows between its corners.
///
/// A corner gets the area-weighted mean of the patches that meet at its *position* (bit-equal
/// positions are one vertex), have the material of the corner's own patch and a normal within about
/// 8 degrees of its normal: never across an edge of a room or a change of material.
///
/// Where these patches do not close around the vertex, at the border of a surface, the mean belongs
/// to a place inside. There the value is extrapolated linearly from the nearest inside vertex
/// through the place the mean belongs to (on a grid of equal rectangles: twice the mean minus the
/// inside vertex, as in Cohen and Wallace 1993), at most 3 times as far, and kept within 0 and
/// twice the largest patch value around it. Surfaces without an inside vertex keep the mean; a
/// patch alone keeps its own value.
///
/// @param radiosity  [patch][band], W/m^2
/// @param corner_radiosity  receives [corner][band], parallel to PatchSet::corners, W/m^2
/// @return kOutOfMemory
/// Deterministic: + - * / only, in a fixed order.
Status vertex_radiosities(const PatchSet& patches, std::span<const double> radiosity,
                          std::uint32_t band_count, Buffer<float>* corner_radiosity);

} // namespace hemicube::radiosity
