#include "radiosity/balance_rows.h"
#include "radiosity/dial.h"
#include "radiosity/energy_balance.h"
#include "radiosity/kept_rows.h"
#include "radiosity/light_model.h"
#include "radiosity/radiosity.h"
#include "radiosity/row_run.h"
#include "radiosity/row_statistics.h"
#include "radiosity/shoot_scene.h"
#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solve/jacobi.h"
#include "radiosity/solve/progressive.h"
#include "radiosity/solver_watch.h"
#include "raster/fp_environment.h"
#include "raster/hash.h"

#include <algorithm>
#include <limits>

namespace hemicube::radiosity {
namespace {

constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

/// One solve from beginning to end; the steps in the order they are called by run().
class SceneSolver {
public:
  SceneSolver(const Scene& scene, const PatchSet& patches, const Options& options,
              Executor& executor, Progress* progress)
      : scene_(scene), patches_(patches), options_(options), executor_(executor),
        progress_(progress), dial_(&geometry_, &problem_, options, executor),
        watch_(scene, patches, light_, options, progress) {}

  /// Instead of rows that are computed, or kept in files. @param rows  outlives this
  void give_rows(FormFactorMatrix* rows, const RungSetting& setting) {
    given_rows_ = rows;
    setting_ = setting;
  }
  Status run(Solution* solution, Certificate* certificate);

private:
  Status prepare();
  Status choose_setting();
  Status build_matrix(Certificate* certificate);
  Status solve(Certificate* certificate);
  /// Instead of the two: light without a matrix.
  bool shoots() const { return options_.solver == SolverKind::kProgressive && !has_black_rows(); }
  Status shoot(Certificate* certificate);
  /// @param is_enough  false if a finer setting was chosen: matrix and light are to be made again
  Status estimate_error(Certificate* certificate, bool* is_enough);
  Status gather_black_irradiance();
  Status fill(Solution* solution, Certificate* certificate);

  /// True if nothing is rendered for the solution.
  bool rows_are_given() const { return given_rows_ != nullptr || kept_.are_given(); }
  /// True if the matrix has the rows of black patches, too.
  bool has_black_rows() const {
    return options_.balance || kept_.hold_black_rows() || rows_are_given();
  }
  Status take_given_rows();
  Status balance_if_asked(Certificate* certificate);
  FormFactorMatrix& matrix() { return given_rows_ != nullptr ? *given_rows_ : own_rows_; }
  void gather_black(std::uint64_t i, const RowView& row);
  Status gather_black_rows_of(const FormFactorMatrix& rows, std::size_t blocks);
  void record(const Status& status, const Convergence& convergence, Certificate* certificate);

  const Scene& scene_;
  const PatchSet& patches_;
  const Options& options_;
  Executor& executor_;
  Progress* progress_;

