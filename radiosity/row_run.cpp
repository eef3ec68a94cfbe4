#include "radiosity/row_run.h"

namespace hemicube::radiosity {

Status RowRun::init(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                    std::uint64_t total, Executor& executor, Progress* progress,
                    std::span<const double> light) {
  HC_TRY(check_float_environment());
  executor_ = &executor;
  setup_.light = light;
  progress_ = progress;
  total_ = total;
  done_ = 0;
  pair_storage_ = {};
  pair_rows_kept_ = 0;
  HC_TRY(pairs_.init(0));
  const raster::Kernels& kernels =
      options.kernels != nullptr ? *options.kernels : raster::best_kernels();
  HC_TRY(setup_.init(geometry, setting, kernels, options.hash_items));
  return builders_.init(executor.worker_count());
}

Status RowRun::find_pairs(std::uint32_t patch_count) {
  constexpr std::uint32_t kRows = ExchangeTable::kBlockRows;
  HC_TRY(pairs_.init(patch_count, pair_storage_));
  std::uint64_t first = 0;
  if (pair_storage_.file != nullptr) {
    std::uint64_t rest = 0;
    HC_TRY(pairs_.adopt(pair_storage_.file->size(), &rest));
    HC_TRY(pair_storage_.file->truncate(rest));
    while (first < patch_count && pairs_.is_finished(first / kRows))
      first += kRows;
    first = first < patch_count ? first : patch_count;
    pair_rows_kept_ = first;
  }
  // Each patch finds its pairs, whether its row is wanted, or kept, or not.
  total_ = patch_count;
  done_ = first;
  const auto check_size = [&]() {
    const std::uint64_t size = pairs_.byte_count(), most = pair_storage_.most_bytes;
    // Rows found one by one would fit, but may differ: what two patches exchange is found once.
    return size <= most
               ? Status()
               : Status::error(StatusCode::kOutOfMemory,
                               "what pairs of patches exchange takes more ", "than the ", most,
                               " bytes it may, after ", done_.load(), " of ", patch_count,
                               " patches: allow more with --memory, or take rung ",
                               "hemicube or analytic, which need no pairs");
  };
  HC_TRY(check_size());
  const auto find = [&](std::uint64_t index, LadderRow& builder, RowView*, RowFacts* facts, bool*) {
    const auto patch = static_cast<std::uint32_t>(index);
    ReceiverExchange exchange;
    HC_TRY(builder.find_pairs(patch, &exchange, facts));
    HC_TRY(pairs_.append_row(patch / kRows, exchange, *facts));
    return check_size();
  };
  const Status status = for_each_row(
      first, patch_count, find,
      [](std::uint64_t, const RowView&, const RowFacts*) { return Status(); }, true);
  if (!status.ok()) {
    pairs_.flush_if_due();
    return status;
  }
  return pairs_.transpose();
}

Status RowRun::count_row() {
  ++done_;
  // A worker that finds another one reporting has better things to do than to wait.
  if (!progress_mutex_.try_lock())
    return {};
  const Status status = report();
  progress_mutex_.unlock();
  return status;
}

Status RowRun::report() {
  const std::uint64_t done = done_;
  if (progress_ == nullptr || progress_->rows(done, total_))
    return {};
  return Status::error(StatusCode::kCancelled, "interrupted after ", done, " of ", total_, " rows");
}

} // namespace hemicube::radiosity
