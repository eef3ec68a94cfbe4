#pragma once

#include "radiosity/parallel/executor.h"
#include "radiosity/solve/enclosures.h"
#include "radiosity/solve/row_gather.h"

namespace hemicube::radiosity {

/// What the solvers of a stored matrix have in common: B = source + rho F B for the patches that
/// reflect, all else being known; sums over rows in parallel; and when to stop. Rows of black
/// patches are not read. The matrix is walked range by range, as seldom as can be: it may be a
/// file.
class LightSystem {
public:
  /// All outlive this.
  LightSystem(const FormFactorMatrix& matrix, const LightProblem& problem,
              const SolverOptions& options, Executor& executor) noexcept
      : matrix_(matrix), problem_(problem), options_(options), executor_(executor),
        bands_(problem.band_count) {}

  /// Reads the matrix twice, and more often only where patches reflect everything.
  /// @return kInvalidArgument (tolerance), kSingular, kOutOfMemory
  Status init();

  bool reflects(std::size_t patch) const noexcept {
    return enclosures_.of_patch[patch] != Enclosures::kNone;
  }

  /// into = F from, for reflecting patches. @param from  [patch][band]
  Status gather(std::span<const double> from, Buffer<double>* into);

  /// How far x is from a solution. @param gathered  F x
  /// @return kBadScene: light beyond the range of numbers
  Status measure(std::span<const double> x, std::span<const double> gathered,
                 Convergence* convergence) const;

  /// Fills what a solver returns, from x and F x.
  Status finish(std::span<const double> x, std::span<const double> gathered,
                Buffer<double>* radiosity, Buffer<double>* irradiance) const;

  /// kNotConverged with what `convergence` says.
  Status not_converged(const Convergence& convergence) const noexcept;

  /// The first guess: the source, and what is reflected of it once.
  Status first_guess(Buffer<double>* x) const;

  /// The entries of a row whose columns lie in the sweep block of the row.
  struct InsideRange {
    std::uint32_t first, last;
  };
  /// Rows whose sums over their own block are taken in sequence; a multiple of
  /// FormFactorMatrix::kBlockRows that divides its ranges.
  static constexpr std::size_t kSweepBlockRows = 256;
  static_assert(FormFactorMatrix::kRangeBlocks * FormFactorMatrix::kBlockRows % kSweepBlockRows ==
                0);
  InsideRange inside(std::size_t patch) const noexcept { return inside_[patch]; }

  const FormFactorMatrix& matrix() const noexcept { return matrix_; }
  const LightProblem& problem() const noexcept { return problem_; }
  const SolverOptions& options() const noexcept { return options_; }
  Executor& executor() const noexcept { return executor_; }
  const Enclosures& enclosures() const noexcept { return enclosures_; }
  RowGather& values() noexcept { return values_; }
  // [patch][band]; 0 for black patches.
  std::span<const double> source() const noexcept { return source_.span(); } ///< E + rho * fixed
  std::span<const double> from_source() const noexcept { return from_source_.span(); } ///< F source

private:
  Status read_rows();
  Status find_contraction();

  const FormFactorMatrix& matrix_;
  const LightProblem& problem_;
  const SolverOptions& options_;
  Executor& executor_;
  const std::uint32_t bands_;
  RowGather values_; ///< what is being gathered
  Enclosures enclosures_;
  Buffer<InsideRange> inside_; ///< [patch]
  Buffer<double> row_sums_;    ///< [patch]
  Buffer<double> fixed_;       ///< irradiance from black patches and from space
  Buffer<double> source_, from_source_;
  Buffer<double> contraction_; ///< [band] max rho * row sum, of the enclosures that have light
};

} // namespace hemicube::radiosity
