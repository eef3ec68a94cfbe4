#pragma once

#include "raster/status.h"

#include <cstddef>

namespace hemicube::radiosity {

/// Runs independent blocks of work. What a block computes must depend on its number alone, never on
/// the worker that runs it: that is what makes results independent of the number of threads.
class Executor {
public:
  /// One block. @param worker  0 .. worker_count()-1; blocks of one worker never overlap in time
  using Block = Status (*)(void* context, std::size_t block, std::size_t worker);

  virtual std::size_t worker_count() const noexcept = 0;

  /// Runs blocks 0 .. block_count-1, each once, in any order, and returns when all are done. After
  /// a failure no further blocks are started; the failure of the lowest failed block is returned.
  /// One call at a time: not from within a block, nor from two threads.
  virtual Status run(std::size_t block_count, Block block, void* context) noexcept = 0;

  /// The same for any callable Status(std::size_t block, std::size_t worker).
  template <typename Function>
  Status for_each(std::size_t block_count, Function&& function) noexcept {
    using Callable = std::remove_reference_t<Function>;
    return run(
        block_count,
        [](void* context, std::size_t block, std::size_t worker) -> Status {
          return (*static_cast<Callable*>(context))(block, worker);
        },
        const_cast<void*>(static_cast<const void*>(&function)));
  }

protected:
  ~Executor() = default;
};

/// All blocks in order on the calling thread.
class SerialExecutor final : public Executor {
public:
  std::size_t worker_count() const noexcept override { return 1; }
  Status run(std::size_t block_count, Block block, void* context) noexcept override {
    for (std::size_t i = 0; i < block_count; ++i)
      HC_TRY(block(context, i, 0));
    return {};
  }
};

} // namespace hemicube::radiosity
