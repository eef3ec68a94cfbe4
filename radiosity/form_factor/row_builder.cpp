#include "radiosity/form_factor/row_builder.h"

#include <algorithm>

namespace hemicube::radiosity {

using raster::Face;
using raster::Window;

namespace {

/// Sums are asked for this many rows before they are needed.
constexpr std::size_t kRowsAhead = 2;

} // namespace

Status RowSetup::init(const raster::PolygonTree& tree_in, std::uint32_t resolution,
                      const raster::Kernels& kernels_in, bool hash_items_in) {
  kernels = &kernels_in;
  hash_items = hash_items_in;
  tree = &tree_in;
  return delta.init(resolution);
}

Status RowBuilder::init(const RowSetup& setup) {
  HC_TRY(rasterizer_.init(*setup.tree, *setup.kernels));
  HC_TRY(buffer_.init());
  const std::uint64_t resolution = setup.delta.resolution();
  const std::uint64_t most_entries =
      std::min<std::uint64_t>(setup.tree->polygon_count(), 3 * resolution * resolution);
  HC_TRY(accumulator_.init(setup.tree->polygon_count(), most_entries));
  HC_TRY(columns_.resize(most_entries + 1));
  HC_TRY(values_.resize(most_entries + 1));
  setup_ = &setup;
  return {};
}

RowView RowBuilder::build(const raster::View& view) {
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
  const std::uint64_t* sums = setup_->delta.sums(face).data() + buffer_.window().x;
  const std::size_t pitch = setup_->delta.resolution();
  buffer_.take_runs(*setup_->kernels, [&](std::int32_t y, const raster::ItemBuffer::Runs& runs) {
    const std::uint64_t* row = sums + static_cast<std::size_t>(y) * pitch;
    std::uint64_t before = row[0];
    for (std::int32_t k = 0; k < runs.count; ++k) {
      const std::uint64_t after = row[runs.begins[k + 1]];
      // The sums of large faces do not fit the cache, and runs end about where they end in the rows
      // that come next.
      __builtin_prefetch(row + kRowsAhead * pitch + runs.begins[k + 1]);
      const std::uint64_t weight = after - before;
      before = after;
      const raster::Item item = runs.items[k];
      if (!raster::is_back_facing(item))
        accumulator_.add(item, weight);
      else if (item == raster::kNoItem)
        space_ += weight;
      else
        back_side_ += weight;
    }
  });
}

RowView RowBuilder::close_row() {
  constexpr double kUnit = 0x1p-48;
  static_assert(kUnit * static_cast<double>(kFormFactorUnit) == 1);
  const std::size_t count = accumulator_.take(kUnit, columns_.data(), values_.data());
  RowView row;
  row.columns = columns_.span().first(count);
  row.values = values_.span().first(count);
  row.space = static_cast<double>(space_) * kUnit;
  row.back_side = static_cast<double>(back_side_) * kUnit;
  fit_scale(static_cast<double>(kFormFactorUnit - space_ - back_side_) * kUnit, &row);
  return row;
}

} // namespace hemicube::radiosity