  LightModel light_;
  LightProblem problem_;
  Buffer<double> light_guess_; ///< [patch] all bands together
  KeptRows kept_;
  FormFactorMatrix* given_rows_ = nullptr; ///< null: none but those of a file
  RowGeometry geometry_;
  RungSetting setting_;
  Buffer<double> found_; ///< errors for which finer settings were chosen, by round
  Dial dial_;
  RowRun run_;
  RowStatistics statistics_;
  FormFactorMatrix own_rows_;
  SolverWatch watch_;
  Buffer<EnergyBalance> shot_energy_;     ///< [band of the problem] of shoot()
  Buffer<double> radiosity_, irradiance_; ///< [patch][band of the problem]
};

Status SceneSolver::run(Solution* solution, Certificate* certificate) {
  *certificate = {};
  HC_TRY(prepare());
  HC_TRY(choose_setting());
  Status solved;
  if (shoots()) {
    solved = shoot(certificate);
    if (!certificate->solved)
      return solved;
    HC_TRY(fill(solution, certificate));
    return solved;
  }
  for (bool is_enough = false; !is_enough;) {
    HC_TRY(build_matrix(certificate));
    solved = solve(certificate);
    if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
      return solved;
    HC_TRY(estimate_error(certificate, &is_enough));
  }
  HC_TRY(gather_black_irradiance());
  HC_TRY(fill(solution, certificate));
  return solved;
}

Status SceneSolver::prepare() {
  HC_TRY(light_.init(scene_, patches_));
  problem_ = light_.problem(patches_);
  kept_.init(patches_, options_, hash_scene(scene_, patches_));
  return kept_.are_given() ? Status() : geometry_.init(patches_);
}

Status SceneSolver::choose_setting() {
  if (rows_are_given())
    return {};
  setting_ = {options_.rung, options_.resolution, options_.error};
  if (options_.estimate_error)
    HC_TRY(guess_patch_light(problem_, &light_guess_));
  HC_TRY(dial_.choose(&setting_));
  HC_TRY(kept_.past_rounds(&found_));
  bool is_finer = true;
  for (const double found : found_)
    HC_TRY(dial_.choose_finer(found, &setting_, &is_finer));
  return {};
}

Status SceneSolver::take_given_rows() {
  HC_TRY(statistics_.init(patches_.patch_count(), options_.hash_items));
  if (given_rows_ == nullptr)
    HC_TRY(kept_.read_given(&own_rows_, &setting_));
  return statistics_.record_rows(matrix(), matrix().row_count());
}

Status SceneSolver::balance_if_asked(Certificate* certificate) {
  return options_.balance
             ? balance_rows(patches_, executor_, progress_, &matrix(), &statistics_, certificate)
             : Status();
}

Status SceneSolver::build_matrix(Certificate* certificate) {
  if (rows_are_given()) {
    HC_TRY(take_given_rows());
    return balance_if_asked(certificate);
  }
  const std::uint32_t count = patches_.patch_count();
  const auto is_wanted = [&](std::uint32_t i) { return has_black_rows() || !problem_.is_black(i); };
  std::uint64_t rows = count;
  if (!options_.black_irradiance && !has_black_rows())
    for (std::uint32_t i = 0; i < count; ++i)
      rows -= problem_.is_black(i) ? 1 : 0;
  HC_TRY(
      run_.init(&geometry_, setting_, options_, rows, executor_, progress_, light_guess_.span()));
  HC_TRY(statistics_.init(count, options_.hash_items));
  kept_.begin_round(setting_, found_.span());
  RowStorage pairs;
  std::uint64_t first = 0;
  HC_TRY(kept_.begin_matrix(KeptRows::Part::kRows, &own_rows_, &first));
  HC_TRY(statistics_.record_rows(own_rows_, first));
  HC_TRY(kept_.open(KeptRows::Part::kPairs, &pairs));
  run_.keep_pairs(pairs);
  for (std::uint32_t i = 0; i < first; ++i)
    run_.count_kept(is_wanted(i) ? 1 : 0);
  const Status built = run_.build_all(
      count, is_wanted,
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        if (facts != nullptr)
          statistics_.record(i, row, *facts);
        return own_rows_.append_row(i / FormFactorMatrix::kBlockRows, row,
                                    facts != nullptr ? *facts : RowFacts());
      },
      first);
  kept_.report(std::max(first, run_.pair_rows_kept()));
  if (!built.ok())
    own_rows_.flush_if_due();
  HC_TRY(built);
  HC_TRY(kept_.finish(&own_rows_));
  return balance_if_asked(certificate);
}

Status SceneSolver::solve(Certificate* certificate) {
  certificate->has_reciprocity = true;
  Buffer<std::uint8_t> is_black;
  HC_TRY(is_black.resize(patches_.patch_count()));
  for (std::uint32_t i = 0; i < patches_.patch_count(); ++i)
    is_black[i] = !options_.balance && problem_.is_black(i); // without a row, or as if without
  HC_TRY(measure_reciprocity(matrix(), patches_.area.span(), executor_, &certificate->reciprocity,
                             is_black.span()));
  const SolverOptions options = {options_.tolerance, options_.max_sweeps, options_.kernels,
                                 options_.stop_unshot, options_.max_shots};
  Convergence convergence;
  const auto run = options_.solver == SolverKind::kGaussSeidel ? gauss_seidel
                   : options_.solver == SolverKind::kJacobi    ? jacobi
                                                               : progressive;
  const Status status = watch_.outcome(run(matrix(), problem_, options, executor_, &watch_,
                                           &radiosity_, &irradiance_, &convergence));
  certificate->has_residual = true;
  record(status, convergence, certificate);
  return status;
}

void SceneSolver::record(const Status& status, const Convergence& convergence,
                         Certificate* certificate) {
  certificate->solved = status.ok() || status.code() == StatusCode::kNotConverged;
  certificate->solver = solver_name(options_.solver);
  certificate->residual = convergence.residual;
  certificate->estimated_error = convergence.estimated_error;
  certificate->sweeps = convergence.sweeps;
  certificate->converged = convergence.converged;
  certificate->rounding_floor = convergence.rounding_floor;
  certificate->has_shots = options_.solver == SolverKind::kProgressive;
  certificate->shots = convergence.shots;
  certificate->unshot = convergence.unshot;
  certificate->unshot_bound = convergence.unshot_bound;
}

Status SceneSolver::shoot(Certificate* certificate) {
  HC_TRY(statistics_.init(patches_.patch_count(), options_.hash_items));
  SceneShooter shooter(problem_);
  const Status status =
      watch_.outcome(shooter.run(&geometry_, setting_, options_, executor_, &watch_, &statistics_));
  record(status, shooter.convergence(), certificate);
  if (!certificate->solved)
    return status;
  radiosity_.swap(shooter.light().radiosity());
  irradiance_.swap(shooter.light().irradiance());
  HC_TRY(shot_energy_.resize(problem_.band_count));
  for (std::uint32_t b = 0; b < problem_.band_count; ++b)
    shot_energy_[b] = shooter.energy(b);
  for (std::size_t at = 0; at < irradiance_.size() && !options_.black_irradiance; ++at)
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): no bands, no irradiance
    if (problem_.is_black(at / problem_.band_count))
      irradiance_[at] = kNotComputed;
  if (options_.estimate_error && setting_.rung != Rung::kExact) {
    RowSample sample;
    FormFactorMatrix rows;
    HC_TRY(sample.choose(patches_.patch_count(), kErrorSampleRows));
    HC_TRY(compute_sampled_rows(&geometry_, setting_, options_, executor_, sample.patches(), &rows,
                                nullptr));
    HC_TRY(compute_exact_rows(&geometry_, setting_, options_, executor_, &sample));
    certificate->form_factor_error =
        sample.form_factor_error([&](std::size_t k) { return rows.row(k); });
    certificate->has_form_factor_error = true;
  }
  return status;
}

