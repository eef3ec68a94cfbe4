#pragma once

#include "radiosity/c_api/hemicube.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/parallel/mutex.h"
#include "raster/memory.h"

#include <atomic>
#include <cstdint>

namespace hemicube::radiosity::c_api {

/// The workers of a hc_executor. They are the caller's, so what they do is checked: a block runs
/// once, on a worker that is free, or not at all.
class CallerExecutor final : public Executor {
public:
  Status init(const hc_executor& executor) noexcept;

  std::size_t worker_count() const noexcept override { return executor_.worker_count; }
  Status run(std::size_t block_count, Block block, void* context) noexcept override;

private:
  static int run_block(void* self, std::uint64_t block, std::uint32_t worker);
  Status run_block(std::uint64_t block, std::uint32_t worker) noexcept;

  hc_executor executor_ = {};
  Block block_ = nullptr;
  void* context_ = nullptr;
  Buffer<std::uint8_t> is_begun_; ///< [block]
  Buffer<std::uint8_t> is_busy_;  ///< [worker]
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> failed_{false};
  Mutex mutex_; ///< of what follows
  std::uint64_t failed_block_ = 0;
  Status failure_;
};

} // namespace hemicube::radiosity::c_api
