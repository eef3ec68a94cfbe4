#include "raster/rasterizer.h"

#include <cmath>

namespace hemicube::raster {
namespace {

/// Testing more tiles than this costs more than drawing.
constexpr std::int32_t kMaxTilesTested = 16;

/// True if all directions of the grid lie within the 90 degree window that ViewPolygon::faces is
/// about.
bool within_hemicube_face(const PixelGrid& grid) {
  const double x1 = grid.x0 + (grid.width - 1) * grid.dx;
  const double y1 = grid.y0 + (grid.height - 1) * grid.dy;
  return std::fabs(grid.x0) < 1 && std::fabs(x1) < 1 && std::fabs(grid.y0) < 1 && std::fabs(y1) < 1;
}

} // namespace

Status Rasterizer::init(const Polygons& polygons, std::span<const Plane> planes,
                        const Kernels& kernels) {
  HC_ASSERT(planes.size() == polygons.count());
  kernels_ = &kernels;
  polygons_ = polygons;
  planes_ = planes;
  HC_TRY(setup_.init(polygons));
  HC_TRY(edges_.init(polygons));
  constexpr std::size_t kRows = kMaxWindowSize + kSpanPadding;
  HC_TRY(span_begin_.resize(kRows));
  HC_TRY(span_end_.resize(kRows));
  return span_depth_.resize(kRows);
}

void Rasterizer::begin(const View& view) {
  setup_.prepare(polygons_, planes_, view);
}

void Rasterizer::draw(Face face, const PixelGrid& grid, ItemBuffer* buffer) {
  const auto face_bit = static_cast<std::uint8_t>(1u << static_cast<unsigned>(face));
  const bool use_face_bit = within_hemicube_face(grid);
  const Window& window = buffer->window();
  const RowSpans spans = {span_begin_.data(), span_end_.data(), span_depth_.data()};
  for (const ViewPolygon& polygon : setup_.drawn()) {
    if (use_face_bit && (polygon.faces & face_bit) == 0)
      continue;
    FacePolygon shape;
    if (!set_up_in_face(polygons_, setup_, polygon, face, grid, window, &edges_, &shape))
      continue;
    if (shape.tiles.count() <= kMaxTilesTested &&
        buffer->hides(shape.tiles, shape.nearest, *kernels_))
      continue;
    kernels_->solve_rows(&shape.rows, &spans);
    const std::int32_t top = shape.rows.row_begin;
    const FillProblem fill = {buffer->items(top),
                              buffer->depths(top),
                              kRowPitch,
                              window.x,
                              shape.rows.row_end - top,
                              shape.depth_per_pixel,
                              polygon.id | (polygon.facing ? 0u : kBackFacing)};
    kernels_->fill_rows(&fill, &spans);
    buffer->mark_drawn(shape.tiles);
  }
}

} // namespace hemicube::raster
