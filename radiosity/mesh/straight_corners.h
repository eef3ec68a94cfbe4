#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Finds the corners at which the boundary of a patch goes straight on, within the resolution of
/// its coordinates: where the neighbours across a side are smaller, the patch lists their vertices
/// on that side among its corners (hanging vertices). A patch so thin that fewer than three corners
/// can be told to turn has none.
/// @param is_straight  receives [corner] 0 or 1, parallel to PatchSet::corners
/// @return kOutOfMemory
Status find_straight_corners(const PatchSet& patches, Buffer<std::uint8_t>* is_straight);

} // namespace hemicube::radiosity
