#pragma once

#include "radiosity/row_run.h"
#include "radiosity/row_statistics.h"
#include "radiosity/solve/shooting.h"

namespace hemicube::radiosity {

/// The share of unshot light that shooting without a matrix stops at unless told otherwise.
inline constexpr double kDefaultStopUnshot = 0.001;

/// Light by progressive refinement without a matrix: rows of form factors are made when their patch
/// shoots, those of the Shooting::kRowsAtOnce brightest at once, in parallel, and forgotten. Memory
/// O(patches). Where space sends light in, or a patch reflects everything, all rows are made once
/// before, for what they say of space and of enclosures.
class SceneShooter final : ShotRows {
public:
  /// @param problem  outlives this
  explicit SceneShooter(const LightProblem& problem) : problem_(problem) {}

  /// @param progress    may be null
  /// @param statistics  told of every row that was made
  /// @return kSingular, kInvalidArgument (stop_unshot), kCancelled, kOutOfMemory, kBadScene (light
  ///         beyond the range of numbers), kNotConverged (after options.max_shots; the light is
  ///         there all the same)
  Status run(RowGeometry* geometry, const RungSetting& setting, const Options& options,
             Executor& executor, SolverProgress* progress, RowStatistics* statistics);

  RowShooter& light() noexcept { return shooting_.light(); }
  const Convergence& convergence() const noexcept { return convergence_; }

  /// Of the problem's bands.
  EnergyBalance energy(std::uint32_t band) noexcept;

private:
  Status look_around();
  Status prepare(std::span<const std::uint32_t> patches) override;
  Status row(std::size_t k, RowView* row) override;
  Status tell();

  const LightProblem& problem_;
  RowRun rows_;
  FormFactorMatrix made_; ///< a block for each row: a worker for each
  Buffer<double> space_;  ///< [patch], or empty
  Shooting shooting_;
  RowStatistics* statistics_ = nullptr;
  Convergence convergence_;
  SolverProgress* progress_ = nullptr;
};

} // namespace hemicube::radiosity
