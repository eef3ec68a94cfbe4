#pragma once

#include "radiosity/form_factor/matrix.h"

#include <cstdint>

namespace hemicube::radiosity {

/// What two patches exchange: A_i F_ij = A_j F_ji, the same number for both rows.
struct PairExchange {
  std::uint32_t patch = 0; ///< the other one
  float error = 0;         ///< estimated, in units of value
  float doubt = 0;         ///< what it might be wrong by, for the choice of rows to look at again
  std::uint32_t flags = kMutual;
  double value = 0; ///< m^2; of a point, the form factor itself

  static constexpr std::uint32_t kEstimated = 1, kMutual = 2;
  /// Partly hidden: closure may scale it.
  bool is_estimated() const noexcept { return (flags & kEstimated) != 0; }
  /// The same for both rows, which share it.
  bool is_mutual() const noexcept { return (flags & kMutual) != 0; }
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
  static constexpr std::uint32_t kBlockRows = RowStore::kBlockRows;

  /// @param storage  its file keeps the rows too; they must find room in memory all the same
  Status init(std::uint32_t row_count, const RowStorage& storage = {}) noexcept;
  bool empty() const noexcept { return rows_.block_count() == 0; }

  /// Takes the rows that are in the storage's file, as far as they are sound.
  /// @param end, rest  as RowStore::adopt
  Status adopt(std::uint64_t end, std::uint64_t* rest) noexcept;
  bool is_finished(std::size_t block) const noexcept { return rows_.is_finished(block); }

  /// Appends the next row of a block; rows come in ascending order.
  Status append_row(std::size_t block, const ReceiverExchange& row, const RowFacts& facts) noexcept;

  void flush_if_due() noexcept { rows_.flush_if_due(); }

  /// What the rows that are there and their transpose take in memory, at most.
  std::uint64_t byte_count() const noexcept { return 2 * rows_.byte_count(); }

  /// To be called when all rows are there, before `others`.
  Status transpose() noexcept;

  /// As it was appended.
  ReceiverExchange row(std::uint32_t index) const noexcept;
  RowFacts facts(std::uint32_t index) const noexcept;
  /// The mutual pairs that other rows found with this one, by ascending row.
  std::span<const PairExchange> others(std::uint32_t index) const noexcept {
    return others_.span().subspan(other_offsets_[index],
                                  other_offsets_[index + 1] - other_offsets_[index]);
  }

private:
  RowStore rows_;
  Buffer<std::size_t> other_offsets_;
  Buffer<PairExchange> others_;
};

} // namespace hemicube::radiosity
