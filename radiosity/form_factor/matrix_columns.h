#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"
#include "raster/fp_environment.h"

#include <algorithm>

namespace hemicube::radiosity {

/// One entry of a column: F_row,column = scale of the row * value.
struct ColumnEntry {
  std::uint32_t row;
  float value;
};

/// Reads a square matrix by columns, a tile of consecutive ones at a time. The matrix must not
/// change meanwhile.
class MatrixColumns {
public:
  /// How many columns make a tile of a matrix in memory: so many that a row has about
  /// kEntriesPerVisit entries in it.
  static std::uint64_t tile_columns(const FormFactorMatrix& matrix) noexcept;
  /// Of a matrix in a file, which is read once for every tile: as many as memory allows.
  static std::uint64_t wide_tile_columns(const FormFactorMatrix& matrix) noexcept;

  /// Moves the cursors of all rows, one each, to a column. The matrix must be in memory.
  Status seek(const FormFactorMatrix& matrix, std::uint64_t column) noexcept;

  /// Reads columns begin .. end-1, the cursors moving on with the tiles, so that all columns
  /// together cost O(non-zeros). @param begin  the column sought, or the end of the last tile
  Status read(std::uint64_t begin, std::uint64_t end) noexcept;

  /// The same in one walk over a matrix that may be in a file.
  Status read(const FormFactorMatrix& matrix, std::uint64_t begin, std::uint64_t end) noexcept;

  /// A column of the last tile read, rows ascending.
  std::span<const ColumnEntry> column(std::uint64_t index) const noexcept {
    const Column& column = tile_[index - begin_];
    return column.entries.span().first(column.count);
  }
  double scale(std::uint32_t row) const noexcept { return scales_[row]; }

private:
  struct Cursor {
    const std::uint32_t *column, *end;
    const float* value;
  };
  struct Column {
    Buffer<ColumnEntry> entries; ///< [count], and room for more
    std::size_t count = 0;
  };
  Status begin_tile(std::uint64_t begin, std::uint64_t end) noexcept;
  Status add(std::uint32_t column, const ColumnEntry& entry) noexcept;

  Buffer<Cursor> cursors_; ///< [row]
  Buffer<double> scales_;  ///< [row]
  FixedArray<Column> tile_;
  std::uint64_t begin_ = 0;
};

template <typename Visit>
Status for_each_block_with_columns_in_file(const FormFactorMatrix& matrix, Executor& executor,
                                           Visit visit) {
  MatrixColumns columns;
  const std::uint64_t tile = MatrixColumns::wide_tile_columns(matrix), count = matrix.row_count();
  for (std::uint64_t begin = 0; begin < count; begin += tile) {
    const std::uint64_t end = std::min(begin + tile, count);
    HC_TRY(columns.read(matrix, begin, end));
    constexpr std::uint64_t kRows = FormFactorMatrix::kBlockRows;
    const auto visit_range = [&](std::size_t first, std::size_t last) {
      return executor.for_each(last - first, [&](std::size_t block, std::size_t worker) {
        const FloatEnvironment environment;
        return visit(first + block, worker, columns);
      });
    };
    HC_TRY(matrix.for_each_range(begin / kRows, (end + kRows - 1) / kRows, visit_range));
  }
  return {};
}

/// Calls Status visit(block, worker, const MatrixColumns&) for every block of rows, the columns of
/// the same numbers as its rows being read.
template <typename Visit>
Status for_each_block_with_columns(const FormFactorMatrix& matrix, Executor& executor,
                                   Visit visit) {
  if (!matrix.is_in_memory())
    return for_each_block_with_columns_in_file(matrix, executor, visit);
  constexpr std::size_t kParts = 16; // each seeks once: that is dear
  FixedArray<MatrixColumns> of_worker;
  HC_TRY(of_worker.init(executor.worker_count()));
  const std::size_t blocks = matrix.block_count();
  const std::size_t tile = MatrixColumns::tile_columns(matrix) / FormFactorMatrix::kBlockRows;
  return executor.for_each(kParts, [&](std::size_t part, std::size_t worker) {
    const FloatEnvironment environment;
    MatrixColumns& columns = of_worker[worker];
    const std::size_t first = blocks * part / kParts, last = blocks * (part + 1) / kParts;
    if (first != last)
      HC_TRY(columns.seek(matrix, matrix.block_begin(first)));
    for (std::size_t begin = first; begin < last; begin += tile) {
      const std::size_t end = std::min(begin + tile, last);
      HC_TRY(columns.read(matrix.block_begin(begin), matrix.block_end(end - 1)));
      for (std::size_t block = begin; block < end; ++block)
        HC_TRY(visit(block, worker, columns));
    }
    return Status();
  });
}

} // namespace hemicube::radiosity
