#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/solve/unshot_light.h"

namespace hemicube::radiosity {

/// Where power went, in W, per band. What was emitted is the sum of all, to rounding.
struct ShotPower {
  double absorbed = 0;
  double escaped = 0;   ///< to space
  double back_side = 0; ///< to backs of surfaces
  double cut = 0;       ///< beyond what a patch can receive: form factors that were capped
};

/// Progressive refinement without a matrix: a patch shoots by its own row of form factors, which
/// serves its receivers by reciprocity, F_ij = F_ji A_j / A_i, capped at 1. Memory O(patches).
class RowShooter {
public:
  /// Begins, or begins anew.
  /// @param problem  outlives this
  /// @param space    [patch] the fraction that sees space; empty if no light comes from there
  Status init(const LightProblem& problem, std::span<const double> space);

  UnshotLight& unshot() noexcept { return unshot_; }

  /// Shoots what is unshot of a patch. @param row  its row of form factors
  void shoot(std::uint32_t patch, const RowView& row) noexcept;

  // [patch][band] W/m^2, unshot light included.
  Buffer<double>& radiosity() noexcept { return radiosity_; }
  Buffer<double>& irradiance() noexcept { return irradiance_; } ///< also of black patches

  const ShotPower& power(std::uint32_t band) const noexcept { return power_[band]; }
  /// W; what is still unshot counts as it is, overshot light as less.
  double unshot_power(std::uint32_t band) noexcept;
  double emitted(std::uint32_t band) const noexcept { return emitted_[band]; }

  /// unshot_bound() with the largest reflectance; worst band.
  double bound() const noexcept;

private:
  const LightProblem* problem_ = nullptr;
  UnshotLight unshot_;
  Buffer<double> radiosity_, irradiance_;
  Buffer<double> shot_, emitted_; ///< [band]
  Buffer<ShotPower> power_;       ///< [band]
};

} // namespace hemicube::radiosity
