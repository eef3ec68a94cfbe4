#pragma once

#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// One row of form factors as it is stored: F_ij = scale * values[k] for j = columns[k].
struct RowView {
  std::span<const std::uint32_t> columns; ///< patches seen, ascending
  std::span<const float> values;          ///< > 0
  double scale = 1;     ///< chosen so that the row sums to its exact share 1 - space - back_side
  double space = 0;     ///< fraction of the hemisphere that sees space, 0..1
  double back_side = 0; ///< fraction that sees back sides, 0..1
};

/// sum_k F_ij * x[j * stride] for the entries first <= k < last of a row, in the one order every
/// part of the program uses: 8 interleaved partial sums folded by a fixed tree, then the scale.
double row_dot(const RowView& row, const double* x, std::size_t stride, std::size_t first,
               std::size_t last) noexcept;

inline double row_dot(const RowView& row, const double* x, std::size_t stride = 1) noexcept {
  return row_dot(row, x, stride, 0, row.columns.size());
}

/// True unless the row is one that was never computed: those have entries, or see space or back
/// sides.
inline bool is_computed(const RowView& row) noexcept {
  return !row.columns.empty() || row.space != 0 || row.back_side != 0;
}

/// The sum of a row's form factors.
double row_sum(const RowView& row) noexcept;

/// Sets the scale of a row so that it sums to `share`, and never to more: a row above 1 would make
/// light from nothing.
void fit_scale(double share, RowView* row) noexcept;

/// Hash of everything a row holds.
std::uint64_t hash_row(const RowView& row) noexcept;

/// Compressed rows, built in parallel in blocks of kBlockRows consecutive rows: one block, one
/// writer.
class FormFactorMatrix {
public:
  static constexpr std::uint32_t kBlockRows = 8;
  static constexpr std::uint32_t kRangeBlocks = 32;

  /// Forgets all rows and makes room for row_count rows over column_count patches.
  Status init(std::uint64_t row_count, std::uint32_t column_count) noexcept;

  std::uint64_t row_count() const noexcept { return row_count_; }
  std::uint32_t column_count() const noexcept { return column_count_; }
  std::size_t block_count() const noexcept { return blocks_.size(); }
  std::uint64_t block_begin(std::size_t block) const noexcept {
    return block * std::uint64_t{kBlockRows};
  }
  std::uint64_t block_end(std::size_t block) const noexcept {
    const std::uint64_t end = block_begin(block) + kBlockRows;
    return end < row_count_ ? end : row_count_;
  }
  std::uint64_t nonzero_count() const noexcept;

  /// A row; empty (all zero) until it was appended.
  RowView row(std::uint64_t index) const noexcept;

  /// Calls Status visit(first_block, last_block) for ranges of blocks first <= block < last that
  /// follow each other and cover all rows. While it runs, and only then, the rows of the range can
  /// be read: this is how whole matrices are walked, whether they are in memory or not. Ranges
  /// begin at multiples of kRangeBlocks. One walk at a time.
  template <typename Visit> Status for_each_range(Visit visit) const {
    return block_count() == 0 ? Status() : visit(std::size_t{0}, block_count());
  }

  /// Appends the next row of a block: its rows come in ascending order, from one writer at a time.
  Status append_row(std::size_t block, const RowView& row) noexcept;

  /// Makes room for all entries of a block in one go.
  Status reserve_block(std::size_t block, std::size_t nonzeros) noexcept;

  /// The values of a row, to be changed in place; empty until it was appended.
  std::span<float> values(std::uint64_t index) noexcept;
  /// Changes what is not an entry of a row that was appended.
  void set_shares(std::uint64_t index, double scale, double space, double back_side) noexcept;

  void swap(FormFactorMatrix& other) noexcept;

private:
  struct RowEnd {
    std::uint64_t nonzeros; ///< entries of the block up to and including this row
    double scale, space, back_side;
  };
  struct Block {
    Buffer<std::uint32_t> columns;
    Buffer<float> values;
    Buffer<RowEnd> rows;
  };

  FixedArray<Block> blocks_;
  std::uint64_t row_count_ = 0;
  std::uint32_t column_count_ = 0;
};

} // namespace hemicube::radiosity
