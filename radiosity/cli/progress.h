#pragma once

#include "radiosity/radiosity.h"

#include <chrono>

namespace hemicube::radiosity::cli {

/// Tells how far a run is, on stderr: a bar with the time left on a terminal, else a line every few
/// seconds. It stops the run once the program was interrupted, and takes the time of its two parts.
class ProgressReport final : public Progress {
public:
  explicit ProgressReport(bool quiet);
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;
  ~ProgressReport() { finish(); }

  bool rows(std::uint64_t done, std::uint64_t total) noexcept override;
  bool sweeps(std::uint64_t sweeps, double error) noexcept override;

  /// Removes the bar. Call it before anything else is printed.
  void finish() noexcept;

  /// Time spent on rows of form factors and on sweeps, until finish().
  double row_seconds() const { return row_time_.count(); }
  double sweep_seconds() const { return sweep_time_.count(); }

private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  enum class Style { kSilent, kLines, kBar };

  void count_time(bool sweeping) noexcept;
  bool is_time_to_show() noexcept;
  void show(const char* text) noexcept;

  Style style_;
  Clock::time_point last_call_, last_shown_;
  bool sweeping_ = false; ///< what the time since the last call is spent on, for all we know
  bool bar_is_shown_ = false;
  Seconds row_time_{0}, sweep_time_{0};
};

} // namespace hemicube::radiosity::cli
