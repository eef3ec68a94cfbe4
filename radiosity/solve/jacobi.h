#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/solve/light_problem.h"

namespace hemicube::radiosity {

/// Solves by Jacobi's method: all patches gather from the same old light. A yardstick: it takes
/// about twice the sweeps of gauss_seidel(), and nothing helps it where rho is near 1. Arguments,
/// residual and stopping rules are those of gauss_seidel().
Status jacobi(const FormFactorMatrix& matrix, const LightProblem& problem,
              const SolverOptions& options, Executor& executor, SolverProgress* progress,
              Buffer<double>* radiosity, Buffer<double>* irradiance, Convergence* convergence);

} // namespace hemicube::radiosity
