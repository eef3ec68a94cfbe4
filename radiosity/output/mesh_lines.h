#pragma once

#include "radiosity/output/color_image.h"
#include "radiosity/output/picture.h"
#include "raster/item_buffer.h"

namespace hemicube::radiosity {

/// Finds the samples of a picture that lie on the edges of patches as they are seen: those that
/// have another patch, or background, so near that lines are one pixel wide.
class MeshLines {
public:
  /// @param samples        along each side of a pixel, 1..kMaxSamples
  /// @param width, height  of the grid, samples
  MeshLines(std::uint32_t samples, std::int32_t width, std::int32_t height) noexcept;

  /// Samples around a pixel that count() reads besides its own.
  static std::int32_t margin(std::uint32_t samples) noexcept {
    return static_cast<std::int32_t>(samples + 1) / 2;
  }

  /// How many samples of pixel (x, y) lie on an edge.
  std::uint8_t count(const raster::ItemBuffer& buffer, std::int32_t x,
                     std::int32_t y) const noexcept;

private:
  bool is_on_edge(const raster::ItemBuffer& buffer, std::int32_t x, std::int32_t y) const noexcept;

  struct Offset {
    std::int8_t x, y;
  };
  std::int32_t samples_, width_, height_;
  Offset offsets_[64]; ///< of the samples that are near
  std::int32_t offset_count_ = 0;
};

/// Draws the lines of a picture with a mesh over an image of it: white over dark pixels, black over
/// bright ones, by the share of the pixel's samples on an edge.
void draw_mesh_lines(const Picture& picture, ColorImage* image) noexcept;

} // namespace hemicube::radiosity
