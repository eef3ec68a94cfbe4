#include "radiosity/balance_rows.h"
#include "radiosity/dial.h"
#include "radiosity/light_model.h"
#include "radiosity/radiosity.h"
#include "radiosity/row_run.h"
#include "radiosity/row_statistics.h"
#include "radiosity/solve/gauss_seidel.h"
#include "raster/fp_environment.h"
#include "raster/hash.h"

#include <limits>

namespace hemicube::radiosity {
namespace {

constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

/// Passes sweeps on to the caller's Progress.
class SweepsToProgress final : public SolverProgress {
public:
  explicit SweepsToProgress(Progress* progress) : progress_(progress) {}
  bool swept(std::uint64_t sweeps, double error) noexcept override {
    return progress_ == nullptr || progress_->sweeps(sweeps, error);
  }

private:
  Progress* progress_;
};

/// One solve from beginning to end; the steps in the order they are called.
class SceneSolver {
public:
  SceneSolver(const Scene& scene, const PatchSet& patches, const Options& options,
              Executor& executor, Progress* progress)
      : scene_(scene), patches_(patches), options_(options), executor_(executor),
        progress_(progress), dial_(&geometry_, &problem_, options, executor) {}

  Status prepare();
  Status choose_setting();
  Status build_matrix(Certificate* certificate);
  Status solve(Certificate* certificate);
  /// @param is_enough  false if a finer setting was chosen: matrix and light are to be made again
  Status estimate_error(Certificate* certificate, bool* is_enough);
  Status gather_black_irradiance();
  Status fill(Solution* solution, Certificate* certificate);

private:
  void balance_energy(const Solution& solution, Certificate* certificate) const;

  const Scene& scene_;
  const PatchSet& patches_;
  const Options& options_;
  Executor& executor_;
  Progress* progress_;

  LightModel light_;
  LightProblem problem_;
  Buffer<double> light_guess_; ///< [patch] all bands together
  RowGeometry geometry_;
  RungSetting setting_;
  Dial dial_;
  RowRun run_;
  RowStatistics statistics_;
  FormFactorMatrix matrix_;
  Buffer<double> radiosity_, irradiance_; ///< [patch][band of the problem]
};

Status SceneSolver::prepare() {
  HC_TRY(light_.init(scene_, patches_));
  problem_ = light_.problem(patches_);
  return geometry_.init(patches_);
}

Status SceneSolver::choose_setting() {
  setting_ = {options_.rung, options_.resolution, options_.error};
  if (options_.estimate_error) {
    Buffer<double> light;
    const std::uint32_t bands = problem_.band_count;
    HC_TRY(guess_light(problem_, &light));
    HC_TRY(light_guess_.resize(patches_.patch_count()));
    for (std::size_t k = 0; k < light.size(); ++k)
      light_guess_[k / bands] += light[k];
  }
  return dial_.choose(&setting_);
}

Status SceneSolver::build_matrix(Certificate* certificate) {
  const std::uint32_t count = patches_.patch_count();
  std::uint64_t rows = count;
  if (!options_.black_irradiance && !options_.balance)
    for (std::uint32_t i = 0; i < count; ++i)
      rows -= problem_.is_black(i) ? 1 : 0;
  HC_TRY(
      run_.init(&geometry_, setting_, options_, rows, executor_, progress_, light_guess_.span()));
  HC_TRY(statistics_.init(count, options_.hash_items));
  HC_TRY(matrix_.init(count, count));
  HC_TRY(run_.build_all(
      patches_.patch_count(),
      [&](std::uint32_t i) { return options_.balance || !problem_.is_black(i); },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        if (facts != nullptr)
          statistics_.record(i, row, *facts);
        return matrix_.append_row(i / FormFactorMatrix::kBlockRows, row);
      }));
  return options_.balance
             ? balance_rows(patches_, executor_, progress_, &matrix_, &statistics_, certificate)
             : Status();
}

Status SceneSolver::solve(Certificate* certificate) {
  certificate->has_reciprocity = true;
  HC_TRY(measure_reciprocity(matrix_, patches_.area.span(), executor_, &certificate->reciprocity));
  SweepsToProgress progress(progress_);
  Convergence convergence;
  const Status status = gauss_seidel(matrix_, problem_, {options_.tolerance, options_.max_sweeps},
                                     executor_, &progress, &radiosity_, &irradiance_, &convergence);
  certificate->solved = status.ok() || status.code() == StatusCode::kNotConverged;
  certificate->residual = convergence.residual;
  certificate->estimated_error = convergence.estimated_error;
  certificate->sweeps = convergence.sweeps;
  certificate->converged = convergence.converged;
  certificate->rounding_floor = convergence.rounding_floor;
  return status;
}

Status SceneSolver::estimate_error(Certificate* certificate, bool* is_enough) {
  *is_enough = true;
  if (!options_.estimate_error || setting_.rung == Rung::kExact)
    return {};
  RowSample sample;
  Buffer<double> doubt;
  HC_TRY(doubt.resize(patches_.patch_count()));
  for (std::uint32_t i = 0; i < patches_.patch_count(); ++i)
    doubt[i] = problem_.is_black(i) ? 0 : statistics_.doubt(i);
  HC_TRY(choose_sample(problem_, radiosity_.span(), doubt.span(), &sample));
  HC_TRY(compute_exact_rows(&geometry_, setting_, options_, executor_, &sample));
  Certificate& c = *certificate;
  HC_TRY(estimate_radiosity_error(sample, matrix_, problem_, radiosity_.span(), executor_,
                                  &c.radiosity_error));
  c.has_radiosity_error = true;
  c.form_factor_error =
      sample.form_factor_error([&](std::size_t k) { return matrix_.row(sample.patches()[k]); });
  c.has_form_factor_error = true;
  if (!options_.choose_rung || c.radiosity_error <= options_.error)
    return {};
  bool is_finer = false;
  HC_TRY(dial_.choose_finer(c.radiosity_error, &setting_, &is_finer));
  *is_enough = !is_finer;
  return {};
}

Status SceneSolver::gather_black_irradiance() {
  const std::uint32_t bands = light_.band_count;
  const auto gather = [&](std::uint64_t i, const RowView& row, bool is_wanted) {
    for (std::uint32_t b = 0; b < bands && problem_.is_black(i); ++b)
      irradiance_[i * bands + b] = is_wanted ? row_dot(row, radiosity_.data() + b, bands) +
                                                   row.space * problem_.space_exitance[b]
                                             : kNotComputed;
  };
  if (options_.balance) // all rows are there
    return executor_.for_each(matrix_.block_count(), [&](std::size_t block, std::size_t) {
      const FloatEnvironment environment;
      for (std::uint64_t i = matrix_.block_begin(block); i < matrix_.block_end(block); ++i)
        gather(i, matrix_.row(i), options_.black_irradiance);
      return Status();
    });
  return run_.build_all(
      patches_.patch_count(),
      [&](std::uint32_t i) { return options_.black_irradiance && problem_.is_black(i); },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        if (facts != nullptr)
          statistics_.record(i, row, *facts);
        gather(i, row, facts != nullptr);
        return Status();
      });
}

