#include "radiosity/c_api/caller_executor.h"

namespace hemicube::radiosity::c_api {
namespace {

template <typename... Parts> Status misuse(const Parts&... parts) noexcept {
  return Status::error(StatusCode::kInvalidArgument, "the executor ", parts...);
}

/// Takes a flag that threads share; std::atomic_ref is not in every C++ library yet.
/// @return false if it was taken
bool take(std::uint8_t* flag) noexcept {
  return __atomic_exchange_n(flag, std::uint8_t{1}, __ATOMIC_ACQ_REL) == 0;
}

} // namespace

Status CallerExecutor::init(const hc_executor& executor) noexcept {
  executor_ = executor;
  return is_busy_.resize(executor.worker_count);
}

Status CallerExecutor::run(std::size_t block_count, Block block, void* context) noexcept {
  is_begun_.clear();
  HC_TRY(is_begun_.resize(block_count));
  block_ = block;
  context_ = context;
  done_ = 0;
  failed_ = false;
  failure_ = Status();
  const int code = executor_.run(executor_.context, block_count, run_block, this);
  const MutexLock lock(mutex_);
  if (!failure_.ok())
    return failure_;
  if (code != 0)
    return misuse("failed with ", code);
  return done_ == block_count ? Status()
                              : misuse("ran ", done_.load(), " of ", block_count, " blocks");
}

int CallerExecutor::run_block(void* self, std::uint64_t block, std::uint32_t worker) {
  CallerExecutor& executor = *static_cast<CallerExecutor*>(self);
  if (executor.failed_)
    return 1;
  const Status status = executor.run_block(block, worker);
  if (status.ok())
    return 0;
  const MutexLock lock(executor.mutex_);
  if (executor.failure_.ok() || block < executor.failed_block_) {
    executor.failure_ = status;
    executor.failed_block_ = block;
  }
  executor.failed_ = true;
  return 1;
}

Status CallerExecutor::run_block(std::uint64_t block, std::uint32_t worker) noexcept {
  if (block >= is_begun_.size())
    return misuse("ran block ", block, " of ", is_begun_.size());
  if (worker >= is_busy_.size())
    return misuse("ran a block as worker ", worker, " of ", is_busy_.size());
  if (!take(&is_begun_[block]))
    return misuse("ran block ", block, " twice");
  if (!take(&is_busy_[worker]))
    return misuse("ran two blocks at once as worker ", worker);
  const Status status = block_(context_, block, worker);
  __atomic_store_n(&is_busy_[worker], std::uint8_t{0}, __ATOMIC_RELEASE);
  ++done_;
  return status;
}

} // namespace hemicube::radiosity::c_api
