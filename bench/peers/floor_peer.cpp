// What no program that draws every pixel once can beat: planes in the first-level cache are
// cleared, written once behind a depth test, and read.
#include "bench/peers/peer.h"
#include "bench/peers/run_reader.h"
#include "radiosity/hemicube/five_views.h"
#include "tests/support/drawn_face.h"

#include <algorithm>

namespace hemicube::bench {
namespace {

using raster::Face;
using raster::Item;

constexpr std::size_t kStripPixels = 4096; ///< ids and depths: 32 KiB
constexpr std::size_t kDrawnBytes = std::size_t{768}
                                    << 10; ///< copied from: fits a second-level cache

class FloorPeer : public Peer {
public:
  std::string name() const override { return "floor"; }

  /// Draws the hemicube of one receiver: all rows copy its items. Of a large one they copy every
  /// n-th strip n times, so that it is not memory that is timed.
  void prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) override {
    patch_count_ = patches.patch_count();
    reader_.prepare(patch_count_, resolution);
    test::Drawer drawer(radiosity::polygons_of(patches), raster::best_kernels());
    drawer.begin(radiosity::hemicube_view(patches, patch_count_ / 2));
    for (int f = 0; f < raster::kFaceCount; ++f) {
      const Face face = static_cast<Face>(f);
      faces_[f] = drawer.draw(face, raster::hemicube_grid(face, resolution)).items;
    }
    strip_height_ = static_cast<std::int32_t>(std::max<std::size_t>(kStripPixels / resolution, 1));
    const std::size_t bytes = std::size_t{3} * resolution * resolution * sizeof(Item);
    copies_ = static_cast<std::int32_t>(std::max<std::size_t>(bytes / kDrawnBytes, 1));
    const std::size_t size = static_cast<std::size_t>(strip_height_) * resolution;
    items_.assign(size + 32, raster::kNoItem);
    depths_.assign(size, 0);
  }

  void rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
            std::uint64_t* hash) override {
    if (dense != nullptr)
      dense->assign(receivers.size() * patch_count_, 0);
    Hash all;
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      for (int f = 0; f < raster::kFaceCount; ++f) {
        const Face face = static_cast<Face>(f);
        const std::int32_t height = raster::hemicube_grid(face, reader_.resolution()).height;
        for (std::int32_t y = 0; y < height; y += strip_height_)
          copy_strip(face, y, std::min(strip_height_, height - y));
      }
      reader_.finish(dense == nullptr ? nullptr : dense->data() + k * patch_count_, &all);
    }
    *hash = all.value();
  }

private:
  void copy_strip(Face face, std::int32_t y, std::int32_t height) {
    const std::size_t pitch = reader_.resolution();
    const std::size_t count = static_cast<std::size_t>(height) * pitch;
    Item* items = items_.data() + 16;
    float* depths = depths_.data();
    std::fill_n(items, count, raster::kNoItem);
    std::fill_n(depths, count, 0.0f);
    const std::int32_t drawn_y = y / (strip_height_ * copies_) * (strip_height_ * copies_);
    const Item* drawn =
        faces_[static_cast<std::size_t>(face)].data() + static_cast<std::size_t>(drawn_y) * pitch;
    for (std::size_t k = 0; k < count; ++k) {
      const bool nearer = kDepth > depths[k];
      items[k] = nearer ? drawn[k] : items[k];
      depths[k] = nearer ? kDepth : depths[k];
    }
    for (std::int32_t row = 0; row < height; ++row)
      reader_.add_row(face, y + row, items + static_cast<std::size_t>(row) * pitch);
  }

  static constexpr float kDepth = 0.5f;

  std::uint32_t patch_count_ = 0;
  std::int32_t strip_height_ = 0;
  std::int32_t copies_ = 1;                     ///< of a strip
  std::vector<Item> faces_[raster::kFaceCount]; ///< [face][y][x]
  std::vector<Item> items_;                     ///< of a strip, room of 16 before and after
  std::vector<float> depths_;
  RunReader reader_;
};

} // namespace

std::unique_ptr<Peer> make_floor_peer() {
  return std::make_unique<FloorPeer>();
}

} // namespace hemicube::bench
