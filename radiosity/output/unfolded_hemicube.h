#pragma once

#include "raster/face_view.h"

#include <cstdint>

namespace hemicube::radiosity {

/// A pixel of a hemicube's face; exists only where `is_inside`.
struct FacePixel {
  bool is_inside = false;
  raster::Face face = raster::Face::kTop;
  std::int32_t x = 0, y = 0;
};

/// The pixel of the hemicube that stands at (column, row) of the unfolded cross, a square of twice
/// the resolution: the top in the middle, the sides folded out around it with the horizon
/// outermost, as seen from the receiver (not mirrored). Neighbours in the cross are neighbours on
/// the hemicube, across the edges of the top too. The four corners of the square are outside.
FacePixel unfolded_pixel(std::uint32_t resolution, std::uint32_t column,
                         std::uint32_t row) noexcept;

} // namespace hemicube::radiosity
