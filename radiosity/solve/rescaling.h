#pragma once

#include "radiosity/solve/enclosures.h"

namespace hemicube::radiosity {

/// Scales the reflected light of each enclosure, per band, so that its summed residual power is
/// zero: the one error that sweeps hardly reduce when rho is near 1. The balance weighs patches by
/// area, which is right as far as the matrix is reciprocal. Where it is not, scaling can do harm;
/// so where the residual has not fallen since the last time, it is left to the sweeps for 1, 2, 4,
/// ... turns.
class EnclosureRescaling {
public:
  Status init(const Enclosures& enclosures, std::uint32_t band_count);

  /// @param source       [patch][band] E + rho * light from black patches and from space
  /// @param from_source  [patch][band] F source
  /// @param x            [patch][band] radiosity, scaled
  /// @param gathered     [patch][band] F x, scaled with it
  void apply(const LightProblem& problem, const Enclosures& enclosures,
             std::span<const double> source, std::span<const double> from_source,
             std::span<double> x, std::span<double> gathered);

private:
  /// One enclosure in one band.
  struct Balance {
    double residual_power, lost_power; ///< lost: by reflected light on its next way round
    double residual, brightest;        ///< largest
    double last;                       ///< residual / brightest when it was scaled last; < 0: never
    std::uint32_t failures, wait;
    double gain; ///< how much more reflected light there is to be, as a share of it
  };

  static double choose_gain(Balance* balance);

  Buffer<Balance> balances_; ///< [enclosure][band]
};

} // namespace hemicube::radiosity
