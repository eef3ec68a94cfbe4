#include "bench/solvers/solvers.h"

#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solve/jacobi.h"
#include "radiosity/solve/progressive.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::bench {

using namespace radiosity;

std::string time_convergence() {
  ThreadPool pool;
  test::require(pool.init(1));
  FormFactorMatrix matrix;
  Light light;
  light.bands = 1;
  light.space_exitance = {0};
  make_cornell_matrix(0.04, pool, &matrix, &light.area);
  std::string table;
  for (const double reflectance : {0.5, 0.8, 0.99}) {
    const std::size_t count = light.area.size();
    light.reflectance.assign(count, reflectance);
    light.exitance.assign(count, 0);
    for (std::size_t i = 0; i < count; i += 100)
      light.exitance[i] = 1;
    Buffer<double> truth, b, h;
    Convergence convergence;
    SolverOptions options;
    options.tolerance = 1e-13;
    (void)gauss_seidel(matrix, light.problem(), options, pool, nullptr, &truth, &h, &convergence);
    const double brightest = *std::max_element(truth.begin(), truth.end());
    const auto run = [&](const char* name, decltype(gauss_seidel)* solver, std::uint64_t step) {
      Stopwatch watch;
      (void)solver(matrix, light.problem(), options, pool, nullptr, &b, &h, &convergence);
      const double seconds = watch.lap();
      double error = 0;
      for (std::size_t i = 0; i < count; ++i)
        error = std::max(error, std::fabs(b[i] - truth[i]));
      char line[200];
      std::snprintf(line, sizeof line, "%s,%g,%llu,%.4f,%.2e,%.2e\n", name, reflectance,
                    static_cast<unsigned long long>(step), seconds, convergence.residual,
                    error / brightest);
      table += line;
    };
    options.tolerance = 1e-300;
    for (std::uint64_t sweeps = 0; sweeps <= 24; sweeps += 2) {
      options.max_sweeps = sweeps;
      run("gauss-seidel", gauss_seidel, sweeps);
      run("jacobi", jacobi, sweeps);
    }
    for (std::uint64_t rounds = 0; rounds <= 6; ++rounds) {
      options.max_shots = rounds * count;
      options.stop_unshot = 1e-12;
      run("progressive", progressive, rounds);
    }
    options = {};
    options.tolerance = 1e-13;
  }
  std::printf("%s", table.c_str());
  return table;
}

} // namespace hemicube::bench
