#include "raster/item_buffer.h"

#include "raster/hash.h"
#include "raster/span_kernel.h"

namespace hemicube::raster {

Status ItemBuffer::init() {
  // One vector more than the last row needs, for kernels that load past its end.
  const std::size_t pixels = static_cast<std::size_t>(kRowPitch) * kMaxWindowSize + 16;
  const std::size_t tiles = static_cast<std::size_t>(kTilesPerRow) * kTilesPerRow;
  HC_TRY(items_.resize(pixels, kNoItem));
  HC_TRY(depths_.resize(pixels));
  HC_TRY(farthest_.resize(tiles));
  return dirty_.resize(tiles);
}

void ItemBuffer::begin(const Window& window) {
  HC_ASSERT(window.width > 0 && window.width <= kMaxWindowSize);
  HC_ASSERT(window.height > 0 && window.height <= kMaxWindowSize);
  window_ = window;
  const std::size_t used =
      static_cast<std::size_t>(kRowPitch) * static_cast<std::size_t>(window.height);
  for (std::size_t k = 0; k < used; ++k)
    items_[k] = kNoItem;
  for (std::size_t k = 0; k < used; ++k)
    depths_[k] = 0.0f;
  farthest_.fill(0.0f);
  dirty_.fill(0);
}

void ItemBuffer::mark_drawn(const TileRange& tiles) noexcept {
  for (std::int32_t y = tiles.y0; y <= tiles.y1; ++y)
    for (std::int32_t x = tiles.x0; x <= tiles.x1; ++x)
      dirty_[static_cast<std::size_t>(y * kTilesPerRow + x)] = 1;
}

bool ItemBuffer::hides(const TileRange& tiles, float nearest, const Kernels& kernels) noexcept {
  for (std::int32_t y = tiles.y0; y <= tiles.y1; ++y)
    for (std::int32_t x = tiles.x0; x <= tiles.x1; ++x) {
      const auto tile = static_cast<std::size_t>(y * kTilesPerRow + x);
      if (dirty_[tile] != 0) {
        // Columns past the window's right edge stay 0 and keep the tile open: conservative.
        const std::int32_t height = window_.height - y * kTileSize;
        farthest_[tile] = kernels.smallest(
            depths_.data() + static_cast<std::ptrdiff_t>(y) * kTileSize * kRowPitch + x * kTileSize,
            kRowPitch, kTileSize, height < kTileSize ? height : kTileSize);
        dirty_[tile] = 0;
      }
      if (!(nearest < farthest_[tile]))
        return false;
    }
  return true;
}

std::uint64_t hash_items(const ItemBuffer& buffer, std::uint64_t seed) {
  Hash hash(seed);
  const Window& window = buffer.window();
  for (std::int32_t y = window.y; y < window.y + window.height; ++y)
    for (std::int32_t x = 0; x < window.width; ++x) {
      hash.add(buffer.items(y)[x]);
      hash.add(buffer.depths(y)[x]);
    }
  return hash.value();
}

} // namespace hemicube::raster
