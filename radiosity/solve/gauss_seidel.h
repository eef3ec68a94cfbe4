#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/solve/light_problem.h"

namespace hemicube::radiosity {

/// Solves by Gauss-Seidel sweeps in ascending patch order, all bands in one pass, in double. Rows
/// are taken in blocks whose size does not depend on the number of workers: what a block gathers
/// from outside is summed in parallel, what it gathers from itself in sequence. Every few sweeps
/// enclosures are rescaled (rescaling.h). Rows of black patches are not read.
/// @param matrix      row i belongs to patch i
/// @param radiosity   out, [patch][band] B, W/m^2
/// @param irradiance  out, [patch][band] H, W/m^2; 0 for black patches
/// @param progress    may be null
/// @return kInvalidArgument (tolerance), kSingular (naming patch and band), kBadScene (light beyond
///         the range of numbers), kNotConverged (the results are filled all the same), kCancelled,
///         kOutOfMemory
Status gauss_seidel(const FormFactorMatrix& matrix, const LightProblem& problem,
                    const SolverOptions& options, Executor& executor, SolverProgress* progress,
                    Buffer<double>* radiosity, Buffer<double>* irradiance,
                    Convergence* convergence);

} // namespace hemicube::radiosity
