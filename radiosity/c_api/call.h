#pragma once

#include "radiosity/c_api/caller_executor.h"
#if !defined(HC_NO_THREADS)
#include "radiosity/parallel/thread_pool.h"
#endif
#include "radiosity/radiosity.h"

namespace hemicube::radiosity::c_api {

/// One computing call of the C interface: what its hc_options mean to the core.
class Call final : private Executor, private Progress {
public:
  /// @param options  may be null
  Status begin(const hc_options* options) noexcept;

  const Options& options() const noexcept { return options_; }
  Executor& executor() noexcept { return *this; }
  Progress* progress() noexcept { return this; }

private:
  Status set_options() noexcept;
  Status set_workers() noexcept;
  bool is_cancelled() const noexcept {
    return given_.is_cancelled != nullptr && given_.is_cancelled(given_.context) != 0;
  }
  bool tell(int stage, std::uint64_t done, std::uint64_t total, double error) const noexcept;

  // Asks before every block whether to go on, and leaves the rest to the workers.
  std::size_t worker_count() const noexcept override { return workers_->worker_count(); }
  Status run(std::size_t block_count, Block block, void* context) noexcept override;

  bool rows(std::uint64_t done, std::uint64_t total) noexcept override {
    return tell(HC_STAGE_ROWS, done, total, 0);
  }
  bool balancing(std::uint64_t iterations, double closure_residual) noexcept override {
    return tell(HC_STAGE_BALANCE, iterations, 0, closure_residual);
  }
  bool sweeps(std::uint64_t sweeps, double error) noexcept override {
    return tell(HC_STAGE_SWEEPS, sweeps, 0, error);
  }
  bool shots(std::uint64_t shots, double unshot) noexcept override {
    return tell(HC_STAGE_SHOTS, shots, 0, unshot);
  }

  hc_options given_ = {};
  Options options_;
  Executor* workers_ = nullptr; ///< one of the two below
#if defined(HC_NO_THREADS)
  SerialExecutor own_;
#else
  ThreadPool own_;
#endif
  CallerExecutor callers_;
};

} // namespace hemicube::radiosity::c_api
