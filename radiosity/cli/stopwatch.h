#pragma once

#include <chrono>

namespace hemicube::radiosity::cli {

/// Wall-clock time between calls.
class Stopwatch {
public:
  /// Seconds since the last call, or since construction.
  double lap() {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> seconds = now - last_;
    last_ = now;
    return seconds.count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

} // namespace hemicube::radiosity::cli
