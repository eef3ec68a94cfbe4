#include "radiosity/error_estimate.h"

#include "radiosity/solve/gauss_seidel.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// An error need not be known to more than two digits.
constexpr SolverOptions kRoughly = {0.01, 200};

} // namespace

RungSetting finer_setting(const RungSetting& setting) noexcept {
  RungSetting finer = setting;
  finer.rung = Rung::kAdaptive;
  finer.target = setting.rung == Rung::kAdaptive ? setting.target / 10 : 0.03;
  return finer;
}

Status compute_exact_rows(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                          Executor& executor, RowSample* sample) {
  Options quiet = options;
  quiet.hash_items = false;
  RowRun run;
  const auto patches = sample->patches();
  HC_TRY(run.init(geometry, setting, quiet, patches.size(), executor, nullptr));
  return run.build(
      patches.size(),
      [&](std::uint64_t k, RowPlace* place) {
        place->patch = patches[k];
        return true;
      },
      [&](std::uint64_t k, const RowView& row, const RowFacts*) {
        return sample->exact.append_row(k / FormFactorMatrix::kBlockRows, row);
      });
}

Status estimate_radiosity_error(const RowSample& sample, const FormFactorMatrix& matrix,
                                const LightProblem& problem, std::span<const double> radiosity,
                                Executor& executor, double* error) {
  const std::uint32_t bands = problem.band_count;
  const std::size_t count = problem.patch_count();
  Buffer<double> defects, made, gathered;
  HC_TRY(defects.resize(count * bands));
  const auto patches = sample.patches();
  std::size_t first = 0; // of the patches that the sampled one stands for
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const std::size_t end =
        k + 1 == patches.size() ? count : (std::size_t{patches[k]} + patches[k + 1] + 1) / 2;
    double* own = &defects[std::size_t{patches[k]} * bands];
    sample.defect(k, matrix.row(patches[k]), problem, radiosity, own);
    for (std::size_t i = first; i < end; ++i)
      std::copy_n(own, bands, &defects[i * bands]);
    first = end;
  }
  // A patch that reflects nothing has no error, whatever it stands beside.
  for (std::size_t k = 0; k < defects.size(); ++k)
    if (problem.reflectance[k] == 0)
      defects[k] = 0;
  Buffer<double> dark;
  HC_TRY(dark.resize(bands));
  LightProblem wrong = problem;
  wrong.exitance = defects.span();
  wrong.space_exitance = dark.span();
  Convergence convergence;
  const Status status =
      gauss_seidel(matrix, wrong, kRoughly, executor, nullptr, &made, &gathered, &convergence);
  if (status.code() == StatusCode::kOutOfMemory)
    return status;
  if (!status.ok() && status.code() != StatusCode::kNotConverged)
    made.swap(defects); // nothing that could be solved: what is gathered directly
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::uint32_t b = 0; b < bands; ++b) {
      const std::size_t at = i * bands + b;
      squares += problem.area[i] * made[at] * made[at];
      all += problem.area[i] * radiosity[at] * radiosity[at];
    }
  *error = all > 0 ? std::sqrt(squares / all) : 0;
  return {};
}

} // namespace hemicube::radiosity
