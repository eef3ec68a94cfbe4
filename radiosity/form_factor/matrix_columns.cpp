#include "radiosity/form_factor/matrix_columns.h"

namespace hemicube::radiosity {
namespace {

/// Enough that coming to another row, a miss of every cache, costs little beside its entries.
constexpr std::uint64_t kEntriesPerVisit = 16;

} // namespace

std::uint64_t MatrixColumns::tile_columns(const FormFactorMatrix& matrix) noexcept {
  constexpr std::uint64_t kBlock = FormFactorMatrix::kBlockRows;
  const std::uint64_t per_row = 1 + matrix.nonzero_count() / (1 + matrix.row_count());
  const std::uint64_t columns = kEntriesPerVisit * matrix.column_count() / per_row;
  return (columns / kBlock + 1) * kBlock;
}

std::uint64_t MatrixColumns::wide_tile_columns(const FormFactorMatrix& matrix) noexcept {
  constexpr std::uint64_t kRangeRows =
      FormFactorMatrix::kBlockRows * FormFactorMatrix::kRangeBlocks;
  const std::uint64_t per_column = 1 + matrix.nonzero_count() / (1 + matrix.column_count());
  // Columns have room for up to twice what is in them.
  const std::uint64_t columns =
      matrix.storage().most_bytes / 4 / (sizeof(ColumnEntry) * per_column + sizeof(Column));
  return (columns / kRangeRows + 1) * kRangeRows;
}

Status MatrixColumns::begin_tile(std::uint64_t begin, std::uint64_t end) noexcept {
  if (tile_.size() < end - begin)
    HC_TRY(tile_.init(end - begin));
  begin_ = begin;
  for (Column& column : tile_)
    column.count = 0;
  return {};
}

Status MatrixColumns::add(std::uint32_t index, const ColumnEntry& entry) noexcept {
  Column& column = tile_[index - begin_];
  if (column.count == column.entries.size())
    HC_TRY(column.entries.resize(2 * column.count + 64));
  column.entries[column.count++] = entry;
  return {};
}

Status MatrixColumns::seek(const FormFactorMatrix& matrix, std::uint64_t column) noexcept {
  HC_TRY(cursors_.resize(matrix.row_count()));
  HC_TRY(scales_.resize(matrix.row_count()));
  if (tile_.size() == 0)
    HC_TRY(tile_.init(tile_columns(matrix)));
  for (std::uint64_t i = 0; i < matrix.row_count(); ++i) {
    const RowView row = matrix.row(i);
    const std::uint32_t* begin = row.columns.data();
    const std::uint32_t* end = begin + row.columns.size();
    const std::uint32_t* at = column == 0 ? begin : std::lower_bound(begin, end, column);
    cursors_[i] = {at, end, row.values.data() + (at - begin)};
    scales_[i] = row.scale;
  }
  return {};
}

Status MatrixColumns::read(std::uint64_t begin, std::uint64_t end) noexcept {
  HC_TRY(begin_tile(begin, end));
  for (std::size_t i = 0; i < cursors_.size(); ++i) {
    Cursor& cursor = cursors_[i];
    for (; cursor.column != cursor.end && *cursor.column < end; ++cursor.column, ++cursor.value)
      HC_TRY(add(*cursor.column, {static_cast<std::uint32_t>(i), *cursor.value}));
  }
  return {};
}

Status MatrixColumns::read(const FormFactorMatrix& matrix, std::uint64_t begin,
                           std::uint64_t end) noexcept {
  HC_TRY(begin_tile(begin, end));
  HC_TRY(scales_.resize(matrix.row_count()));
  return matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i) {
      const RowView row = matrix.row(i);
      scales_[i] = row.scale;
      const auto from = std::lower_bound(row.columns.begin(), row.columns.end(), begin);
      for (std::size_t k = static_cast<std::size_t>(from - row.columns.begin());
           k < row.columns.size() && row.columns[k] < end; ++k)
        HC_TRY(add(row.columns[k], {static_cast<std::uint32_t>(i), row.values[k]}));
    }
    return Status();
  });
}

} // namespace hemicube::radiosity
