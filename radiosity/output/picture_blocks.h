#pragma once

#include "radiosity/hemicube/five_views.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/parallel/executor.h"
#include "raster/fp_environment.h"
#include "raster/rasterizer.h"

#include <algorithm>

namespace hemicube::radiosity {

/// Some pixels of a picture, [left, right) x [top, bottom).
struct PixelBlock {
  std::int32_t left, top, right, bottom;
};

namespace detail {

/// What a worker draws with.
struct BlockPainter {
  raster::Rasterizer rasterizer;
  raster::ItemBuffer buffer;
  bool is_ready = false;

  Status prepare(const raster::PolygonTree& tree, const raster::Kernels& kernels,
                 const raster::View& view) {
    if (is_ready)
      return {};
    HC_TRY(rasterizer.init(tree, kernels));
    HC_TRY(buffer.init());
    rasterizer.begin(view);
    is_ready = true;
    return {};
  }
};

} // namespace detail

/// Draws what a camera sees, block by block on the workers, and calls
/// visit(const raster::ItemBuffer&, const PixelBlock&) for each block; every pixel is in one block.
/// @param view     with `samples` along each side of a pixel
/// @param margin   samples around the block's own that its buffer holds besides, where the grid has
///                 them
/// @return kOutOfMemory
template <typename Visit>
Status for_each_picture_block(const PatchSet& patches, const CameraView& view, std::int32_t samples,
                              std::int32_t margin, const raster::Kernels& kernels,
                              Executor& executor, Visit visit) {
  raster::PolygonTree tree;
  HC_TRY(tree.build(polygons_of(patches)));
  FixedArray<detail::BlockPainter> of_worker;
  HC_TRY(of_worker.init(executor.worker_count()));
  const raster::PixelGrid& grid = view.grid;
  const std::int32_t side = (raster::kMaxWindowSize - 2 * margin) / samples;
  const std::int32_t width = grid.width / samples, height = grid.height / samples;
  const std::int32_t columns = (width + side - 1) / side, rows = (height + side - 1) / side;
  const auto in_row = static_cast<std::size_t>(columns);
  const std::size_t count = in_row * static_cast<std::size_t>(rows);
  return executor.for_each(count, [&](std::size_t index, std::size_t worker) -> Status {
    const FloatEnvironment environment;
    detail::BlockPainter& painter = of_worker[worker];
    HC_TRY(painter.prepare(tree, kernels, view.view));
    const std::int32_t left = static_cast<std::int32_t>(index % in_row) * side;
    const std::int32_t top = static_cast<std::int32_t>(index / in_row) * side;
    const PixelBlock block{left, top, std::min(left + side, width), std::min(top + side, height)};
    const std::int32_t x = std::max(block.left * samples - margin, 0);
    const std::int32_t y = std::max(block.top * samples - margin, 0);
    painter.buffer.begin({x, y, std::min(block.right * samples + margin, grid.width) - x,
                          std::min(block.bottom * samples + margin, grid.height) - y});
    painter.rasterizer.draw(raster::Face::kTop, grid, &painter.buffer);
    visit(std::as_const(painter.buffer), block);
    return {};
  });
}

} // namespace hemicube::radiosity
