#pragma once

#include <cstddef>
#include <cstdint>

namespace hemicube::raster {

/// What a pixel holds: the id of a polygon, with kBackFacing set when its back is seen, or kNoItem.
/// As an unsigned number an item is also its rank at equal depth: facing before back-facing, then
/// the lower id, then nothing.
using Item = std::uint32_t;

inline constexpr Item kNoItem = 0xffffffffu;
inline constexpr Item kBackFacing = 0x80000000u;

/// Ids run from 0; the largest leaves room for the flag and for kNoItem.
inline constexpr std::uint32_t kMaxPolygonCount = 0x7fffffffu;

inline constexpr std::uint32_t item_id(Item item) {
  return item & ~kBackFacing;
}
inline constexpr bool is_back_facing(Item item) {
  return (item & kBackFacing) != 0;
}

} // namespace hemicube::raster
