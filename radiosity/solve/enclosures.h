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
  Buffer<std::uint8_t> is_open; ///< [patch] loses light by itself: to space, backs, black patches
};

/// Finds enclosures from rows in any order, each added by one worker: what comes out is the same
/// however they were shared out.
class EnclosureFinder {
public:
  /// @param problem  outlives this
  Status init(const LightProblem& problem, std::size_t worker_count);

  /// @param patch  one that reflects
  void add_row(std::size_t worker, std::uint32_t patch, const RowView& row) noexcept;

  Status finish(Enclosures* enclosures);

private:
  /// Union by lowest number, with path halving. Black patches are in no set.
  struct Sets {
    Buffer<std::uint32_t> parent; ///< kNone for black patches
    std::uint32_t root(std::uint32_t i) noexcept;
    std::uint32_t join(std::uint32_t a, std::uint32_t b) noexcept;
  };
  FixedArray<Sets> of_worker_;
  Buffer<std::uint8_t> is_open_;
};

/// Refuses what has no solution: patches that reflect everything in a band, see only each other,
/// and have light in that band. Reads the matrix only if a patch reflects everything.
/// @param source  [patch][band] light that does not come from reflecting patches: E + rho G
/// @return kSingular, naming the lowest lit one of them and the band
Status check_solvable(const FormFactorMatrix& matrix, const LightProblem& problem,
                      const Enclosures& enclosures, std::span<const double> source);

/// The same without a matrix, taking what one patch sees of another to be seen back.
Status check_enclosures(const LightProblem& problem, const Enclosures& enclosures,
                        std::span<const double> source);

} // namespace hemicube::radiosity
