#pragma once

#include "raster/face_view.h"
#include "raster/item_buffer.h"
#include "raster/polygon_setup.h"
#include "raster/polygons.h"
#include "raster/simd/dispatch.h"

namespace hemicube::raster {

/// Draws polygons into item buffers. Re-entrant: one object per thread.
/// What a pixel gets is a function of the set of polygons and the view alone: the polygon whose
/// projection covers the pixel centre with the largest 1/z > 0; among equals a facing one before
/// one seen from the back, then the lowest id. Polygons reach from the eye plane to infinity:
/// nothing is clipped and there is no near plane.
class Rasterizer {
public:
  /// @param planes   from compute_planes(polygons); both must outlive the rasterizer
  Status init(const Polygons& polygons, std::span<const Plane> planes, const Kernels& kernels);

  /// Takes on a view: transforms the vertices and sets up the edges of all polygons.
  void begin(const View& view);

  /// Draws what the view shows in a face into the buffer's window (ItemBuffer::begin has cleared
  /// it).
  void draw(Face face, const PixelGrid& grid, ItemBuffer* buffer);

private:
  const Kernels* kernels_ = nullptr;
  Polygons polygons_;
  std::span<const Plane> planes_;
  ViewSetup setup_;
  EdgeScratch edges_;
  Buffer<std::int32_t> span_begin_, span_end_; ///< [row of the window]
  Buffer<float> span_depth_;
};

} // namespace hemicube::raster
