#include "radiosity/form_factor/reciprocity.h"

#include "radiosity/form_factor/matrix_columns.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

struct Sums {
  double max = 0, squares = 0, all = 0;
};

} // namespace

Status measure_reciprocity(const FormFactorMatrix& matrix, std::span<const double> area,
                           Executor& executor, Reciprocity* reciprocity,
                           std::span<const std::uint8_t> is_left_out) {
  Buffer<Sums> blocks;
  HC_TRY(blocks.resize(matrix.block_count()));
  Buffer<std::uint8_t> counts; // [patch]
  HC_TRY(counts.resize(matrix.row_count()));
  HC_TRY(matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i)
      counts[i] = is_computed(matrix.row(i)) && (is_left_out.empty() || is_left_out[i] == 0);
    return Status();
  }));
  const auto visit = [&](std::size_t block, std::size_t, const MatrixColumns& columns) {
    Sums sums;
    for (std::uint64_t i = matrix.block_begin(block); i < matrix.block_end(block); ++i) {
      if (counts[i] == 0)
        continue;
      const RowView row = matrix.row(i);
      const std::span<const ColumnEntry> column = columns.column(i);
      for (std::size_t k = 0, m = 0; k < row.columns.size(); ++k) {
        const std::uint32_t j = row.columns[k];
        while (m < column.size() && column[m].row < j)
          ++m;
        const bool has_back = m < column.size() && column[m].row == j;
        // A pair with two entries is met from both sides and counted from the lower one.
        if (counts[j] == 0 || (has_back && j < i))
          continue;
        const double back =
            has_back ? area[j] * (columns.scale(j) * static_cast<double>(column[m].value)) : 0;
        const double there = area[i] * row.scale * static_cast<double>(row.values[k]);
        const double larger = std::max(there, back);
        sums.max = std::max(sums.max, std::fabs(there - back) / std::min(area[i], area[j]));
        sums.squares += (there - back) * (there - back);
        sums.all += larger * larger;
      }
    }
    blocks[block] = sums;
    return Status();
  };
  HC_TRY(for_each_block_with_columns(matrix, executor, visit));
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
