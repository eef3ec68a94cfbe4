#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Which corners of a mesh lie at the same position, whether or not they share a vertex index.
struct SharedVertices {
  Buffer<std::uint32_t> position;     ///< [vertex] number of its position
  Buffer<std::uint32_t> offsets;      ///< [position count + 1] into corners
  Buffer<std::uint32_t> corners;      ///< corner numbers by position, ascending within one
  Buffer<std::uint32_t> corner_patch; ///< [corner] the patch it belongs to

  std::span<const std::uint32_t> corners_at(std::uint32_t at) const noexcept {
    return corners.span().subspan(offsets[at], offsets[at + 1] - offsets[at]);
  }
};

/// @return kOutOfMemory
Status find_shared_vertices(const PatchSet& patches, SharedVertices* shared);

} // namespace hemicube::radiosity
