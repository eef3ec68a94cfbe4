#pragma once

#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// What is done of a run to judge what all of it will cost.
enum class ForecastPart {
  kGeometry,  ///< what all rows share
  kChoice,    ///< of rung and resolution
  kFirstRows, ///< Forecast::first_rows, and what a worker needs before its first one
  kRows,      ///< Forecast::rows more, and the same again
  kExactRows, ///< Forecast::exact_rows of those that errors are estimated by
};

/// Told when a part is done: whoever has a clock takes the times.
class ForecastProgress {
public:
  virtual void finished(ForecastPart part) noexcept = 0;

protected:
  ~ForecastProgress() = default;
};

/// What a solve would do, judged by doing a little of it.
struct Forecast {
  RungSetting setting;             ///< chosen as solve_scene would
  bool shares_pairs = false;       ///< each pair of patches is found once for both rows
  std::uint64_t rows_to_build = 0; ///< of all patches whose rows are wanted
  std::uint64_t rows_to_store = 0; ///< of these, what the solver keeps
  std::uint32_t solved_bands = 0;
  std::uint64_t first_rows = 0, rows = 0, nonzeros = 0; ///< of the sample: built each alone
  std::uint64_t exact_rows = 0;                         ///< of the sample
  std::uint64_t exact_rows_to_build = 0;
};

/// @param scene, patches, options, executor  as for solve_scene
/// @return as solve_scene
Status forecast(const Scene& scene, const PatchSet& patches, const Options& options,
                Executor& executor, ForecastProgress* progress, Forecast* forecast);

} // namespace hemicube::radiosity
