#pragma once

#include "raster/kernels.h"

#include <cstdint>

namespace hemicube::raster {

/// Elements from one row of a window to the next. The padding lets kernels load and store whole
/// vectors past a row's end, and keeps rows from falling on the same cache sets.
inline constexpr std::int32_t kRowPitch = kMaxWindowSize + 16;

/// Hierarchical z: the farthest depth of each tile, squares of pixels counted from the window's
/// corner; smaller ones in small windows, where polygons are small too.
inline constexpr std::int32_t tile_shift(std::int32_t window_size) {
  return window_size > 4 * kTilesPerRow ? 4 : 2;
}

} // namespace hemicube::raster
