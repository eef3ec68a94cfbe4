#pragma once

#include "radiosity/light_model.h"
#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// Passes on what a solver tells to the caller's Progress, and its state as a snapshot every so
/// many shots.
class SolverWatch final : public SolverProgress {
public:
  /// All outlive this. @param progress  may be null
  SolverWatch(const Scene& scene, const PatchSet& patches, const LightModel& light,
              const Options& options, Progress* progress)
      : scene_(scene), patches_(patches), light_(light), options_(options), progress_(progress) {}

  bool swept(std::uint64_t sweeps, double error) noexcept override {
    return progress_ == nullptr || progress_->sweeps(sweeps, error);
  }
  bool shot(const ShotState& state) noexcept override;

  /// What the solver returned, or why it was stopped.
  Status outcome(const Status& solved) const { return failure_.ok() ? solved : failure_; }

  /// [band of the problem] of the last state; empty before.
  std::span<const double> ambient() const { return ambient_.span(); }

private:
  Status take_snapshot(const ShotState& state);

  const Scene& scene_;
  const PatchSet& patches_;
  const LightModel& light_;
  const Options& options_;
  Progress* progress_;
  Buffer<double> ambient_;
  Status failure_;
};

/// Fills reflectance, exitance, radiosity and ambient of a solution, per band of the scene.
/// @param radiosity  [patch][band of the problem]
/// @param ambient    [band of the problem], or empty
Status fill_light(const LightModel& light, std::uint32_t band_count,
                  std::span<const double> radiosity, std::span<const double> ambient,
                  Solution* solution);

} // namespace hemicube::radiosity
