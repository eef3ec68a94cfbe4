#include "raster/item_buffer.h"

#include "raster/hash.h"

#include <algorithm>

namespace hemicube::raster {

Status ItemBuffer::init() {
  // One vector more than the last row needs, for kernels that load past its end.
  const std::size_t pixels = kLead + static_cast<std::size_t>(kRowPitch) * kMaxWindowSize + 16;
  HC_TRY(memory_.reserve_huge(pixels * (sizeof(Item) + sizeof(float))));
  HC_TRY(memory_.resize(pixels * (sizeof(Item) + sizeof(float))));
  items_ = reinterpret_cast<Item*>(memory_.data());
  depths_ = reinterpret_cast<float*>(memory_.data() + pixels * sizeof(Item));
  std::fill_n(items_, pixels, kNoItem);
  std::fill_n(depths_, pixels, 0.0f);
  HC_TRY(farthest_.resize(static_cast<std::size_t>(kTilesPerRow) * kTilesPerRow));
  HC_TRY(dirty_.resize(kTilesPerRow));
  HC_TRY(run_begins_.resize(kMaxWindowSize + 16));
  return run_items_.resize(kMaxWindowSize + 16);
}

void ItemBuffer::begin(const Window& window) {
  HC_ASSERT(window.width > 0 && window.width <= kMaxWindowSize);
  HC_ASSERT(window.height > 0 && window.height <= kMaxWindowSize);
  if (!clear_) {
    const std::size_t used =
        kLead + static_cast<std::size_t>(kRowPitch) * static_cast<std::size_t>(window_.height);
    std::fill_n(items_, used, kNoItem);
    std::fill_n(depths_, used, 0.0f);
  }
  clear_ = false;
  window_ = window;
  farthest_.fill(0.0f);
  dirty_.fill(0);
  planes_ = {items_ + kLead, depths_ + kLead, kRowPitch,        window.x,
             window.y,       window.height,   farthest_.data(), dirty_.data()};
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
