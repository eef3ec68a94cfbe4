#pragma once

#include "radiosity/radiosity.h"
#include "tests/support/memory_file.h"
#include "tests/support/scenes_shared.h"

#include <string>
#include <vector>

/// Runs that keep their rows in files in memory, and are interrupted.
namespace hemicube::test {

/// The files of a run. They stay from one run to the next, as on a disk.
struct KeptRun {
  KeptRun();
  /// All that was written, without what the last run said of it.
  void forget_reports();

  MemoryFile rows{"rows"}, pairs{"pairs"}, black_rows{"black"};
  radiosity::RunFiles files;
};

/// Follows a run, and stops it after some rows.
class Watch final : public radiosity::Progress {
public:
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  struct Loop {
    std::uint64_t first, last, total; ///< rows done at its begin and end, rows in all
  };

  /// @param stop_after  so many rows are done, in the loop of number stop_loop
  explicit Watch(std::uint64_t stop_after = kNever, std::size_t stop_loop = 0)
      : stop_after_(stop_after), stop_loop_(stop_loop) {}

  bool rows(std::uint64_t done, std::uint64_t total) noexcept override;
  bool balancing(std::uint64_t iterations, double closure_residual) noexcept override;
  bool sweeps(std::uint64_t sweeps, double error) noexcept override;

  std::vector<Loop> loops; ///< over rows, with something else in between
  bool stops_in_sweeps = false, stops_in_balancing = false;
  bool has_overshot = false; ///< more rows done than there are

private:
  std::uint64_t stop_after_;
  std::size_t stop_loop_;
  bool is_in_loop_ = false;
};

/// All that a run yields, to the last bit, as text.
struct Outcome {
  Status status;
  std::string certificate;
  std::vector<std::string> values; ///< of a solution, line by line; of form factors, row by row
  std::uint64_t patches = 0, sweeps = 0;
  radiosity::RungSetting setting;

  bool operator==(const Outcome& other) const {
    return status.code() == other.status.code() && certificate == other.certificate &&
           values == other.values;
  }
};

Outcome solve_kept(const Scene& scene, const radiosity::Options& options, KeptRun* kept = nullptr,
                   std::uint32_t threads = 1, Watch* watch = nullptr);
Outcome form_factors_kept(const Scene& scene, const radiosity::Options& options,
                          KeptRun* kept = nullptr, std::uint32_t threads = 1,
                          Watch* watch = nullptr);

/// A closed room of 37 patches with black walls, a black lamp in the ceiling and a table; black
/// patches first, last and in between.
Scene kept_room(double reflectance = 0.6, double exitance = 5);

/// 27 patches under a bright sky, some of which see nothing but that and backs of others; colours.
Scene kept_open_scene();

} // namespace hemicube::test
