#include "radiosity/solve/jacobi.h"

#include "radiosity/solve/light_system.h"
#include "raster/fp_environment.h"

namespace hemicube::radiosity {

Status jacobi(const FormFactorMatrix& matrix, const LightProblem& problem,
              const SolverOptions& options, Executor& executor, SolverProgress* progress,
              Buffer<double>* radiosity, Buffer<double>* irradiance, Convergence* convergence) {
  constexpr std::uint64_t kSweepsPerCall = 4;
  const FloatEnvironment environment;
  LightSystem system(matrix, problem, options, executor);
  HC_TRY(system.init());
  Buffer<double> x, gathered;
  HC_TRY(system.first_guess(&x));
  HC_TRY(gathered.resize(x.size()));
  *convergence = {};
  while (true) {
    // What the next sweep needs is what the residual is measured by.
    HC_TRY(system.gather(x.span(), &gathered));
    HC_TRY(system.measure(x.span(), gathered.span(), convergence));
    const bool is_last = convergence->converged || convergence->sweeps >= options.max_sweeps;
    if (progress != nullptr && (is_last || convergence->sweeps % kSweepsPerCall == 0) &&
        !progress->swept(convergence->sweeps, convergence->estimated_error))
      return Status::error(StatusCode::kCancelled, "interrupted while solving");
    if (is_last)
      break;
    for (std::size_t at = 0; at < x.size(); ++at)
      x[at] = system.source()[at] + problem.reflectance[at] * gathered[at];
    ++convergence->sweeps;
  }
  HC_TRY(system.finish(x.span(), gathered.span(), radiosity, irradiance));
  return convergence->converged ? Status() : system.not_converged(*convergence);
}

} // namespace hemicube::radiosity
