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
  HC_TRY(pairs_.init(0));
  const raster::Kernels& kernels =
      options.kernels != nullptr ? *options.kernels : raster::best_kernels();
  HC_TRY(setup_.init(geometry, setting, kernels, options.hash_items));
  return builders_.init(executor.worker_count());
}

Status RowRun::find_pairs(std::uint32_t patch_count) {
  HC_TRY(pairs_.init(patch_count));
  pair_facts_.clear();
  HC_TRY(pair_facts_.resize(patch_count));
  const auto find = [&](std::uint64_t index, LadderRow& builder, RowView*, RowFacts* facts, bool*) {
    const auto patch = static_cast<std::uint32_t>(index);
    ReceiverExchange exchange;
    HC_TRY(builder.find_pairs(patch, &exchange, facts));
    pair_facts_[patch] = *facts;
    return pairs_.append_row(patch / ExchangeTable::kBlockRows, exchange);
  };
  HC_TRY(for_each_row(
      patch_count, find, [](std::uint64_t, const RowView&, const RowFacts*) { return Status(); },
      true));
  return pairs_.transpose();
}

Status RowRun::count_row() {
  ++done_;
  // A worker that finds another one reporting has better things to do than to wait.
  const std::unique_lock lock(progress_mutex_, std::try_to_lock);
  return lock.owns_lock() ? report() : Status();
}

Status RowRun::report() {
  const std::uint64_t done = done_;
  if (progress_ == nullptr || progress_->rows(done, total_))
    return {};
  return Status::error(StatusCode::kCancelled, "interrupted after ", done, " of ", total_, " rows");
}

} // namespace hemicube::radiosity
