#pragma once

#include "radiosity/solve/light_problem.h"

namespace hemicube::radiosity {

/// The unshot light of progressive refinement, and whose turn it is.
class UnshotLight {
public:
  /// @param problem  outlives this
  /// @param source   [patch][band] what is unshot at first
  /// @param emitted  [band] the power that shares are told of
  Status init(const LightProblem& problem, std::span<const double> source,
              std::span<const double> emitted);

  /// [patch][band] W/m^2; negative where a patch has shot more than it had.
  std::span<double> values() noexcept { return values_.span(); }

  /// Adds up what is unshot: to be called before the two below.
  void survey() noexcept;

  /// The patches with the most unshot power over all bands, overshooting included; the brightest
  /// first, of equals the lowest. Dark ones are left out.
  /// @return how many, up to patches.size()
  std::size_t choose(std::span<std::uint32_t> patches) const noexcept;

  /// Takes what a patch shoots now. Overshooting (Feda and Purgathofer 1992): besides what is
  /// unshot, light that is guessed to arrive later, rho times the ambient term; what is shot in
  /// advance becomes negative unshot light. Never more than kMostOvershot of what is there, with
  /// which unshot light still falls from shot to shot.
  /// @param shot  [band]
  void take(std::uint32_t patch, double* shot) noexcept;

  double share() const noexcept { return share_; } ///< worst band
  std::span<const double> ambient() const noexcept { return ambient_.span(); }
  double power(std::uint32_t band) const noexcept { return power_[band]; } ///< sum A |unshot|

private:
  static constexpr double kMostOvershot = 0.25;
  double overshoot(std::size_t patch, std::uint32_t band) const noexcept;

  const LightProblem* problem_ = nullptr;
  Buffer<double> values_;
  Buffer<double> emitted_, power_, ambient_;
  Buffer<double> ambient_per_power_; ///< [band] 1 / ((1 - mean rho) sum A)
  double share_ = 0;
};

} // namespace hemicube::radiosity
