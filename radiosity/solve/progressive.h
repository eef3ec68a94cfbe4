#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/solve/light_problem.h"

namespace hemicube::radiosity {

/// Progressive refinement (Cohen, Chen, Wallace and Greenberg 1988) on a stored matrix: the patch
/// with the most unshot light shoots it to all others, by the column of the matrix, with
/// overshooting (unshot_light.h). The matrix is held a second time, by columns. Now and then, and
/// at the end, the light is gathered: that measures the residual of gauss_seidel(), rescales
/// enclosures and makes unshot light exact again. Stops by the rules of gauss_seidel(), or at
/// options.stop_unshot, or after options.max_shots. Arguments are those of gauss_seidel(); light of
/// black patches and of space is there before the first shot.
/// @return also kInvalidArgument (stop_unshot)
Status progressive(const FormFactorMatrix& matrix, const LightProblem& problem,
                   const SolverOptions& options, Executor& executor, SolverProgress* progress,
                   Buffer<double>* radiosity, Buffer<double>* irradiance, Convergence* convergence);

/// kInvalidArgument unless it is a share, 0 <= share < 1.
Status check_stop_unshot(double share) noexcept;

/// What unshot light can still add in the norm sum A |B|, over sum A B: each way round loses at
/// least 1 - rate of it. @param rate  rho_max or better; infinity if it is not below 1
double unshot_bound(double rate, double unshot_power, double total_power) noexcept;

} // namespace hemicube::radiosity
