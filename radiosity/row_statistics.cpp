#include "radiosity/row_statistics.h"

#include "raster/hash.h"

#include <limits>

namespace hemicube::radiosity {
namespace {

void extend(double value, bool first, Range* range) {
  range->mean += value;
  if (first || value < range->min)
    range->min = value;
  if (first || value > range->max)
    range->max = value;
}
void extend(double value, std::uint64_t index, bool first, WorstFraction* worst) {
  worst->mean += value;
  if (first || value > worst->max) {
    worst->max = value;
    worst->worst_patch = static_cast<std::uint32_t>(index);
  }
  if (!(value > WorstFraction::kRounding))
    return;
  std::size_t place = worst->listed().size();
  ++worst->count;
  if (place == WorstFraction::kListed) {
    if (!(value > worst->worst[--place].fraction))
      return;
  }
  for (; place > 0 && worst->worst[place - 1].fraction < value; --place)
    worst->worst[place] = worst->worst[place - 1];
  worst->worst[place] = {static_cast<std::uint32_t>(index), value};
}

} // namespace

Status RowStatistics::init(std::uint64_t rows, bool hash_items) {
  hash_items_ = hash_items;
  rows_.clear();
  return rows_.resize(rows, {std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, {}, 0});
}

void RowStatistics::record(std::uint64_t index, const RowView& row, const RowFacts& facts) {
  rows_[index] = {row_sum(row), row.space, row.back_side, hash_row(row), facts, row.columns.size()};
}

Status RowStatistics::record_rows(const FormFactorMatrix& matrix, std::uint64_t count) {
  constexpr std::uint64_t kRows = FormFactorMatrix::kBlockRows;
  return matrix.for_each_range(
      0, (count + kRows - 1) / kRows, [&](std::size_t first, std::size_t last) {
        for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i)
          if (const RowView row = matrix.row(i); is_computed(row))
            record(i, row, matrix.facts(i));
        return Status();
      });
}

void RowStatistics::replace(std::uint64_t index, const RowView& row) {
  record(index, row, RowFacts(rows_[index].facts));
}

void RowStatistics::summarise(Certificate* certificate) const {
  Hash rows_hash, items_hash;
  Certificate& c = *certificate;
  std::uint64_t seen = 0;
  for (std::uint64_t i = 0; i < rows_.size(); ++i) {
    const Entry& row = rows_[i];
    if (row.sum != row.sum)
      continue;
    const bool first = seen++ == 0;
    rows_hash.add(row.hash);
    items_hash.add(row.facts.item_hash);
    c.nonzeros += row.nonzeros;
    c.hemicubes += row.facts.hemicubes;
    c.subpixel_patches += row.facts.subpixel_patches;
    extend(row.facts.raw_sum, first, &c.row_sum_raw);
    extend(row.sum, first, &c.row_sum);
    extend(row.space, i, first, &c.space);
    extend(row.back_side, i, first, &c.back_side);
  }
  if (seen != 0)
    for (double* mean : {&c.row_sum_raw.mean, &c.row_sum.mean, &c.space.mean, &c.back_side.mean})
      *mean /= static_cast<double>(seen);
  c.form_factor_hash = rows_hash.value();
  c.has_item_hash = hash_items_;
  c.item_hash = hash_items_ ? items_hash.value() : 0;
}

} // namespace hemicube::radiosity
