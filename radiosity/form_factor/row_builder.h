#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/form_factor/row_accumulator.h"
#include "radiosity/hemicube/delta_form_factors.h"
#include "raster/rasterizer.h"

namespace hemicube::radiosity {

/// What all rows of a scene share. Built once, read by every worker.
struct RowSetup {
  const raster::PolygonTree* tree = nullptr;
  DeltaFormFactors delta;
  const raster::Kernels* kernels = nullptr;
  bool hash_items = false;

  /// @param tree_in  outlives this
  Status init(const raster::PolygonTree& tree_in, std::uint32_t resolution,
              const raster::Kernels& kernels_in, bool hash_items_in);
};

/// Turns item buffers into rows of form factors: rung `hemicube`. One per worker.
class RowBuilder {
public:
  /// @param setup  must outlive the builder
  Status init(const RowSetup& setup);
  bool ready() const noexcept { return setup_ != nullptr; }

  /// Renders the hemicube of a view and sums it up. row + space + back side is exactly 1 in units
  /// of 2^-48 before the entries are rounded to float; the row's scale restores its exact sum
  /// after.
  /// @return the row; its spans are valid until the next call
  RowView build(const raster::View& view);

  /// Hash of the item buffers of the last row, with RowSetup::hash_items.
  std::uint64_t item_hash() const noexcept { return item_hash_; }

private:
  void read_out(raster::Face face);
  RowView close_row();

  const RowSetup* setup_ = nullptr;
  raster::Rasterizer rasterizer_;
  raster::ItemBuffer buffer_;
  RowAccumulator accumulator_;
  Buffer<std::uint32_t> columns_;
  Buffer<float> values_;
  std::uint64_t space_ = 0, back_side_ = 0; ///< units of 2^-48
  std::uint64_t item_hash_ = 0;
};

} // namespace hemicube::radiosity
