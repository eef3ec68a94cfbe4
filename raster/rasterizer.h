#pragma once

#include "raster/face_view.h"
#include "raster/item_buffer.h"
#include "raster/kernels.h"
#include "raster/polygon_tree.h"
#include "raster/visit_queue.h"

namespace hemicube::raster {

/// Whether what cannot be seen is left out before it is drawn. The pixels are the same.
enum class Culling : std::uint8_t { kOn, kOff };

/// Draws polygons into item buffers. Re-entrant: one object per thread, a few KiB each.
/// What a pixel gets is a function of the set of polygons and the view alone: the polygon whose
/// projection covers the pixel centre with the largest 1/z > 0; among equals a facing one before
/// one seen from the back, then the lowest id. Polygons reach from the eye plane to infinity:
/// nothing is clipped and there is no near plane.
class Rasterizer {
public:
  /// @param tree  must outlive the rasterizer
  Status init(const PolygonTree& tree, const Kernels& kernels, Culling culling = Culling::kOn);

  /// Takes on a view.
  void begin(const View& view);

  /// Draws what the view shows in a face into the buffer's window (ItemBuffer::begin has cleared
  /// it).
  void draw(Face face, const PixelGrid& grid, ItemBuffer* buffer);

private:
  void set_window(Face face, const PixelGrid& grid, const Window& window);
  void draw_front_to_back(const WindowPlanes& planes);
  void draw_visit(const Visit& visit, const WindowPlanes& planes);
  template <typename Take> void open_node(const Node& node, Take take);
  void draw_cluster(std::uint32_t index, Occlusion occlusion, const WindowPlanes& planes);

  const PolygonTree* tree_ = nullptr;
  const Kernels* kernels_ = nullptr;
  Culling culling_ = Culling::kOn;
  View view_;
  double farthest_ = 0; ///< no corner is farther from the eye
  WindowProblem polygon_problem_{};
  NodeProblem node_problem_{};
  PolygonBatch batch_{};
  Buffer<double> edges_, moved_corners_;
  VisitQueue queue_;
};

} // namespace hemicube::raster
