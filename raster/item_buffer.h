#pragma once

#include "raster/face_view.h"
#include "raster/kernels.h"
#include "raster/memory.h"
#include "raster/types.h"

namespace hemicube::raster {

/// Elements from one row of a window to the next. The padding lets kernels load and store whole
/// vectors past a row's end, and keeps rows from falling on the same cache sets.
inline constexpr std::int32_t kRowPitch = kMaxWindowSize + 16;

/// The z-buffer of one window: per pixel the nearest item and its depth 1/z, in separate planes
/// with padded rows, and per tile the depth of its farthest pixel. About 560 KiB.
class ItemBuffer {
public:
  /// Allocates for windows up to kMaxWindowSize x kMaxWindowSize.
  Status init();

  /// Takes on a window and clears it: no item, depth 0 (infinitely far).
  void begin(const Window& window);

  const Window& window() const noexcept { return window_; }

  /// Row y of the grid (window.y <= y < window.y + window.height); element 0 is pixel window.x.
  const Item* items(std::int32_t y) const noexcept { return items_ + row_offset(y); }
  const float* depths(std::int32_t y) const noexcept { return depths_ + row_offset(y); }

  /// The same for the kernels that draw.
  const WindowPlanes& planes() noexcept { return planes_; }

  /// Runs of equal items in a row: run k is [begins[k], begins[k + 1]), and begins[count] is the
  /// width.
  struct Runs {
    const std::int32_t* begins;
    const Item* items;
    std::int32_t count;
  };

  /// Calls visit(y, runs) for the rows of the window, y of the grid, ascending. Reads each pixel
  /// once, and clears it while it is in cache: afterwards the buffer is empty.
  template <typename Visit> void take_runs(const Kernels& kernels, Visit visit) {
    for (std::int32_t y = window_.y; y < window_.y + window_.height; ++y) {
      const std::size_t row = row_offset(y);
      const std::int32_t count = kernels.take_runs(items_ + row, depths_ + row, window_.width,
                                                   run_begins_.data(), run_items_.data());
      run_begins_[static_cast<std::size_t>(count)] = window_.width;
      visit(y, Runs{run_begins_.data(), run_items_.data(), count});
    }
    clear_ = true;
  }

private:
  std::size_t row_offset(std::int32_t y) const noexcept {
    return kLead + static_cast<std::size_t>(y - window_.y) * kRowPitch;
  }

  /// Kernels look at the element before a row, and keep rows aligned.
  static constexpr std::size_t kLead = 16;

  Window window_;
  WindowPlanes planes_{};
  bool clear_ = true;        ///< items and depths are as begin() leaves them
  Buffer<std::byte> memory_; ///< of both planes: side by side they share a huge page
  Item* items_ = nullptr;
  float* depths_ = nullptr;
  Buffer<float> farthest_;      ///< [tile row][kTilesPerRow]
  Buffer<std::uint32_t> dirty_; ///< [tile row]
  Buffer<std::int32_t> run_begins_;
  Buffer<Item> run_items_;
};

/// Folds items and depths of the buffer's window into a running hash, row by row.
std::uint64_t hash_items(const ItemBuffer& buffer, std::uint64_t seed);

} // namespace hemicube::raster
