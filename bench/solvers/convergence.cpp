#include "bench/solvers/solvers.h"

#include "radiosity/light_model.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/read_scene.h"
#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solve/jacobi.h"
#include "radiosity/solve/progressive.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::bench {

using namespace radiosity;
using test::require;

namespace {

Scene file_scene(const char* path) {
  Scene scene;
  ReadReport read;
  require(read_scene(std::string(HC_SOURCE_DIR) + path, &scene, &read));
  return scene;
}

/// The unit cube with a ceiling that emits, all of it reflecting 99 %.
Scene white_room() {
  Scene scene = test::cube8();
  for (double& reflectance : scene.reflectance)
    reflectance = 0.99;
  return scene;
}

/// A scene and how far to cut its patches, in metres.
struct Case {
  const char* name;
  Scene (*make)();
  double max_edge;
};

const Case kCases[] = {
    {"cornell", [] { return file_scene("/scenes/cornell.obj"); }, 0.04},
    {"corridor", [] { return file_scene("/tests/reference/scenes/corridor_a.coarse.obj"); }, 0.35},
    {"white_room", white_room, 0.06},
};

PatchSet meshed(const Scene& scene, double max_edge) {
  PatchSet coarse, fine;
  MeshReport mesh;
  require(build_patches(scene, &coarse, &mesh));
  const std::vector<double> limits(coarse.patch_count(), max_edge);
  require(subdivide(coarse, limits, &fine, &mesh));
  return fine;
}

/// RMS difference over the RMS of the truth, area-weighted, all bands together.
double relative_rms(const LightProblem& p, std::span<const double> b,
                    std::span<const double> truth) {
  double errors = 0, all = 0;
  for (std::size_t at = 0; at < truth.size(); ++at) {
    const double area = p.area[at / p.band_count];
    errors += area * (b[at] - truth[at]) * (b[at] - truth[at]);
    all += area * truth[at] * truth[at];
  }
  return std::sqrt(errors / all);
}

std::string time_case(const Case& of, Executor& executor) {
  const Scene scene = of.make();
  const PatchSet patches = meshed(scene, of.max_edge);
  Options rows;
  rows.resolution = 128;
  FormFactorMatrix matrix;
  Certificate certificate;
  LightModel light;
  require(compute_form_factors(patches, {}, rows, executor, nullptr, &matrix, &certificate));
  require(light.init(scene, patches));
  const LightProblem problem = light.problem(patches);
  Buffer<double> truth, b, h;
  Convergence convergence;
  SolverOptions options;
  options.tolerance = 1e-13;
  (void)gauss_seidel(matrix, problem, options, executor, nullptr, &truth, &h, &convergence);
  std::string table;
  const auto run = [&](const char* name, decltype(gauss_seidel)* solver, std::uint64_t step) {
    Stopwatch watch;
    (void)solver(matrix, problem, options, executor, nullptr, &b, &h, &convergence);
    const double seconds = watch.lap();
    char line[200];
    std::snprintf(line, sizeof line, "%s,%u,%s,%llu,%.4f,%.2e,%.2e\n", of.name,
                  patches.patch_count(), name, static_cast<unsigned long long>(step), seconds,
                  convergence.residual, relative_rms(problem, b.span(), truth.span()));
    table += line;
  };
  options.tolerance = 1e-300;
  for (const std::uint64_t sweeps : {0, 2, 4, 6, 8, 12, 16, 20, 24, 32, 48}) {
    options.max_sweeps = sweeps;
    run("gauss-seidel", gauss_seidel, sweeps);
    run("jacobi", jacobi, sweeps);
  }
  for (std::uint64_t rounds = 0; rounds <= 8; ++rounds) {
    options.max_shots = rounds * patches.patch_count();
    options.stop_unshot = 1e-12;
    run("progressive", progressive, rounds);
  }
  std::printf("%s", table.c_str());
  return table;
}

/// Light from the mesh on, rows included.
std::string time_from_mesh(const Case& of, Executor& executor) {
  const Scene scene = of.make();
  const PatchSet patches = meshed(scene, of.max_edge);
  LightModel light;
  require(light.init(scene, patches));
  const LightProblem problem = light.problem(patches);
  Solution truth;
  Certificate certificate;
  Options options;
  options.resolution = 128;
  options.tolerance = 1e-12;
  require(solve_scene(scene, patches, options, executor, nullptr, &truth, &certificate));
  const auto same_bands = [&](const Solution& solution) {
    std::vector<double> of_problem(patches.patch_count() * problem.band_count);
    for (std::size_t i = 0; i < patches.patch_count(); ++i)
      for (std::uint32_t b = 0; b < solution.band_count; ++b)
        of_problem[i * problem.band_count + light.solved_band[b]] =
            solution.radiosity[i * solution.band_count + b];
    return of_problem;
  };
  const std::vector<double> want = same_bands(truth);
  std::string table;
  const auto run = [&](const char* name) {
    Stopwatch watch;
    Solution got;
    (void)solve_scene(scene, patches, options, executor, nullptr, &got, &certificate);
    const double seconds = watch.lap();
    char line[200];
    std::snprintf(line, sizeof line, "%s,%u,%s,%llu,%.4f,%.2e,%016llx\n", of.name,
                  patches.patch_count(), name,
                  static_cast<unsigned long long>(certificate.shots + certificate.sweeps), seconds,
                  relative_rms(problem, same_bands(got), want),
                  static_cast<unsigned long long>(certificate.radiosity_hash));
    table += line;
  };
  for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6}) {
    options.tolerance = tolerance;
    run("gauss-seidel");
  }
  options.solver = SolverKind::kProgressive;
  options.stop_unshot = 1e-9;
  for (std::uint64_t shots = 4; shots <= 4 * patches.patch_count(); shots *= 3) {
    options.max_shots = shots;
    run("progressive");
  }
  std::printf("%s", table.c_str());
  return table;
}

} // namespace

std::string time_convergence() {
  SerialExecutor executor;
  std::string table;
  for (const Case& of : kCases)
    table += time_case(of, executor);
  return table;
}

std::string time_shooting() {
  SerialExecutor executor;
  std::string table;
  for (const Case& of : kCases)
    table += time_from_mesh(of, executor);
  return table;
}

} // namespace hemicube::bench
