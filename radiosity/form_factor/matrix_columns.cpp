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

Status MatrixColumns::seek(const FormFactorMatrix& matrix, std::uint64_t column) noexcept {
  HC_TRY(cursors_.resize(matrix.row_count()));
  if (tile_.size() == 0)
    HC_TRY(tile_.init(tile_columns(matrix)));
  for (std::uint64_t i = 0; i < matrix.row_count(); ++i) {
    const RowView row = matrix.row(i);
    const std::uint32_t* begin = row.columns.data();
    const std::uint32_t* end = begin + row.columns.size();
    const std::uint32_t* at = column == 0 ? begin : std::lower_bound(begin, end, column);
    cursors_[i] = {at, end, row.values.data() + (at - begin), row.scale};
  }
  return {};
}

Status MatrixColumns::read(std::uint64_t begin, std::uint64_t end) noexcept {
  HC_ASSERT(end - begin <= tile_.size());
  begin_ = begin;
  for (Column& column : tile_)
    column.count = 0;
  for (std::size_t i = 0; i < cursors_.size(); ++i) {
    Cursor& cursor = cursors_[i];
    for (; cursor.column != cursor.end && *cursor.column < end; ++cursor.column, ++cursor.value) {
      Column& column = tile_[*cursor.column - begin];
      if (column.count == column.entries.size())
        HC_TRY(column.entries.resize(2 * column.count + 64));
      column.entries[column.count++] = {static_cast<std::uint32_t>(i), *cursor.value};
    }
  }
  return {};
}

} // namespace hemicube::radiosity