Status SceneSolver::estimate_error(Certificate* certificate, bool* is_enough) {
  *is_enough = true;
  // To judge rows of a file, others would have to be rendered.
  if (!options_.estimate_error || setting_.rung == Rung::kExact || kept_.are_given())
    return {};
  RowSample sample;
  Buffer<double> doubt;
  HC_TRY(doubt.resize(patches_.patch_count()));
  for (std::uint32_t i = 0; i < patches_.patch_count(); ++i)
    doubt[i] = problem_.is_black(i) ? 0 : statistics_.doubt(i);
  HC_TRY(choose_sample(problem_, radiosity_.span(), doubt.span(), &sample));
  HC_TRY(compute_exact_rows(&geometry_, setting_, options_, executor_, &sample));
  Certificate& c = *certificate;
  HC_TRY(estimate_radiosity_error(sample, matrix(), problem_, radiosity_.span(), executor_,
                                  &c.radiosity_error));
  c.has_radiosity_error = true;
  FormFactorMatrix rows;
  HC_TRY(rows.copy_rows(matrix(), sample.patches()));
  c.form_factor_error = sample.form_factor_error([&](std::size_t k) { return rows.row(k); });
  c.has_form_factor_error = true;
  if (rows_are_given() || !options_.choose_rung || c.radiosity_error <= options_.error)
    return {};
  bool is_finer = false;
  HC_TRY(dial_.choose_finer(c.radiosity_error, &setting_, &is_finer));
  if (is_finer)
    HC_TRY(found_.push_back(c.radiosity_error));
  *is_enough = !is_finer;
  return {};
}

void SceneSolver::gather_black(std::uint64_t i, const RowView& row) {
  const std::uint32_t bands = light_.band_count;
  for (std::uint32_t b = 0; b < bands; ++b)
    irradiance_[i * bands + b] =
        row_dot(row, radiosity_.data() + b, bands) + row.space * problem_.space_exitance[b];
}

