#include "radiosity/error_estimate.h"

#include "radiosity/solve/gauss_seidel.h"
#include "raster/hash.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// An error need not be known to more than two digits.
constexpr SolverOptions kRoughly = {0.01, 200};

/// One of 1 and -1, the same everywhere for the same patch.
double sign_of(std::uint64_t patch) {
  Hash hash(patch);
  return (hash.value() >> 32 & 1) != 0 ? 1 : -1;
}

/// What the rows of all patches gather too much, as far as those of the sample tell. Relative to
/// what a patch reflects, errors of patches have a common mean, which all get, and differ from it
/// independently: the others get the difference of the nearest sampled patch, half of them with the
/// other sign.
/// @param defects  out, [patch][band]
Status spread_defects(const RowSample& sample, const FormFactorMatrix& matrix,
                      const LightProblem& problem, std::span<const double> radiosity,
                      std::span<double> defects) {
  const std::uint32_t bands = problem.band_count;
  const std::size_t count = problem.patch_count();
  const auto patches = sample.patches();
  const auto reflected = [&](std::size_t at) {
    const double value = radiosity[at] - problem.exitance[at];
    return value > 0 ? value : 0;
  };
  Buffer<double> products, squares, relative, typical;
  HC_TRY(products.resize(bands));
  HC_TRY(squares.resize(bands));
  HC_TRY(relative.resize(patches.size() * bands));
  HC_TRY(typical.resize(bands));
  double weights = 0;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const double weight = sample.stands_for(k) * problem.area[patches[k]];
    weights += weight;
    for (std::uint32_t b = 0; b < bands; ++b) {
      const double base = reflected(std::size_t{patches[k]} * bands + b);
      typical[b] += weight * base * base;
    }
  }
  for (double& light : typical)
    light = std::sqrt(light / weights);
  FormFactorMatrix rows;
  HC_TRY(rows.copy_rows(matrix, patches));
  for (std::size_t k = 0; k < patches.size(); ++k) {
    double* of_row = &relative[k * bands];
    sample.defect(k, rows.row(k), problem, radiosity, of_row);
    for (std::uint32_t b = 0; b < bands; ++b) {
      const double base = reflected(std::size_t{patches[k]} * bands + b);
      const double weight = sample.stands_for(k) * problem.area[patches[k]];
      products[b] += weight * base * of_row[b];
      squares[b] += weight * base * base;
      // What a dark patch has wrong may be many times its own light: its neighbours, which may be
      // bright, are not wrong by so many times theirs.
      const double scale = std::max(base, typical[b]);
      of_row[b] = scale > 0 ? of_row[b] / scale : 0;
    }
  }
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    while (nearest + 1 < patches.size() && i - patches[nearest] > patches[nearest + 1] - i &&
           i > patches[nearest])
      ++nearest;
    const double sign = patches[nearest] == i ? 1 : sign_of(i);
    for (std::uint32_t b = 0; b < bands; ++b) {
      const double mean = squares[b] > 0 ? products[b] / squares[b] : 0;
      const double apart = relative[nearest * bands + b] - mean;
      defects[i * bands + b] = reflected(i * bands + b) * (mean + sign * apart);
    }
  }
  return {};
}

} // namespace

Status guess_light(const LightProblem& p, Buffer<double>* light) {
  HC_TRY(light->resize(p.patch_count() * p.band_count));
  for (std::uint32_t b = 0; b < p.band_count; ++b) {
    double emitted = 0, absorbing = 0;
    for (std::size_t i = 0; i < p.patch_count(); ++i) {
      emitted += p.area[i] * p.exitance[i * p.band_count + b];
      absorbing += p.area[i] * (1 - p.reflectance[i * p.band_count + b]);
    }
    const double ambient = (absorbing > 0 ? emitted / absorbing : emitted) + p.space_exitance[b];
    for (std::size_t i = 0; i < p.patch_count(); ++i) {
      const std::size_t at = i * p.band_count + b;
      (*light)[at] = p.exitance[at] + p.reflectance[at] * ambient;
    }
  }
  return {};
}

Status guess_patch_light(const LightProblem& p, Buffer<double>* light) {
  Buffer<double> bands;
  HC_TRY(guess_light(p, &bands));
  light->clear();
  HC_TRY(light->resize(p.patch_count()));
  for (std::size_t k = 0; k < bands.size(); ++k)
    (*light)[k / p.band_count] += bands[k];
  return {};
}

Status choose_sample(const LightProblem& problem, std::span<const double> radiosity,
                     std::span<const double> doubt, RowSample* sample) {
  const std::uint32_t bands = problem.band_count;
  const std::size_t count = problem.patch_count();
  Buffer<double> reflecting, doubtful;
  HC_TRY(reflecting.resize(count));
  HC_TRY(doubtful.resize(count));
  double all_reflecting = 0, all_doubtful = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double reflectance = 0;
    for (std::uint32_t b = 0; b < bands; ++b) {
      const std::size_t at = i * bands + b;
      const double reflected = radiosity[at] - problem.exitance[at];
      reflecting[i] += problem.area[i] * reflected * reflected;
      reflectance += problem.reflectance[at];
    }
    doubtful[i] = problem.area[i] * reflectance * reflectance * doubt[i] * doubt[i];
    all_reflecting += reflecting[i];
    all_doubtful += doubtful[i];
  }
  for (std::size_t i = 0; i < count; ++i)
    reflecting[i] = (all_reflecting > 0 ? reflecting[i] / all_reflecting : 0) +
                    (all_doubtful > 0 ? doubtful[i] / all_doubtful : 0);
  return sample->choose(static_cast<std::uint32_t>(count), kErrorSampleRows, reflecting.span());
}

Status compute_sampled_rows(RowGeometry* geometry, const RungSetting& setting,
                            const Options& options, Executor& executor,
                            std::span<const std::uint32_t> patches, FormFactorMatrix* rows,
                            std::uint64_t* work) {
  Options quiet = options;
  quiet.hash_items = false;
  RowRun run;
  HC_TRY(run.init(geometry, setting, quiet, patches.size(), executor, nullptr));
  HC_TRY(rows->init(patches.size(), geometry->patches().patch_count()));
  Buffer<std::uint64_t> work_of_row;
  HC_TRY(work_of_row.resize(patches.size()));
  HC_TRY(run.build(
      patches.size(),
      [&](std::uint64_t k, RowPlace* place) {
        place->patch = patches[k];
        return true;
      },
      [&](std::uint64_t k, const RowView& row, const RowFacts* facts) {
        work_of_row[k] = facts->work;
        return rows->append_row(k / FormFactorMatrix::kBlockRows, row);
      }));
  if (work != nullptr)
    for (const std::uint64_t of_row : work_of_row)
      *work += of_row;
  return {};
}

Status compute_exact_rows(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                          Executor& executor, RowSample* sample) {
  RungSetting finer = setting;
  finer.rung = Rung::kAdaptive;
  finer.target = setting.rung == Rung::kAdaptive ? setting.target / 10 : 0.03;
  return compute_sampled_rows(geometry, finer, options, executor, sample->patches(),
                              &sample->exact);
}

Status estimate_radiosity_error(const RowSample& sample, const FormFactorMatrix& matrix,
                                const LightProblem& problem, std::span<const double> radiosity,
                                Executor& executor, double* error) {
  const std::uint32_t bands = problem.band_count;
  const std::size_t count = problem.patch_count();
  Buffer<double> defects, made, gathered;
  HC_TRY(defects.resize(count * bands));
  HC_TRY(spread_defects(sample, matrix, problem, radiosity, defects.span()));
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
