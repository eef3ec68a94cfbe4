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

/// Reads a square matrix by columns, a tile of consecutive ones at a time: every row has a cursor
/// that moves on with the tiles, so that all columns together cost O(non-zeros). The matrix must
/// not change meanwhile.
class MatrixColumns {
public:
  /// How many columns make a tile: so many that a row has about kEntriesPerVisit entries in it.
  static std::uint64_t tile_columns(const FormFactorMatrix& matrix) noexcept;

  /// Moves the cursors of all rows to a column.
  Status seek(const FormFactorMatrix& matrix, std::uint64_t column) noexcept;

  /// Reads columns begin .. end-1. @param begin  the column sought, or the end of the last tile
  Status read(std::uint64_t begin, std::uint64_t end) noexcept;

  /// A column of the last tile read, rows ascending.
  std::span<const ColumnEntry> column(std::uint64_t index) const noexcept {
    const Column& column = tile_[index - begin_];
    return column.entries.span().first(column.count);
  }
  double scale(std::uint32_t row) const noexcept { return cursors_[row].scale; }

private:
  struct Cursor {
    const std::uint32_t *column, *end;
    const float* value;
    double scale;
  };
  struct Column {
    Buffer<ColumnEntry> entries; ///< [count], and room for more
    std::size_t count = 0;
  };
  Buffer<Cursor> cursors_; ///< [row]
  FixedArray<Column> tile_;
  std::uint64_t begin_ = 0;
};

/// Calls Status visit(block, worker, const MatrixColumns&) for every block of rows, the columns of
/// the same numbers as its rows being read.
template <typename Visit>
Status for_each_block_with_columns(const FormFactorMatrix& matrix, Executor& executor,
                                   Visit visit) {
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
