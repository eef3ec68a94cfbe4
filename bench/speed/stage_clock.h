#pragma once

#include "radiosity/radiosity.h"

#include <ctime>

namespace hemicube::bench {

/// Splits a run on the calling thread into form factors and the rest, and stops it when it takes
/// too long. Counts the time the processor spent on this thread: what others do on the machine
/// counts less than on a wall clock.
class StageClock final : public radiosity::Progress {
public:
  /// @param limit  seconds after which rows are no longer waited for: the run ends with kCancelled
  explicit StageClock(double limit) : limit_(limit), start_(now()) {}

  bool rows(std::uint64_t, std::uint64_t) noexcept override {
    const double time = now();
    if (sweeping_) { // rows of black patches, after the sweeps
      sweeping_ = false;
      late_rows_start_ = time;
    }
    last_row_ = time;
    return time - start_ <= limit_;
  }
  bool sweeps(std::uint64_t, double) noexcept override {
    if (!sweeping_)
      first_rows_end_ = now();
    sweeping_ = true;
    return true;
  }

  /// Since this was made.
  double seconds() const { return now() - start_; }
  /// Of that, all up to the first sweep, and rows after the last; of a run with sweeps.
  double form_factor_seconds() const {
    const double late = late_rows_start_ > 0 ? last_row_ - late_rows_start_ : 0;
    return first_rows_end_ - start_ + late;
  }

private:
  static double now() noexcept {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double limit_, start_, first_rows_end_ = 0, late_rows_start_ = 0, last_row_ = 0;
  bool sweeping_ = false;
};

} // namespace hemicube::bench
