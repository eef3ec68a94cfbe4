#include "bench/peers/hemicube_peer.h"

#include "radiosity/parallel/thread_pool.h"
#include "radiosity/radiosity.h"
#include "raster/hash.h"
#include "tests/support/scenes_shared.h"

#include <chrono>

namespace hemicube::bench {
namespace {

using test::require;

/// Measures a part of a run, from `first` finished rows to the end.
class RowClock final : public radiosity::Progress {
public:
  explicit RowClock(std::uint64_t first) : first_(first) {}

  bool rows(std::uint64_t done, std::uint64_t total) noexcept override {
    if (done <= first_)
      start_ = std::chrono::steady_clock::now();
    if (done == total)
      end_ = std::chrono::steady_clock::now();
    return true;
  }
  bool sweeps(std::uint64_t, double) noexcept override { return true; }

  double seconds() const { return std::chrono::duration<double>(end_ - start_).count(); }

private:
  std::uint64_t first_;
  std::chrono::steady_clock::time_point start_, end_;
};

class HemicubePeer : public Peer {
public:
  explicit HemicubePeer(std::uint32_t threads) : threads_(threads) {
    if (threads > 1)
      require(pool_.init(threads));
  }

  std::string name() const override {
    return threads_ == 1 ? "hemicube" : "hemicube " + std::to_string(threads_);
  }

  void prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) override {
    patches_ = &patches;
    options_.resolution = resolution;
  }

  /// Builds the tree, too: that is left out of seconds(), and on one thread a first row besides,
  /// which makes the worker allocate its buffers.
  void rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
            std::uint64_t* hash) override {
    const std::uint64_t skipped = threads_ == 1 ? 1 : 0;
    std::vector<std::uint32_t> all(skipped, receivers.back());
    all.insert(all.end(), receivers.begin(), receivers.end());
    radiosity::SerialExecutor serial;
    radiosity::Executor& executor =
        threads_ == 1 ? static_cast<radiosity::Executor&>(serial) : pool_;
    RowClock clock(skipped);
    radiosity::FormFactorMatrix matrix;
    radiosity::Certificate certificate;
    require(radiosity::compute_form_factors(*patches_, all, options_, executor, &clock, &matrix,
                                            &certificate));
    seconds_ = clock.seconds();
    if (dense != nullptr)
      dense->assign(receivers.size() * patches_->patch_count(), 0);
    Hash rows_hash; // as RunReader hashes
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      const radiosity::RowView row = matrix.row(skipped + k);
      for (std::size_t e = 0; e < row.columns.size(); ++e) {
        rows_hash.add(row.columns[e]);
        rows_hash.add(row.values[e]);
        if (dense != nullptr)
          (*dense)[k * patches_->patch_count() + row.columns[e]] =
              row.scale * static_cast<double>(row.values[e]);
      }
    }
    *hash = rows_hash.value();
  }

  double seconds() const override { return seconds_; }

private:
  std::uint32_t threads_;
  radiosity::ThreadPool pool_;
  radiosity::Options options_;
  const radiosity::PatchSet* patches_ = nullptr;
  double seconds_ = 0;
};

} // namespace

std::unique_ptr<Peer> make_hemicube_peer(std::uint32_t threads) {
  return std::make_unique<HemicubePeer>(threads);
}

} // namespace hemicube::bench
