#pragma once

#include "raster/memory.h"

#include <cstdint>
#include <string_view>

namespace hemicube::raster {
struct Kernels;
}

namespace hemicube::radiosity {

/// B_i = E_i + rho_i (sum_j F_ij B_j + s_i E_space) for every patch i and band: what the solvers
/// solve. Views; arrays are [patch][band] unless said otherwise.
struct LightProblem {
  std::uint32_t band_count = 0;
  std::span<const double> area;                      ///< [patch] > 0
  std::span<const double> reflectance;               ///< rho, 0..1
  std::span<const double> exitance;                  ///< E, W/m^2, >= 0
  std::span<const double> space_exitance;            ///< [band] E_space, W/m^2, >= 0
  std::span<const std::string_view> band_names = {}; ///< [band] for messages; may be empty

  std::size_t patch_count() const noexcept { return area.size(); }

  /// A patch that reflects nothing in any band: its radiosity is its exitance, and it needs no row.
  bool is_black(std::size_t patch) const noexcept {
    for (std::uint32_t b = 0; b < band_count; ++b)
      if (reflectance[patch * band_count + b] != 0)
        return false;
    return true;
  }
};

/// When to stop.
struct SolverOptions {
  double tolerance = 1e-6; ///< on the estimated relative error of B; > 0
  std::uint64_t max_sweeps = 1000000;
  const raster::Kernels* kernels = nullptr; ///< instruction set; null = the best this machine has

  // Of progressive refinement:
  double stop_unshot = 0; ///< stop at this share of unshot light, 0..1; 0: the tolerance decides
  std::uint64_t max_shots = ~std::uint64_t{0};
};

/// How far a solver came. Errors are relative to the largest |B| of a band; the worst band counts.
struct Convergence {
  double residual = 0; ///< max|E + rho H - B| / max|B|
  double estimated_error =
      0; ///< residual / (1 - max rho * row sum); infinity if that bound is void
  std::uint64_t sweeps = 0;
  bool converged = false;
  bool rounding_floor = false; ///< stopped because the residual is down to rounding

  // Of progressive refinement:
  std::uint64_t shots = 0;
  double unshot = 0;       ///< unshot power over emitted power
  double unshot_bound = 0; ///< on what unshot light can still add, over sum A B; infinity if void
};

/// Where progressive refinement stands after a shot. Arrays are [patch][band].
struct ShotState {
  std::uint64_t shots = 0;
  double unshot = 0;                 ///< as in Convergence
  std::span<const double> radiosity; ///< of black patches perhaps 0: theirs is their exitance
  std::span<const double> ambient;   ///< [band] Cohen et al. 1988: a guess of the irradiance that
                                     ///< unshot light will make; for display alone
};

/// Told before the first sweep and after every few; returns false to stop.
class SolverProgress {
public:
  virtual bool swept(std::uint64_t sweeps, double estimated_error) noexcept = 0;
  /// Told before the first shot and after each.
  virtual bool shot(const ShotState& state) noexcept {
    static_cast<void>(state);
    return true;
  }

protected:
  ~SolverProgress() = default;
};

} // namespace hemicube::radiosity
