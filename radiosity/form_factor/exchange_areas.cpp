#include "radiosity/form_factor/exchange_areas.h"

#include "radiosity/form_factor/matrix_columns.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

/// Rows of one block, one after the other.
struct BlockRows {
  Buffer<std::uint32_t> columns;
  Buffer<float> values;
  std::size_t count = 0; ///< entries filled
};

/// Appends row i: the union of a row and a column of the same number.
/// @param half  1/2 over the unit of areas
Status append_average(const RowView& row, std::uint64_t i, const MatrixColumns& columns,
                      std::span<const double> area, double half, BlockRows* rows) {
  const std::span<const ColumnEntry> column = columns.column(i);
  const std::size_t most = rows->count + row.columns.size() + column.size();
  if (most > rows->columns.size()) {
    HC_TRY(rows->columns.resize(2 * most));
    HC_TRY(rows->values.resize(2 * most));
  }
  std::size_t at = rows->count;
  for (std::size_t k = 0, m = 0; k < row.columns.size() || m < column.size(); ++at) {
    const bool has_there =
        m == column.size() || (k < row.columns.size() && row.columns[k] <= column[m].row);
    const bool has_back =
        k == row.columns.size() || (m < column.size() && column[m].row <= row.columns[k]);
    const std::uint32_t j = has_there ? row.columns[k] : column[m].row;
    double sum = 0;
    if (has_there)
      sum = area[i] * (row.scale * static_cast<double>(row.values[k++]));
    if (has_back)
      sum += area[j] * (columns.scale(j) * static_cast<double>(column[m++].value));
    rows->columns[at] = j;
    rows->values[at] = static_cast<float>(sum * half);
  }
  rows->count = at;
  return {};
}

} // namespace

Status exchange_areas(const FormFactorMatrix& matrix, std::span<const double> area,
                      Executor& executor, FormFactorMatrix* exchange) {
  double largest = 0;
  for (const double a : area)
    largest = std::max(largest, a);
  HC_TRY(exchange->init(matrix.row_count(), matrix.column_count()));
  FixedArray<BlockRows> of_worker;
  HC_TRY(of_worker.init(executor.worker_count()));
  const auto visit = [&](std::size_t block, std::size_t worker, const MatrixColumns& columns) {
    BlockRows& rows = of_worker[worker];
    std::size_t ends[FormFactorMatrix::kBlockRows];
    const std::uint64_t begin = matrix.block_begin(block), end = matrix.block_end(block);
    rows.count = 0;
    for (std::uint64_t i = begin; i < end; ++i) {
      HC_TRY(append_average(matrix.row(i), i, columns, area, 0.5 / largest, &rows));
      ends[i - begin] = rows.count;
    }
    HC_TRY(exchange->reserve_block(block, rows.count));
    for (std::uint64_t i = begin; i < end; ++i) {
      const std::size_t first = i == begin ? 0 : ends[i - begin - 1];
      RowView row = matrix.row(i);
      row.columns = rows.columns.span().subspan(first, ends[i - begin] - first);
      row.values = rows.values.span().subspan(first, ends[i - begin] - first);
      row.scale = 1;
      HC_TRY(exchange->append_row(block, row));
    }
    return Status();
  };
  return for_each_block_with_columns(matrix, executor, visit);
}

} // namespace hemicube::radiosity
