#pragma once

#include "radiosity/form_factor/matrix.h"

#include <cstdint>

namespace hemicube::radiosity {

/// What two patches exchange: A_i F_ij = A_j F_ji, the same number for both rows.
struct PairExchange {
  std::uint32_t patch = 0;   ///< the other one
  float error = 0;           ///< estimated, in units of value
  float doubt = 0;           ///< what it might be wrong by, for the choice of rows to look at again
  bool is_estimated = false; ///< partly hidden: closure may scale it
  bool is_mutual = true;     ///< the same for both rows, which share it
  double value = 0;          ///< m^2; of a point, the form factor itself
};

/// What a receiver was found to exchange, its row before closure.
struct ReceiverExchange {
  std::span<const PairExchange> pairs;
  double area = 1;      ///< of the receiver, m^2; 1 for points
  double back_side = 0; ///< exchanged with back sides, m^2
  double back_side_error = 0;
  bool is_rendered = false; ///< an item buffer says what is space and what back side
  double space = 0;         ///< then; m^2
};

/// Pairs of patches that say the same for both rows, each once, and what is a row's own. In blocks
/// of consecutive rows, one writer a block.
class ExchangeTable {
public:
  static constexpr std::uint32_t kBlockRows = FormFactorMatrix::kBlockRows;

  Status init(std::uint32_t row_count) noexcept;
  bool empty() const noexcept { return blocks_.size() == 0; }

  /// Appends the next row of a block; rows come in ascending order.
  Status append_row(std::size_t block, const ReceiverExchange& row) noexcept;

  /// To be called when all rows are there, before `others`.
  Status transpose() noexcept;

  /// As it was appended.
  ReceiverExchange row(std::uint32_t index) const noexcept;
  /// The mutual pairs that other rows found with this one, by ascending row.
  std::span<const PairExchange> others(std::uint32_t index) const noexcept {
    return others_.span().subspan(other_offsets_[index],
                                  other_offsets_[index + 1] - other_offsets_[index]);
  }

private:
  struct RowEnd {
    std::size_t pairs;         ///< of the block up to and including this row
    ReceiverExchange exchange; ///< but for the pairs
  };
  struct Block {
    Buffer<PairExchange> pairs;
    Buffer<RowEnd> rows;
  };

  std::uint32_t row_count_ = 0;
  FixedArray<Block> blocks_;
  Buffer<std::size_t> other_offsets_;
  Buffer<PairExchange> others_;
};

} // namespace hemicube::radiosity
