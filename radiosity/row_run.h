#pragma once

#include "radiosity/form_factor/ladder_row.h"
#include "radiosity/parallel/mutex.h"
#include "radiosity/radiosity.h"
#include "raster/fp_environment.h"

#include <atomic>

namespace hemicube::radiosity {

/// Builds rows of one scene in parallel: each by one worker, in fixed blocks, so that neither the
/// rows nor their order in a block depends on the number of workers.
class RowRun {
public:
  /// @param total     rows that will be built in all, for `progress`
  /// @param progress  may be null
  /// @param geometry  outlives this
  /// @param light     see LadderSetup; outlives this
  Status init(RowGeometry* geometry, const RungSetting& setting, const Options& options,
              std::uint64_t total, Executor& executor, Progress* progress,
              std::span<const double> light = {});

  /// Keeps the pairs that build_all finds in a file, and begins with those that are there.
  /// @param storage  its most_bytes is what they may take: build_all ends with kOutOfMemory where
  ///                 they need more
  void keep_pairs(const RowStorage& storage) { pair_storage_ = storage; }
  /// How many rows found their pairs in the file.
  std::uint64_t pair_rows_kept() const { return pair_rows_kept_; }

  /// Counts rows as done that are not built.
  void count_kept(std::uint64_t rows) {
    if (pairs_.empty()) // else all rows count as done once their pairs are found
      done_ += rows;
  }

  /// Calls take(index, row, facts) for the indices 0 .. count-1; those of one block of
  /// FormFactorMatrix::kBlockRows come in ascending order from one worker. Reports progress before
  /// the first row, after the last one, and in between.
  /// @param first     the index to begin with, a multiple of FormFactorMatrix::kBlockRows, or count
  /// @param place_of  bool(index, RowPlace*); false if no row is wanted there: take then gets an
  ///                  empty row and null facts
  template <typename PlaceOf, typename Take>
  Status build(std::uint64_t count, PlaceOf place_of, Take take, std::uint64_t first = 0) {
    const auto build_row = [&](std::uint64_t index, LadderRow& builder, RowView* row,
                               RowFacts* facts, bool* is_wanted) {
      RowPlace place;
      *is_wanted = place_of(index, &place);
      return *is_wanted ? builder.build(place, row, facts) : Status();
    };
    return for_each_row(first, count, build_row, take, true);
  }

  /// The same for all patches, each its own row: finds each pair of patches once on rungs where
  /// both rows say the same of it.
  /// @param is_wanted  bool(patch)
  template <typename IsWanted, typename Take>
  Status build_all(std::uint32_t patch_count, IsWanted is_wanted, Take take,
                   std::uint64_t first = 0) {
    if (setup_.shares_pairs() && pairs_.empty() && first < patch_count)
      HC_TRY(find_pairs(patch_count));
    if (pairs_.empty())
      return build(
          patch_count,
          [&](std::uint64_t index, RowPlace* place) {
            place->patch = static_cast<std::uint32_t>(index);
            return is_wanted(place->patch);
          },
          take, first);
    const auto assemble_row = [&](std::uint64_t index, LadderRow& builder, RowView* row,
                                  RowFacts* facts, bool* wanted) {
      const auto patch = static_cast<std::uint32_t>(index);
      *wanted = is_wanted(patch);
      *facts = pairs_.facts(patch);
      return *wanted ? builder.assemble(pairs_.row(patch), pairs_.others(patch), row, facts)
                     : Status();
    };
    return for_each_row(first, patch_count, assemble_row, take, false);
  }

private:
  template <typename MakeRow, typename Take>
  Status for_each_row(std::uint64_t first, std::uint64_t count, MakeRow make_row, Take take,
                      bool counts) {
    constexpr std::uint64_t kRows = FormFactorMatrix::kBlockRows;
    const std::uint64_t first_block = (first + kRows - 1) / kRows; // first may be count
    const auto build_block = [&](std::size_t index, std::size_t worker) {
      const std::uint64_t block = first_block + index;
      const FloatEnvironment environment;
      LadderRow& builder = builders_[worker];
      if (!builder.ready())
        HC_TRY(builder.init(setup_));
      const std::uint64_t end = (block + 1) * kRows < count ? (block + 1) * kRows : count;
      for (std::uint64_t i = block * kRows; i < end; ++i) {
        RowView row;
        RowFacts facts;
        bool is_wanted = true;
        HC_TRY(make_row(i, builder, &row, &facts, &is_wanted));
        HC_TRY(take(i, row, is_wanted ? &facts : nullptr));
        if (is_wanted && counts)
          HC_TRY(count_row());
      }
      return Status();
    };
    HC_TRY(report());
    HC_TRY(executor_->for_each((count + kRows - 1) / kRows - first_block, build_block));
    return report();
  }

  Status find_pairs(std::uint32_t patch_count);
  Status count_row();
  Status report();

  LadderSetup setup_;
  FixedArray<LadderRow> builders_;
  RowStorage pair_storage_;
  ExchangeTable pairs_; ///< once they were found
  std::uint64_t pair_rows_kept_ = 0;
  Executor* executor_ = nullptr;
  Progress* progress_ = nullptr;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
  Mutex progress_mutex_;
};

} // namespace hemicube::radiosity
