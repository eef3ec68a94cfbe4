#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/solve/light_problem.h"

namespace hemicube::radiosity {

/// Reflecting patches that exchange light, directly or through others, form an enclosure. Black
/// patches belong to none: they pass nothing on.
struct Enclosures {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Buffer<std::uint32_t> of_patch;    ///< [patch] number of its enclosure, or kNone
  Buffer<std::uint32_t> first_patch; ///< [enclosure] its lowest patch; enclosures ascend by it
};

Status find_enclosures(const FormFactorMatrix& matrix, const LightProblem& problem,
                       Enclosures* enclosures);

/// Refuses what has no solution: patches that reflect everything in a band, see only each other,
/// and have light in that band.
/// @param source  [patch][band] light that does not come from reflecting patches: E + rho G
/// @return kSingular, naming the lowest lit one of them and the band
Status check_solvable(const FormFactorMatrix& matrix, const LightProblem& problem,
                      const Enclosures& enclosures, std::span<const double> source);

} // namespace hemicube::radiosity
