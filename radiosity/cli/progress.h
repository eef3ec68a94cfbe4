#pragma once

#include "radiosity/radiosity.h"

#include <chrono>
#include <functional>

namespace hemicube::radiosity::cli {

/// Tells how far a run is, on stderr: a bar with the time left on a terminal, else a line every few
/// seconds. It stops the run once the program was interrupted, and takes the time of its parts.
class ProgressReport final : public Progress {
public:
  /// What a run does: all that comes before the first row; rows; their balance; and what leads from
  /// rows to light.
  enum Part { kBuild, kRows, kBalance, kSolve };

  explicit ProgressReport(bool quiet);
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;
  ~ProgressReport() { finish(); }

  bool rows(std::uint64_t done, std::uint64_t total) noexcept override;
  bool balancing(std::uint64_t iterations, double closure_residual) noexcept override;
  bool sweeps(std::uint64_t sweeps, double error) noexcept override;
  bool shots(std::uint64_t shots, double unshot) noexcept override;
  Status snapshot(std::uint64_t shots, const Solution& solution) noexcept override;

  /// What to do with snapshots. May throw.
  using TakeSnapshot = std::function<Status(std::uint64_t shots, const Solution& solution)>;
  void set_snapshots(TakeSnapshot take) { take_snapshot_ = std::move(take); }

  /// Removes the bar. Call it before anything else is printed.
  void finish() noexcept;

  /// Time spent on a part, up to the last call.
  double seconds(Part part) const { return time_[part].count(); }

private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  enum class Style { kSilent, kLines, kBar };

  void count_time() noexcept;
  bool is_time_to_show() noexcept;
  void show(const char* text) noexcept;

  Style style_;
  Clock::time_point last_call_, last_shown_;
  bool bar_is_shown_ = false;
  Part part_ = kBuild; ///< what the time since the last call is spent on
  Seconds time_[4] = {};
  TakeSnapshot take_snapshot_;
};

} // namespace hemicube::radiosity::cli