Status SceneSolver::gather_black_irradiance() {
  if (!options_.black_irradiance) {
    for (std::size_t at = 0; at < irradiance_.size(); ++at)
      if (problem_.is_black(at / light_.band_count))
        irradiance_[at] = kNotComputed;
    return {};
  }
  if (has_black_rows())
    return gather_black_rows_of(matrix(), matrix().block_count());
  // Rows that are used once and dropped, or kept where there is a file for them.
  FormFactorMatrix black_rows;
  std::uint64_t first = 0;
  const bool are_kept = options_.files != nullptr && options_.files->black_rows != nullptr;
  if (are_kept) {
    HC_TRY(kept_.begin_matrix(KeptRows::Part::kBlackRows, &black_rows, &first));
    HC_TRY(statistics_.record_rows(black_rows, first));
    HC_TRY(gather_black_rows_of(black_rows, (first + FormFactorMatrix::kBlockRows - 1) /
                                                FormFactorMatrix::kBlockRows));
    for (std::uint32_t i = 0; i < first; ++i)
      run_.count_kept(problem_.is_black(i) ? 1 : 0);
  }
  const Status built = run_.build_all(
      patches_.patch_count(), [&](std::uint32_t i) { return problem_.is_black(i); },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        if (facts != nullptr) {
          statistics_.record(i, row, *facts);
          gather_black(i, row);
        }
        return are_kept ? black_rows.append_row(i / FormFactorMatrix::kBlockRows, row,
                                                facts != nullptr ? *facts : RowFacts())
                        : Status();
      },
      first);
  if (!built.ok() && are_kept)
    black_rows.flush_if_due();
  return built;
}

Status SceneSolver::gather_black_rows_of(const FormFactorMatrix& rows, std::size_t blocks) {
  return rows.for_each_range(0, blocks, [&](std::size_t first, std::size_t last) {
    return executor_.for_each(last - first, [&](std::size_t block, std::size_t) {
      const FloatEnvironment environment;
      for (std::uint64_t i = rows.block_begin(first + block); i < rows.block_end(first + block);
           ++i)
        if (problem_.is_black(i))
          gather_black(i, rows.row(i));
      return Status();
    });
  });
}

Status SceneSolver::fill(Solution* solution, Certificate* certificate) {
  const std::uint32_t count = patches_.patch_count(), bands = scene_.band_count();
  Solution& s = *solution;
  HC_TRY(fill_light(light_, bands, radiosity_.span(), watch_.ambient(), solution));
  HC_TRY(s.irradiance.resize(std::size_t{count} * bands));
  for (Buffer<double>* values : {&s.row_sum, &s.space, &s.back_side})
    HC_TRY(values->resize(count));
  Hash radiosity_hash;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t b = 0; b < bands; ++b) {
      const std::size_t from = std::size_t{i} * light_.band_count + light_.solved_band[b];
      const std::size_t to = std::size_t{i} * bands + b;
      s.irradiance[to] = irradiance_[from];
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
  if (shot_energy_.empty())
    balance_energy(scene_, patches_, s, certificate->energy.span());
  for (std::uint32_t b = 0; b < bands && !shot_energy_.empty(); ++b)
    certificate->energy[b] = shot_energy_[light_.solved_band[b]];
  return {};
}

} // namespace

const char* solver_name(SolverKind solver) noexcept {
  return solver == SolverKind::kGaussSeidel ? "gauss-seidel"
         : solver == SolverKind::kJacobi    ? "jacobi"
                                            : "progressive";
}

Status solve_scene(const Scene& scene, const PatchSet& patches, const Options& options,
                   Executor& executor, Progress* progress, Solution* solution,
                   Certificate* certificate) {
  const FloatEnvironment environment;
  SceneSolver solver(scene, patches, options, executor, progress);
  return solver.run(solution, certificate);
}

Status solve_rows(const Scene& scene, const PatchSet& patches, const RungSetting& setting,
                  FormFactorMatrix* rows, const Options& options, Executor& executor,
                  Progress* progress, Solution* solution, Certificate* certificate) {
  const FloatEnvironment environment;
  SceneSolver solver(scene, patches, options, executor, progress);
  solver.give_rows(rows, setting);
  return solver.run(solution, certificate);
}

} // namespace hemicube::radiosity
