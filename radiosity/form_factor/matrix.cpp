#include "radiosity/form_factor/matrix.h"

#include "radiosity/form_factor/interleaved_sum.h"
#include "raster/hash.h"

#include <bit>

namespace hemicube::radiosity {
double row_dot(const RowView& row, const double* x, std::size_t stride, std::size_t first,
               std::size_t last) noexcept {
  const std::uint32_t* columns = row.columns.data();
  const float* values = row.values.data();
  return row.scale * interleaved_sum(first, last, [=](std::size_t k) {
           return static_cast<double>(values[k]) * x[columns[k] * stride];
         });
}

double row_sum(const RowView& row) noexcept {
  const float* values = row.values.data();
  return row.scale * interleaved_sum(0, row.values.size(),
                                     [=](std::size_t k) { return static_cast<double>(values[k]); });
}

void fit_scale(double share, RowView* row) noexcept {
  row->scale = 1;
  const double sum = row_sum(*row);
  if (sum == 0)
    return;
  row->scale = share / sum;
  while (row_sum(*row) > share)
    row->scale *= 1 - 0x1p-53;
}

std::uint64_t hash_row(const RowView& row) noexcept {
  // Four chains side by side: one alone would be waited for.
  Hash chains[4];
  const std::size_t count = row.columns.size();
  for (std::size_t k = 0; k < count; ++k)
    chains[k % 4].add(std::uint64_t{row.columns[k]} << 32 |
                      std::bit_cast<std::uint32_t>(row.values[k]));
  Hash hash(count);
  for (const Hash& chain : chains)
    hash.add(chain.value());
  hash.add(row.scale);
  hash.add(row.space);
  hash.add(row.back_side);
  return hash.value();
}

Status FormFactorMatrix::init(std::uint64_t row_count, std::uint32_t column_count) noexcept {
  row_count_ = row_count;
  column_count_ = column_count;
  return blocks_.init(static_cast<std::size_t>((row_count + kBlockRows - 1) / kBlockRows));
}

std::uint64_t FormFactorMatrix::nonzero_count() const noexcept {
  std::uint64_t count = 0;
  for (const Block& block : blocks_)
    count += block.columns.size();
  return count;
}

RowView FormFactorMatrix::row(std::uint64_t index) const noexcept {
  const Block& block = blocks_[index / kBlockRows];
  const std::size_t k = index % kBlockRows;
  if (k >= block.rows.size())
    return {};
  const std::size_t begin = k == 0 ? 0 : block.rows[k - 1].nonzeros;
  const RowEnd& end = block.rows[k];
  return {block.columns.span().subspan(begin, end.nonzeros - begin),
          block.values.span().subspan(begin, end.nonzeros - begin), end.scale, end.space,
          end.back_side};
}

void FormFactorMatrix::swap(FormFactorMatrix& other) noexcept {
  blocks_.swap(other.blocks_);
  std::swap(row_count_, other.row_count_);
  std::swap(column_count_, other.column_count_);
}

Status FormFactorMatrix::reserve_block(std::size_t index, std::size_t nonzeros) noexcept {
  HC_TRY(blocks_[index].columns.reserve(nonzeros));
  return blocks_[index].values.reserve(nonzeros);
}

std::span<float> FormFactorMatrix::values(std::uint64_t index) noexcept {
  const std::span<const float> values = row(index).values;
  return {const_cast<float*>(values.data()), values.size()};
}

void FormFactorMatrix::set_shares(std::uint64_t index, double scale, double space,
                                  double back_side) noexcept {
  Block& block = blocks_[index / kBlockRows];
  const std::size_t k = index % kBlockRows;
  HC_ASSERT(k < block.rows.size());
  block.rows[k] = {block.rows[k].nonzeros, scale, space, back_side};
}

Status FormFactorMatrix::append_row(std::size_t index, const RowView& row) noexcept {
  Block& block = blocks_[index];
  HC_ASSERT(block.rows.size() < kBlockRows);
  HC_TRY(block.columns.append(row.columns));
  HC_TRY(block.values.append(row.values));
  HC_TRY(block.rows.push_back({block.columns.size(), row.scale, row.space, row.back_side}));
  if (block_begin(index) + block.rows.size() < block_end(index))
    return {};
  HC_TRY(block.columns.shrink_to_fit()); // the block is complete
  return block.values.shrink_to_fit();
}

} // namespace hemicube::radiosity
