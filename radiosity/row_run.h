#pragma once

#include "radiosity/form_factor/ladder_row.h"
#include "radiosity/radiosity.h"
#include "raster/fp_environment.h"

#include <atomic>
#include <mutex>

namespace hemicube::radiosity {

/// Builds rows of one scene in parallel: each by one worker, in fixed blocks, so that neither the
/// rows nor their order in a block depends on the number of workers.
class RowRun {
public:
  /// @param total     rows that will be built in all, for `progress`
  /// @param progress  may be null
  Status init(const PatchSet& patches, const Options& options, std::uint64_t total,
              Executor& executor, Progress* progress);

  /// Calls take(index, row, facts) for the indices 0 .. count-1; those of one block of
  /// FormFactorMatrix::kBlockRows come in ascending order from one worker. Reports progress before
  /// the first row, after the last one, and in between.
  /// @param place_of  bool(index, RowPlace*); false if no row is wanted there: take then gets an
  ///                  empty row and null facts
  template <typename PlaceOf, typename Take>
  Status build(std::uint64_t count, PlaceOf place_of, Take take) {
    constexpr std::uint64_t kRows = FormFactorMatrix::kBlockRows;
    const auto build_block = [&](std::size_t block, std::size_t worker) {
      const FloatEnvironment environment;
      LadderRow& builder = builders_[worker];
      if (!builder.ready())
        HC_TRY(builder.init(setup_));
      const std::uint64_t end = (block + 1) * kRows < count ? (block + 1) * kRows : count;
      for (std::uint64_t index = block * kRows; index < end; ++index) {
        RowPlace place;
        if (!place_of(index, &place)) {
          HC_TRY(take(index, RowView(), nullptr));
          continue;
        }
        RowView row;
        RowFacts facts;
        HC_TRY(builder.build(place, &row, &facts));
        HC_TRY(take(index, row, &facts));
        HC_TRY(count_row());
      }
      return Status();
    };
    HC_TRY(report());
    HC_TRY(executor_->for_each((count + kRows - 1) / kRows, build_block));
    return report();
  }

private:
  Status count_row();
  Status report();

  LadderSetup setup_;
  FixedArray<LadderRow> builders_;
  Executor* executor_ = nullptr;
  Progress* progress_ = nullptr;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
  std::mutex progress_mutex_;
};

} // namespace hemicube::radiosity
