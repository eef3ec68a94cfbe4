#include "radiosity/form_factor/exchange_table.h"

namespace hemicube::radiosity {

Status ExchangeTable::init(std::uint32_t row_count) noexcept {
  row_count_ = row_count;
  others_.clear();
  other_offsets_.clear();
  return blocks_.init((row_count + kBlockRows - 1) / kBlockRows);
}

Status ExchangeTable::append_row(std::size_t index, const ReceiverExchange& row) noexcept {
  Block& block = blocks_[index];
  HC_TRY(block.pairs.append(row.pairs));
  RowEnd end{block.pairs.size(), row};
  end.exchange.pairs = {};
  return block.rows.push_back(end);
}

ReceiverExchange ExchangeTable::row(std::uint32_t index) const noexcept {
  const Block& block = blocks_[index / kBlockRows];
  const std::size_t k = index % kBlockRows;
  const std::size_t begin = k == 0 ? 0 : block.rows[k - 1].pairs;
  const RowEnd& end = block.rows[k];
  ReceiverExchange row = end.exchange;
  row.pairs = block.pairs.span().subspan(begin, end.pairs - begin);
  return row;
}

Status ExchangeTable::transpose() noexcept {
  HC_TRY(other_offsets_.resize(std::size_t{row_count_} + 1));
  for (const Block& block : blocks_)
    for (const PairExchange& pair : block.pairs)
      other_offsets_[pair.patch + 1] += pair.is_mutual ? 1 : 0;
  for (std::uint32_t i = 0; i < row_count_; ++i)
    other_offsets_[i + 1] += other_offsets_[i];
  HC_TRY(others_.resize(other_offsets_[row_count_]));
  Buffer<std::size_t> next;
  HC_TRY(next.assign(other_offsets_.span()));
  for (std::uint32_t i = 0; i < row_count_; ++i)
    for (PairExchange pair : row(i).pairs) {
      if (!pair.is_mutual)
        continue;
      const std::uint32_t other = pair.patch;
      pair.patch = i;
      others_[next[other]++] = pair;
    }
  return {};
}

} // namespace hemicube::radiosity
