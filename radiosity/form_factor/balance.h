#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"

namespace hemicube::radiosity {

/// balance() refuses to change form factors by more than this, RMS.
inline constexpr double kMostBalanceChange = 0.5;

/// What balance() did.
struct BalanceReport {
  std::uint64_t iterations = 0; ///< products with the matrix
  double max_change = 0;        ///< largest |F'_ij - F_ij|
  double rms_change = 0; ///< sqrt(sum (A_i (F'_ij - F_ij))^2 / sum (A_i F_ij)^2), all entries
  /// Largest |sum_j F'_ij + space + back side - 1| before the last step closed the rows, which it
  /// does at the cost of reciprocity: about 1e-8, unless no reciprocal matrix of this pattern
  /// closes.
  double closure_residual = 0;
};

/// Is told of every iteration.
class BalanceProgress {
public:
  /// @param closure_residual  so far
  /// @return false to stop: balance() then ends with kCancelled
  virtual bool iterated(std::uint64_t iterations, double closure_residual) noexcept = 0;

protected:
  ~BalanceProgress() = default;
};

/// Makes form factors reciprocal, A_i F_ij = A_j F_ji, while every row keeps its sum, space and
/// back side: the exchange areas S_ij nearest to the averages (A_i F_ij + A_j F_ji) / 2, in the sum
/// of squared relative errors, whose rows sum to A_i (1 - s_i - b_i). An entry that only one of (i,
/// j) and (j, i) has, for pixels missed the other, becomes one of both.
///
/// All entries stay > 0. Rows sum, as the solver reads them, to 1 - s_i - b_i or a rounding less;
/// reciprocity holds to the rounding of float, 1e-7. Where no reciprocal matrix closes (two facing
/// plates that see different shares of each other), closing goes first: losses, space and back
/// side in proportion, of rows that have any take what is left; other rows stay unreciprocal, by
/// closure_residual. The losses of a row whose averages sum to less than half or more than twice
/// its share (its centre is under a block, its rim is not) give way at once.
///
/// @param matrix    row i belongs to patch i; all rows were built. After an error its rows are
///                  those it had, or part of those it would have.
/// @param area      [patch], m^2, > 0
/// @param progress  may be null
/// @return kInvalidArgument (a row is missing), kBadScene (rms_change above kMostBalanceChange; the
///         report is filled), kOutOfMemory, kCancelled
/// Deterministic: the same bits for any executor; + - * / sqrt only. O(non-zeros) an iteration, at
/// most some hundreds; memory for the matrix twice over.
/// Source: Larsen and Howell 1986, "Least-squares smoothing of direct-exchange areas in zonal
/// analysis": weights S_ij^2. The equations are solved by preconditioned conjugate residuals.
Status balance(FormFactorMatrix* matrix, std::span<const double> area, Executor& executor,
               BalanceProgress* progress, BalanceReport* report);

} // namespace hemicube::radiosity