Status SceneSolver::fill(Solution* solution, Certificate* certificate) {
  const std::uint32_t count = patches_.patch_count(), bands = scene_.band_count();
  Solution& s = *solution;
  s.band_count = bands;
  for (Buffer<double>* values : {&s.reflectance, &s.exitance, &s.irradiance, &s.radiosity})
    HC_TRY(values->resize(std::size_t{count} * bands));
  for (Buffer<double>* values : {&s.row_sum, &s.space, &s.back_side})
    HC_TRY(values->resize(count));
  Hash radiosity_hash;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t b = 0; b < bands; ++b) {
      const std::size_t from = std::size_t{i} * light_.band_count + light_.solved_band[b];
      const std::size_t to = std::size_t{i} * bands + b;
      s.reflectance[to] = light_.reflectance[from];
      s.exitance[to] = light_.exitance[from];
      s.irradiance[to] = irradiance_[from];
      s.radiosity[to] = radiosity_[from];
      radiosity_hash.add(radiosity_[from]);
    }
    s.row_sum[i] = statistics_.sum(i);
    s.space[i] = statistics_.space(i);
    s.back_side[i] = statistics_.back_side(i);
  }
  certificate->patches = count;
  certificate->setting = setting_;
  statistics_.summarise(certificate);
  certificate->scene_hash = hash_scene(scene_, patches_);
  certificate->radiosity_hash = radiosity_hash.value();
  for (const double irradiance : irradiance_)
    if (irradiance != irradiance)
      return {}; // without the irradiance of black patches there is no balance
  HC_TRY(certificate->energy.resize(bands));
  balance_energy(s, certificate);
  return {};
}

void SceneSolver::balance_energy(const Solution& s, Certificate* certificate) const {
  for (std::uint32_t b = 0; b < s.band_count; ++b) {
    EnergyBalance energy;
    for (std::uint32_t i = 0; i < patches_.patch_count(); ++i) {
      const double area = patches_.area[i];
      const std::size_t at = std::size_t{i} * s.band_count + b;
      energy.emitted += area * (s.exitance[at] + s.space[i] * scene_.space_exitance[b]);
      energy.absorbed += area * (1 - s.reflectance[at]) * s.irradiance[at];
      energy.back_side += area * s.back_side[i] * s.radiosity[at];
      energy.escaped += area * s.space[i] * s.radiosity[at];
    }
    if (energy.emitted > 0)
      energy.imbalance =
          (energy.emitted - energy.absorbed - energy.back_side - energy.escaped) / energy.emitted;
    certificate->energy[b] = energy;
  }
}

} // namespace

Status solve_scene(const Scene& scene, const PatchSet& patches, const Options& options,
                   Executor& executor, Progress* progress, Solution* solution,
                   Certificate* certificate) {
  const FloatEnvironment environment;
  *certificate = {};
  SceneSolver solver(scene, patches, options, executor, progress);
  HC_TRY(solver.prepare());
  HC_TRY(solver.choose_setting());
  Status solved;
  for (bool is_enough = false; !is_enough;) {
    HC_TRY(solver.build_matrix(certificate));
    solved = solver.solve(certificate);
    if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
      return solved;
    HC_TRY(solver.estimate_error(certificate, &is_enough));
  }
  HC_TRY(solver.gather_black_irradiance());
  HC_TRY(solver.fill(solution, certificate));
  return solved;
}

} // namespace hemicube::radiosity
