#include "radiosity/cli/progress.h"

#include "radiosity/cli/interrupt.h"

#include <cstdio>
#include <exception>
#include <unistd.h>

namespace hemicube::radiosity::cli {
namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};
constexpr int kBarWidth = 30;

/// As in "1:02:03" or "0:07".
void print_duration(char* text, std::size_t size, double seconds) {
  const auto whole = static_cast<unsigned long long>(seconds < 1e9 ? seconds + 0.5 : 1e9);
  if (whole >= 3600)
    std::snprintf(text, size, "%llu:%02llu:%02llu", whole / 3600, whole / 60 % 60, whole % 60);
  else
    std::snprintf(text, size, "%llu:%02llu", whole / 60, whole % 60);
}

} // namespace

ProgressReport::ProgressReport(bool quiet)
    : style_(quiet                          ? Style::kSilent
             : ::isatty(STDERR_FILENO) == 1 ? Style::kBar
                                            : Style::kLines),
      last_call_(Clock::now()), last_shown_(last_call_) {}

bool ProgressReport::rows(std::uint64_t done, std::uint64_t total) noexcept {
  // The first call of a loop over rows ends what came before it.
  count_time();
  part_ = kRows;
  if (!interrupted() && done != 0 && is_time_to_show()) {
    const double seconds = time_[kRows].count();
    const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
    const double part = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1;
    char left[32], bar[kBarWidth + 4] = "", text[160];
    print_duration(left, sizeof left, rate > 0 ? static_cast<double>(total - done) / rate : 0);
    if (style_ == Style::kBar) {
      const int full = static_cast<int>(part * kBarWidth);
      bar[0] = '[';
      for (int i = 0; i < kBarWidth; ++i)
        bar[1 + i] = i < full ? '#' : '.';
      bar[kBarWidth + 1] = ']';
      bar[kBarWidth + 2] = ' ';
      bar[kBarWidth + 3] = '\0';
    }
    std::snprintf(text, sizeof text, "%s%3.0f %% of %llu hemicubes, %.0f/s, %s left", bar,
                  100 * part, static_cast<unsigned long long>(total), rate, left);
    show(text);
  }
  return !interrupted();
}

bool ProgressReport::balancing(std::uint64_t iterations, double closure_residual) noexcept {
  part_ = kBalance;
  count_time();
  if (!interrupted() && is_time_to_show()) {
    char text[160];
    std::snprintf(text, sizeof text, "balancing, iteration %llu, rows close to %.2g",
                  static_cast<unsigned long long>(iterations), closure_residual);
    show(text);
  }
  return !interrupted();
}

bool ProgressReport::sweeps(std::uint64_t sweeps, double error) noexcept {
  // Between the last row and the first sweep the solver gets ready.
  part_ = kSolve;
  count_time();
  if (!interrupted() && is_time_to_show()) {
    char text[160];
    std::snprintf(text, sizeof text, "sweep %llu, estimated error %.2g",
                  static_cast<unsigned long long>(sweeps), error);
    show(text);
  }
  return !interrupted();
}

bool ProgressReport::shots(std::uint64_t shots, double unshot) noexcept {
  part_ = kSolve;
  count_time();
  if (!interrupted() && is_time_to_show()) {
    char text[160];
    std::snprintf(text, sizeof text, "shot %llu, %.3g %% of the light unshot",
                  static_cast<unsigned long long>(shots), 100 * unshot);
    show(text);
  }
  return !interrupted();
}

Status ProgressReport::snapshot(std::uint64_t shots, const Solution& solution) noexcept {
  if (!take_snapshot_)
    return {};
  try {
    return take_snapshot_(shots, solution);
  } catch (const std::exception& exception) { // in practice: no memory for a text
    return Status::error(StatusCode::kOutOfMemory,
                         "a snapshot cannot be written: ", exception.what());
  }
}

void ProgressReport::finish() noexcept {
  if (bar_is_shown_)
    std::fputs("\r\033[K", stderr);
  bar_is_shown_ = false;
  style_ = Style::kSilent;
}

void ProgressReport::count_time() noexcept {
  const Clock::time_point now = Clock::now();
  time_[part_] += now - last_call_;
  last_call_ = now;
}

bool ProgressReport::is_time_to_show() noexcept {
  if (style_ == Style::kSilent)
    return false;
  const Clock::duration interval =
      style_ == Style::kBar ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval);
  if (last_call_ - last_shown_ < interval)
    return false;
  last_shown_ = last_call_;
  return true;
}

void ProgressReport::show(const char* text) noexcept {
  if (style_ == Style::kBar)
    std::fprintf(stderr, "\r%s\033[K", text);
  else
    std::fprintf(stderr, "hemicube: %s\n", text);
  bar_is_shown_ = style_ == Style::kBar;
  std::fflush(stderr);
}

} // namespace hemicube::radiosity::cli
