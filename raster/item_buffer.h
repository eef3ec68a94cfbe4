#pragma once

#include "raster/face_view.h"
#include "raster/memory.h"
#include "raster/tile.h"
#include "raster/types.h"

namespace hemicube::raster {

struct Kernels;

/// The z-buffer of one window: per pixel the nearest item and its depth 1/z, in separate planes
/// with padded rows, and per tile the depth of its farthest pixel. About 600 KiB at the largest
/// window.
class ItemBuffer {
public:
  /// Allocates for windows up to kMaxWindowSize x kMaxWindowSize.
  Status init();

  /// Takes on a window and clears it: no item, depth 0 (infinitely far).
  void begin(const Window& window);

  const Window& window() const noexcept { return window_; }

  /// Row y of the grid (window.y <= y < window.y + window.height); element 0 is pixel window.x.
  Item* items(std::int32_t y) noexcept { return items_.data() + row_offset(y); }
  const Item* items(std::int32_t y) const noexcept { return items_.data() + row_offset(y); }
  float* depths(std::int32_t y) noexcept { return depths_.data() + row_offset(y); }
  const float* depths(std::int32_t y) const noexcept { return depths_.data() + row_offset(y); }

  /// Says that pixels of these tiles (relative to the window, both ends included) may have changed.
  void mark_drawn(const TileRange& tiles) noexcept;

  /// True if every pixel of these tiles already holds something nearer than 1/z = nearest.
  bool hides(const TileRange& tiles, float nearest, const Kernels& kernels) noexcept;

private:
  std::size_t row_offset(std::int32_t y) const noexcept {
    return static_cast<std::size_t>(y - window_.y) * kRowPitch;
  }

  Window window_;
  Buffer<Item> items_;
  Buffer<float> depths_;
  Buffer<float> farthest_;     ///< [tile]
  Buffer<std::uint8_t> dirty_; ///< [tile] farthest_ is out of date
};

/// Folds items and depths of the buffer's window into a running hash, row by row.
std::uint64_t hash_items(const ItemBuffer& buffer, std::uint64_t seed);

} // namespace hemicube::raster
