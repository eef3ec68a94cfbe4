#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"

namespace hemicube::radiosity {

/// Fills `exchange` with exchange areas S_ij = (A_i F_ij + A_j F_ji) / 2 on the union of the
/// patterns of F and its transpose, in units of the largest area. S_ij and S_ji are the same bits;
/// scales are 1, space and back sides those of F.
/// @param matrix  row i belongs to patch i; all rows were built
/// @param area    [patch]
/// Deterministic: the same bits for any executor. Memory: as much again as the matrix takes.
Status exchange_areas(const FormFactorMatrix& matrix, std::span<const double> area,
                      Executor& executor, FormFactorMatrix* exchange);

} // namespace hemicube::radiosity
