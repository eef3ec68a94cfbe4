#pragma once

#include "raster/face_view.h"
#include "raster/item_buffer.h"
#include "raster/polygon_tree.h"
#include "raster/rasterizer.h"
#include "raster/simd/dispatch.h"

#include <string>
#include <vector>

namespace hemicube::test {

/// A whole grid as the rasterizer drew it.
struct DrawnFace {
  int width = 0, height = 0;
  std::vector<raster::Item> items; ///< [y][x]
  std::vector<float> depths;       ///< [y][x] 1/z

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// Bit for bit.
bool same_bits(const DrawnFace& a, const DrawnFace& b);

/// A rasterizer with its tree and its buffer.
class Drawer {
public:
  Drawer(const raster::Polygons& polygons, const raster::Kernels& kernels,
         raster::Culling culling = raster::Culling::kOn);

  void begin(const raster::View& view) { rasterizer_.begin(view); }

  /// Draws a grid in windows of at most the given size.
  DrawnFace draw(raster::Face face, const raster::PixelGrid& grid,
                 int window_width = raster::kMaxWindowSize,
                 int window_height = raster::kMaxWindowSize);

private:
  raster::PolygonTree tree_;
  raster::Rasterizer rasterizer_;
  raster::ItemBuffer buffer_;
};

/// The names of the kernels this machine runs, "scalar" first.
std::vector<std::string> kernels_here();

inline constexpr raster::Face kFaces[raster::kFaceCount] = {
    raster::Face::kTop, raster::Face::kPlusX, raster::Face::kMinusX, raster::Face::kPlusY,
    raster::Face::kMinusY};

} // namespace hemicube::test
