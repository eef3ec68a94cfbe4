#pragma once

#include "radiosity/form_factor/row_store.h"

#include <atomic>
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

/// How a row came about.
struct RowFacts {
  std::uint32_t hemicubes = 0;
  std::uint32_t subpixel_patches = 0; ///< seen without a pixel of their own
  double raw_sum = 0;                 ///< of the row, before closure
  double error = 0; ///< estimated: root of the sum of the squared errors of the entries
  double doubt =
      0; ///< what light may be wrong by because of the row, in units of LadderSetup::light
  std::uint64_t work = 0; ///< what it took without hemicubes, roughly nanoseconds; not a
                          ///< measurement: the same everywhere
  std::uint64_t item_hash = 0;
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
/// light from nothing. Where space and back side leave nothing, or less by rounding, entries are
/// below the rounding of 1 and are left out.
void fit_scale(double share, RowView* row) noexcept;

/// Hash of everything a row holds.
std::uint64_t hash_row(const RowView& row) noexcept;

/// Compressed rows, built in parallel in blocks of kBlockRows consecutive rows: one block, one
/// writer. Kept as RowStorage says (row_store.h).
class FormFactorMatrix {
public:
  static constexpr std::uint32_t kBlockRows = RowStore::kBlockRows;
  static constexpr std::size_t kRangeBlocks = RowStore::kRangeBlocks;

  /// Forgets all rows and makes room for row_count rows over column_count patches.
  Status init(std::uint64_t row_count, std::uint32_t column_count,
              const RowStorage& storage = {}) noexcept;

  /// Takes the rows that are in the storage's file, as far as they are sound.
  /// @param end, rest  as RowStore::adopt
  Status adopt(std::uint64_t end, std::uint64_t* rest) noexcept;

  std::uint64_t row_count() const noexcept { return rows_.row_count(); }
  std::uint32_t column_count() const noexcept { return column_count_; }
  std::size_t block_count() const noexcept { return rows_.block_count(); }
  std::uint64_t block_begin(std::size_t block) const noexcept {
    return block * std::uint64_t{kBlockRows};
  }
  std::uint64_t block_end(std::size_t block) const noexcept {
    const std::uint64_t end = block_begin(block) + kBlockRows;
    return end < row_count() ? end : row_count();
  }
  std::uint64_t nonzero_count() const noexcept { return nonzeros_; }
  std::uint64_t byte_count() const noexcept { return rows_.byte_count(); }
  bool is_in_memory() const noexcept { return rows_.is_in_memory(); }
  const RowStorage& storage() const noexcept { return rows_.storage(); }
  /// True once all rows of a block are there.
  bool is_finished(std::size_t block) const noexcept { return rows_.is_finished(block); }

  /// A row; empty (all zero) until it was appended. Where the matrix may be in a file: only of the
  /// range that is being walked.
  RowView row(std::uint64_t index) const noexcept { return view(rows_.row(index)); }
  RowFacts facts(std::uint64_t index) const noexcept;

  /// Any row, whether it is in memory or not. @param scratch  what it is read into if it is not
  Status read_row(std::uint64_t index, Buffer<std::byte>* scratch, RowView* row) const noexcept;

  /// Calls Status visit(first_block, last_block) for ranges of blocks first <= block < last that
  /// follow each other and cover all rows. While it runs, and only then, the rows of the range can
  /// be read: this is how whole matrices are walked, whether they are in memory or not. Ranges
  /// begin at multiples of kRangeBlocks. One walk at a time.
  template <typename Visit> Status for_each_range(Visit visit) const {
    return rows_.for_each_range(0, block_count(), visit);
  }
  /// The same of some blocks.
  template <typename Visit>
  Status for_each_range(std::size_t first_block, std::size_t last_block, Visit visit) const {
    return rows_.for_each_range(first_block, last_block, visit);
  }

  /// Appends the next row of a block: its rows come in ascending order, from one writer at a time.
  Status append_row(std::size_t block, const RowView& row, const RowFacts& facts = {}) noexcept;

  /// Makes room for all entries of a block in one go.
  Status reserve_block(std::size_t block, std::size_t nonzeros) noexcept;

  /// Brings all finished blocks that follow each other from the first on to the file.
  Status flush() noexcept { return rows_.flush(); }
  void flush_if_due() noexcept { rows_.flush_if_due(); }

  /// The values of a row, to be changed in place; empty until it was appended. The matrix must be
  /// in memory.
  std::span<float> values(std::uint64_t index) noexcept;
  /// Changes what is not an entry of a row that was appended. The matrix must be in memory.
  void set_shares(std::uint64_t index, double scale, double space, double back_side) noexcept;

  void swap(FormFactorMatrix& other) noexcept;

  /// Makes this a matrix in memory of some rows of another: row k is that of number rows[k].
  Status copy_rows(const FormFactorMatrix& from, std::span<const std::uint32_t> rows) noexcept;

private:
  /// What a row begins with in memory and in a file; its columns and then its values follow.
  struct RowHead {
    std::uint64_t nonzeros;
    double scale, space, back_side;
    RowFacts facts;
  };
  static_assert(sizeof(RowFacts) == 48 && sizeof(RowHead) == 80, "files hold them as they are");

  static RowView view(std::span<const std::byte> bytes) noexcept;
  bool is_sound(std::span<const std::byte> bytes) const noexcept;

  RowStore rows_;
  std::atomic<std::uint64_t> nonzeros_{0};
  std::uint32_t column_count_ = 0;
};

} // namespace hemicube::radiosity
