#include "radiosity/form_factor/reciprocity.h"

#include "raster/fp_environment.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

double entry(const RowView& row, std::uint32_t column) {
  const auto at = std::lower_bound(row.columns.begin(), row.columns.end(), column);
  if (at == row.columns.end() || *at != column)
    return 0;
  return row.scale *
         static_cast<double>(row.values[static_cast<std::size_t>(at - row.columns.begin())]);
}

/// A row that was computed has entries, or sees space or back sides.
bool is_computed(const RowView& row) {
  return !row.columns.empty() || row.space != 0 || row.back_side != 0;
}

struct Sums {
  double max = 0, squares = 0, all = 0;
};

} // namespace

Status measure_reciprocity(const FormFactorMatrix& matrix, std::span<const double> area,
                           Executor& executor, Reciprocity* reciprocity) {
  Buffer<Sums> blocks;
  HC_TRY(blocks.resize(matrix.block_count()));
  HC_TRY(executor.for_each(matrix.block_count(), [&](std::size_t block, std::size_t) {
    const FloatEnvironment environment;
    Sums sums;
    for (std::uint64_t i = matrix.block_begin(block); i < matrix.block_end(block); ++i) {
      const RowView row = matrix.row(i);
      for (std::size_t k = 0; k < row.columns.size(); ++k) {
        const std::uint32_t j = row.columns[k];
        const RowView other = matrix.row(j);
        const double back = area[j] * entry(other, static_cast<std::uint32_t>(i));
        // A pair with two entries is met from both sides and counted from the lower one.
        if (!is_computed(other) || (back != 0 && j < i))
          continue;
        const double there = area[i] * row.scale * static_cast<double>(row.values[k]);
        const double larger = std::max(there, back);
        sums.max = std::max(sums.max, std::fabs(there - back) / std::min(area[i], area[j]));
        sums.squares += (there - back) * (there - back);
        sums.all += larger * larger;
      }
    }
    blocks[block] = sums;
    return Status();
  }));
  Sums total;
  for (const Sums& sums : blocks) {
    total.max = std::max(total.max, sums.max);
    total.squares += sums.squares;
    total.all += sums.all;
  }
  *reciprocity = {total.max, total.all > 0 ? std::sqrt(total.squares / total.all) : 0};
  return {};
}

} // namespace hemicube::radiosity
