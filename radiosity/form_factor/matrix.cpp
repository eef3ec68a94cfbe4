#include "radiosity/form_factor/matrix.h"

#include "raster/hash.h"

#include <bit>

namespace hemicube::radiosity {
namespace {

template <typename Term> double interleaved_sum(std::size_t first, std::size_t last, Term term) {
  double sums[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  std::size_t k = first;
  for (; k + 8 <= last; k += 8)
    for (std::size_t lane = 0; lane < 8; ++lane)
      sums[lane] += term(k + lane);
  for (std::size_t lane = 0; k < last; ++k, ++lane)
    sums[lane] += term(k);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

} // namespace

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
