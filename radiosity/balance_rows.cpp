#include "radiosity/balance_rows.h"

#include "radiosity/form_factor/balance.h"
#include "radiosity/form_factor/reciprocity.h"
#include "raster/fp_environment.h"

namespace hemicube::radiosity {
namespace {

/// Passes iterations on to the caller's Progress.
class BalanceToProgress final : public BalanceProgress {
public:
  explicit BalanceToProgress(Progress* progress) : progress_(progress) {}
  bool iterated(std::uint64_t iterations, double closure_residual) noexcept override {
    return progress_ == nullptr || progress_->balancing(iterations, closure_residual);
  }

private:
  Progress* progress_;
};

} // namespace

Status balance_rows(const PatchSet& patches, Executor& executor, Progress* progress,
                    FormFactorMatrix* matrix, RowStatistics* statistics, Certificate* certificate) {
  Certificate& c = *certificate;
  if (!matrix->is_in_memory())
    return Status::error(StatusCode::kOutOfMemory, "balancing needs all form factors in memory, ",
                         2 * matrix->byte_count(),
                         " bytes for them twice over: allow more with "
                         "--memory, or do not balance");
  const std::span<const double> area = patches.area.span();
  BalanceToProgress iterations(progress);
  const auto report = [&]() {
    return iterations.iterated(c.balance.iterations, c.balance.closure_residual)
               ? Status()
               : Status::error(StatusCode::kCancelled, "interrupted while balancing");
  };
  HC_TRY(report());
  HC_TRY(measure_reciprocity(*matrix, area, executor, &c.reciprocity_raw));
  HC_TRY(balance(matrix, area, executor, &iterations, &c.balance));
  HC_TRY(executor.for_each(matrix->block_count(), [&](std::size_t block, std::size_t) {
    const FloatEnvironment environment;
    for (std::uint64_t i = matrix->block_begin(block); i < matrix->block_end(block); ++i)
      statistics->replace(i, matrix->row(i));
    return Status();
  }));
  c.balanced = true;
  return report();
}

} // namespace hemicube::radiosity
