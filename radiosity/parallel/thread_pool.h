#pragma once

#include "radiosity/parallel/executor.h"
#include "radiosity/parallel/mutex.h"
#include "raster/memory.h"

#include <atomic>
#include <cstdint>
#include <pthread.h>

namespace hemicube::radiosity {

/// The default executor: a fixed set of threads that claim blocks from one counter. The caller of
/// run() works too, so a pool of one thread starts none.
class ThreadPool final : public Executor {
public:
  ThreadPool() = default;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  /// @param threads  workers in all, the caller included; 0 = as many as the machine has cores
  /// @return kOutOfMemory if the system refuses a thread: the pool then works with those it has
  Status init(std::uint32_t threads);

  std::size_t worker_count() const noexcept override { return threads_.size() + 1; }
  Status run(std::size_t block_count, Block block, void* context) noexcept override;

private:
  static void* thread_main(void* worker);
  void work(std::size_t worker);

  struct Worker {
    ThreadPool* pool;
    std::size_t number;
    pthread_t thread;
  };
  Buffer<Worker*> threads_;

  Mutex mutex_;
  pthread_cond_t start_ = PTHREAD_COND_INITIALIZER, done_ = PTHREAD_COND_INITIALIZER;
  std::uint64_t generation_ = 0; ///< counts calls of run
  std::size_t busy_ = 0;         ///< threads that have not finished this generation
  bool stop_ = false;

  Block block_ = nullptr;
  void* context_ = nullptr;
  std::size_t block_count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::size_t failed_block_ = 0;
  Status failure_;
};

} // namespace hemicube::radiosity
