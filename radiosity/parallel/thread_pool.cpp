#if !defined(HC_NO_THREADS) // else there is no pool
#include "radiosity/parallel/thread_pool.h"

#include <unistd.h>

namespace hemicube::radiosity {
namespace {

std::uint32_t core_count() {
  const long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 0 ? static_cast<std::uint32_t>(count) : 1;
}

} // namespace

Status ThreadPool::init(std::uint32_t threads) {
  HC_ASSERT(threads_.empty());
  if (threads == 0)
    threads = core_count();
  for (std::size_t number = 1; number < threads; ++number) {
    auto* worker = static_cast<Worker*>(detail::allocate(sizeof(Worker)));
    if (worker == nullptr)
      return Status::error(StatusCode::kOutOfMemory, "out of memory: a pool of ", threads,
                           " threads");
    *worker = {this, number, {}};
    // The list grows first: a running thread must be known to the destructor.
    Status status = threads_.push_back(worker);
    if (!status.ok()) {
      detail::release(worker, sizeof(Worker));
      return status;
    }
    if (pthread_create(&worker->thread, nullptr, thread_main, worker) != 0) {
      detail::release(worker, sizeof(Worker));
      (void)threads_.resize(threads_.size() - 1);
      return Status::error(StatusCode::kOutOfMemory, "only ", threads_.size() + 1, " of ", threads,
                           " threads could be started: ask for fewer");
    }
  }
  return {};
}

ThreadPool::~ThreadPool() {
  {
    const MutexLock lock(mutex_);
    stop_ = true;
  }
  pthread_cond_broadcast(&start_);
  for (Worker* worker : threads_) {
    pthread_join(worker->thread, nullptr);
    detail::release(worker, sizeof(Worker));
  }
  pthread_cond_destroy(&start_);
  pthread_cond_destroy(&done_);
}

Status ThreadPool::run(std::size_t block_count, Block block, void* context) noexcept {
  {
    const MutexLock lock(mutex_);
    HC_ASSERT(block_ == nullptr);
    block_ = block;
    context_ = context;
    block_count_ = block_count;
    next_ = 0;
    failed_ = false;
    failure_ = Status();
    busy_ = threads_.size();
    ++generation_;
  }
  pthread_cond_broadcast(&start_);
  work(0);
  const MutexLock lock(mutex_);
  while (busy_ != 0)
    pthread_cond_wait(&done_, mutex_.native());
  block_ = nullptr;
  return failure_;
}

void ThreadPool::work(std::size_t worker) {
  while (!failed_) {
    const std::size_t index = next_.fetch_add(1);
    if (index >= block_count_)
      return;
    Status status = block_(context_, index, worker);
    if (status.ok())
      continue;
    // Blocks are claimed in order, so every block before a failed one has been claimed too and will
    // still report: the lowest failure is the same for any number of threads.
    const MutexLock lock(mutex_);
    if (failure_.ok() || index < failed_block_) {
      failure_ = status;
      failed_block_ = index;
    }
    failed_ = true;
  }
}

void* ThreadPool::thread_main(void* argument) {
  const auto* worker = static_cast<const Worker*>(argument);
  ThreadPool& pool = *worker->pool;
  std::uint64_t seen = 0;
  const MutexLock lock(pool.mutex_);
  while (true) {
    while (!pool.stop_ && pool.generation_ == seen)
      pthread_cond_wait(&pool.start_, pool.mutex_.native());
    if (pool.stop_)
      return nullptr;
    seen = pool.generation_;
    pool.mutex_.unlock();
    pool.work(worker->number);
    pool.mutex_.lock();
    if (--pool.busy_ == 0)
      pthread_cond_signal(&pool.done_);
  }
}

} // namespace hemicube::radiosity
#endif
