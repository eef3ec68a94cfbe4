#include "radiosity/form_factor/row_builder.h"

#include "raster/span_kernel.h"

#include <algorithm>

namespace hemicube::radiosity {

using raster::Face;
using raster::Window;

Status RowSetup::init(const raster::Polygons& polygons_in, std::uint32_t resolution,
                      const raster::Kernels& kernels_in, bool hash_items_in) {
  polygons = polygons_in;
  kernels = &kernels_in;
  hash_items = hash_items_in;
  HC_TRY(delta.init(resolution));
  return raster::compute_planes(polygons, &planes);
}

Status RowBuilder::init(const RowSetup& setup) {
  HC_TRY(rasterizer_.init(setup.polygons, setup.planes.span(), *setup.kernels));
  HC_TRY(buffer_.init());
  const std::uint64_t resolution = setup.delta.resolution();
  const std::uint64_t most_entries =
      std::min<std::uint64_t>(setup.polygons.count(), 3 * resolution * resolution);
  HC_TRY(accumulator_.init(most_entries));
  HC_TRY(breaks_.resize(raster::kMaxWindowSize));
  HC_TRY(columns_.resize(most_entries));
  HC_TRY(values_.resize(most_entries));
  setup_ = &setup;
  return {};
}

RowView RowBuilder::build(const raster::View& view) {
  accumulator_.clear();
  space_ = back_side_ = item_hash_ = 0;
  rasterizer_.begin(view);
  for (int f = 0; f < raster::kFaceCount; ++f) {
    const Face face = static_cast<Face>(f);
    const raster::PixelGrid grid = raster::hemicube_grid(face, setup_->delta.resolution());
    for (std::int32_t y = 0; y < grid.height; y += raster::kMaxWindowSize)
      for (std::int32_t x = 0; x < grid.width; x += raster::kMaxWindowSize) {
        buffer_.begin({x, y, std::min(raster::kMaxWindowSize, grid.width - x),
                       std::min(raster::kMaxWindowSize, grid.height - y)});
        rasterizer_.draw(face, grid, &buffer_);
        if (setup_->hash_items)
          item_hash_ = raster::hash_items(buffer_, item_hash_);
        read_out(face);
      }
  }
  return close_row();
}

void RowBuilder::read_out(Face face) {
  const Window& window = buffer_.window();
  const std::uint64_t* sums = setup_->delta.sums(face).data();
  for (std::int32_t y = window.y; y < window.y + window.height; ++y) {
    const raster::Item* items = buffer_.items(y);
    const std::uint64_t* row =
        sums + static_cast<std::size_t>(y) * setup_->delta.resolution() + window.x;
    const std::int32_t count = setup_->kernels->run_breaks(items, window.width, breaks_.data());
    std::int32_t begin = 0;
    for (std::int32_t k = 0; k <= count; ++k) {
      const std::int32_t end = k < count ? breaks_[static_cast<std::size_t>(k)] : window.width;
      const std::uint64_t weight = row[end] - row[begin];
      const raster::Item item = items[begin];
      if (item == raster::kNoItem)
        space_ += weight;
      else if (raster::is_back_facing(item))
        back_side_ += weight;
      else
        accumulator_.add(item, weight);
      begin = end;
    }
  }
}

RowView RowBuilder::close_row() {
  constexpr double kUnit = 0x1p-48;
  static_assert(kUnit * static_cast<double>(kFormFactorUnit) == 1);
  std::size_t count = 0;
  for (const RowAccumulator::Entry& entry : accumulator_.sorted()) {
    columns_[count] = entry.id;
    values_[count] = static_cast<float>(static_cast<double>(entry.weight) * kUnit);
    ++count;
  }
  RowView row;
  row.columns = columns_.span().first(count);
  row.values = values_.span().first(count);
  row.space = static_cast<double>(space_) * kUnit;
  row.back_side = static_cast<double>(back_side_) * kUnit;
  row.scale = 1;
  const double share = static_cast<double>(kFormFactorUnit - space_ - back_side_) * kUnit;
  if (count != 0)
    row.scale = share / row_sum(row);
  while (row_sum(row) > share) // by a rounding: a row above 1 would make light from nothing
    row.scale *= 1 - 0x1p-53;
  return row;
}

} // namespace hemicube::radiosity
