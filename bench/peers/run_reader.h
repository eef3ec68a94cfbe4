#pragma once

#include "radiosity/form_factor/row_accumulator.h"
#include "radiosity/hemicube/delta_form_factors.h"
#include "raster/hash.h"
#include "raster/types.h"

#include <cstdint>
#include <vector>

namespace hemicube::bench {

/// Turns id planes into rows of form factors: runs of equal ids, found in vectors, weigh the
/// difference of two running sums. What every peer uses.
class RunReader {
public:
  void prepare(std::uint32_t patch_count, std::uint32_t resolution);

  std::uint32_t resolution() const { return delta_.resolution(); }

  /// Adds one row of pixels of a face; backs and kNoItem are left out.
  /// @param items  `resolution` of them, and room to read 16 more and one before
  void add_row(raster::Face face, std::int32_t y, const raster::Item* items);

  /// Ends a row of the matrix.
  /// @param dense  null, or one value per patch
  void finish(double* dense, Hash* hash);

private:
  radiosity::DeltaFormFactors delta_;
  radiosity::RowAccumulator accumulator_;
  std::vector<std::int32_t> begins_;
  std::vector<raster::Item> run_items_;
  std::vector<std::uint32_t> columns_;
  std::vector<float> values_;
};

} // namespace hemicube::bench
