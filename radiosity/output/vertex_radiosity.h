#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Radiosities at the corners of patches, for display: what a patch shows between its corners.
///
/// A corner gets a mean over the patches that form one smooth surface with its own around its
/// *position* (bit-equal positions are one vertex): those of the same material that normals lead to
/// which differ by at most about 8 degrees from one to the next. So nothing crosses an edge of a
/// room or a change of material, and the two sides of an edge within a surface agree bit for bit.
///
/// Nor does it cross an edge where light jumps (PatchSet::edge_light). Where light bends, each side
/// is a surface of its own, too, up to the last step: then the values that the sides have come to
/// at the edge are made one, their mean.
///
/// Weights are areas, changed as little as it takes to make the mean belong to the vertex itself
/// (balanced_weights.h): linear light is exact also where large and small patches meet. On a grid
/// of equal parallelograms they are equal.
///
/// Where these patches do not close around the vertex, at the border of a surface, the mean belongs
/// to a place inside. There the value is extrapolated linearly from the inside vertex that lies
/// most straight behind it, through that place (on a grid of equal rectangles: twice the mean minus
/// the inside vertex, as in Cohen and Wallace 1993), at most 3 times as far, and kept within 0 and
/// twice the largest patch value around it. Surfaces without an inside vertex keep the mean; a
/// patch alone keeps its own value. A straight corner (mesh/straight_corners.h) that no other
/// patch of the surface touches lies on the line between the corners next to it.
///
/// Positions where more than 512 corners meet keep each patch's own value: work stays linear.
///
/// @param radiosity  [patch][band], W/m^2, >= 0
/// @param corner_radiosity  receives [corner][band], parallel to PatchSet::corners, W/m^2, >= 0
/// @return kOutOfMemory
/// Deterministic: + - * / sqrt only, in a fixed order.
Status vertex_radiosities(const PatchSet& patches, std::span<const double> radiosity,
                          std::uint32_t band_count, Buffer<float>* corner_radiosity);

} // namespace hemicube::radiosity
