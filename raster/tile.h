#pragma once

#include "raster/face_view.h"

#include <cstdint>

namespace hemicube::raster {

/// Tiles are squares of kTileSize pixels, counted from the window's corner; the same on every ISA.
inline constexpr std::int32_t kTileSize = 16;
inline constexpr std::int32_t kTilesPerRow = kMaxWindowSize / kTileSize;

/// Elements from one row of a window to the next. The padding lets kernels load and store whole
/// vectors past a row's end, and keeps rows from falling on the same cache sets.
inline constexpr std::int32_t kRowPitch = kMaxWindowSize + 16;

/// Tiles x0..x1 by y0..y1, both ends included.
struct TileRange {
  std::int32_t x0 = 0, y0 = 0, x1 = -1, y1 = -1;

  std::int32_t count() const noexcept { return (x1 - x0 + 1) * (y1 - y0 + 1); }
};

} // namespace hemicube::raster
