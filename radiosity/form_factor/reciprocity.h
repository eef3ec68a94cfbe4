#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"

namespace hemicube::radiosity {

/// How far a matrix is from A_i F_ij = A_j F_ji, over the pairs of which either entry is not 0.
struct Reciprocity {
  double max = 0; ///< largest |A_i F_ij - A_j F_ji| / min(A_i, A_j)
  double rms =
      0; ///< root of the sum of (A_i F_ij - A_j F_ji)^2 over that of the larger term squared
};

/// @param matrix    row i belongs to patch i; pairs with a patch whose row was not built are left
///                  out
/// @param area      [patch]
/// @param is_left_out  [patch] 1: pairs with it are left out too; empty: none
Status measure_reciprocity(const FormFactorMatrix& matrix, std::span<const double> area,
                           Executor& executor, Reciprocity* reciprocity,
                           std::span<const std::uint8_t> is_left_out = {});

} // namespace hemicube::radiosity
