#include "radiosity/radiosity.h"

#include "radiosity/light_model.h"
#include "radiosity/row_run.h"
#include "radiosity/solve/gauss_seidel.h"
#include "raster/fp_environment.h"
#include "raster/hash.h"

#include <cmath>
#include <limits>

namespace hemicube::radiosity {
namespace {

constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

/// What the certificate says about rows, gathered while they are built: one entry per row, written
/// by one worker.
class RowStatistics {
public:
  Status init(std::uint64_t rows, bool hash_items) {
    hash_items_ = hash_items;
    return rows_.resize(rows, {kNotComputed, 0, 0, 0, {}, 0});
  }

  void record(std::uint64_t index, const RowView& row, const RowFacts& facts) {
    rows_[index] = {row_sum(row), row.space, row.back_side, hash_row(row), facts,
                    row.columns.size()};
  }

  double sum(std::uint64_t index) const { return rows_[index].sum; }
  double space(std::uint64_t index) const { return rows_[index].space; }
  double back_side(std::uint64_t index) const { return rows_[index].back_side; }

  void summarise(Certificate* certificate) const {
    Hash rows_hash, items_hash;
    Certificate& c = *certificate;
    std::uint64_t seen = 0;
    for (std::uint64_t i = 0; i < rows_.size(); ++i) {
      const Entry& row = rows_[i];
      if (row.sum != row.sum)
        continue;
      const bool first = seen++ == 0;
      rows_hash.add(row.hash);
      items_hash.add(row.facts.item_hash);
      c.nonzeros += row.nonzeros;
      c.hemicubes += row.facts.hemicubes;
      c.subpixel_patches += row.facts.subpixel_patches;
      extend(row.facts.raw_sum, first, &c.row_sum_raw);
      extend(row.sum, first, &c.row_sum);
      extend(row.space, i, first, &c.space);
      extend(row.back_side, i, first, &c.back_side);
    }
    if (seen != 0)
      for (double* mean :
           {&c.row_sum_raw.mean, &c.row_sum.mean, &c.space.mean, &c.back_side.mean})
        *mean /= static_cast<double>(seen);
    c.rows = seen;
    c.form_factor_hash = rows_hash.value();
    c.has_item_hash = hash_items_;
    c.item_hash = hash_items_ ? items_hash.value() : 0;
  }

private:
  struct Entry {
    double sum; ///< NaN: no row was built
    double space, back_side;
    std::uint64_t hash;
    RowFacts facts;
    std::uint64_t nonzeros;
  };

  static void extend(double value, bool first, Range* range) {
    range->mean += value;
    if (first || value < range->min)
      range->min = value;
    if (first || value > range->max)
      range->max = value;
  }
  static void extend(double value, std::uint64_t index, bool first, WorstFraction* worst) {
    worst->mean += value;
    if (first || value > worst->max) {
      worst->max = value;
      worst->worst_patch = static_cast<std::uint32_t>(index);
    }
  }

  Buffer<Entry> rows_;
  bool hash_items_ = false;
};

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
        progress_(progress) {}

  Status prepare();
  Status build_matrix();
  Status solve(Certificate* certificate);
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
  RowRun run_;
  RowStatistics statistics_;
  FormFactorMatrix matrix_;
  Buffer<double> radiosity_, irradiance_; ///< [patch][band of the problem]
};

Status SceneSolver::prepare() {
  const std::uint32_t count = patches_.patch_count();
  HC_TRY(light_.init(scene_, patches_));
  problem_ = light_.problem(patches_);
  std::uint64_t rows = count;
  if (!options_.black_irradiance)
    for (std::uint32_t i = 0; i < count; ++i)
      rows -= problem_.is_black(i) ? 1 : 0;
  HC_TRY(run_.init(patches_, options_, rows, executor_, progress_));
  HC_TRY(statistics_.init(count, options_.hash_items));
  return matrix_.init(count, count);
}

Status SceneSolver::build_matrix() {
  return run_.build_all(
      patches_.patch_count(), [&](std::uint32_t i) { return !problem_.is_black(i); },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        if (facts != nullptr)
          statistics_.record(i, row, *facts);
        return matrix_.append_row(i / FormFactorMatrix::kBlockRows, row);
      });
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

Status SceneSolver::gather_black_irradiance() {
  const std::uint32_t bands = light_.band_count;
  return run_.build_all(
      patches_.patch_count(),
      [&](std::uint32_t i) { return options_.black_irradiance && problem_.is_black(i); },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        if (facts != nullptr)
          statistics_.record(i, row, *facts);
        for (std::uint32_t b = 0; b < bands && problem_.is_black(i); ++b)
          irradiance_[i * bands + b] = facts == nullptr
                                           ? kNotComputed
                                           : row_dot(row, radiosity_.data() + b, bands) +
                                                 row.space * problem_.space_exitance[b];
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
  statistics_.summarise(certificate);
  certificate->scene_hash = hash_scene(scene_, patches_);
  certificate->radiosity_hash = radiosity_hash.value();
  if (certificate->rows < count)
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

/// Rows of any receivers into a matrix, row k at place_of(k).
/// @param is_all  row k is that of patch k, and there is one for each
template <typename PlaceOf>
Status compute_rows(const PatchSet& patches, std::uint64_t count, bool is_all, PlaceOf place_of,
                    const Options& options, Executor& executor, Progress* progress,
                    FormFactorMatrix* matrix, Certificate* certificate) {
  const FloatEnvironment environment;
  RowRun run;
  RowStatistics statistics;
  HC_TRY(run.init(patches, options, count, executor, progress));
  HC_TRY(statistics.init(count, options.hash_items));
  HC_TRY(matrix->init(count, patches.patch_count()));
  const auto take = [&](std::uint64_t k, const RowView& row, const RowFacts* facts) {
    statistics.record(k, row, *facts);
    return matrix->append_row(k / FormFactorMatrix::kBlockRows, row);
  };
  const auto place = [&](std::uint64_t k, RowPlace* at) {
    *at = place_of(k);
    return true;
  };
  HC_TRY(is_all ? run.build_all(
                      patches.patch_count(), [](std::uint32_t) { return true; }, take)
                : run.build(count, place, take));
  *certificate = {};
  certificate->patches = patches.patch_count();
  statistics.summarise(certificate);
  return {};
}

} // namespace

Status solve_scene(const Scene& scene, const PatchSet& patches, const Options& options,
                   Executor& executor, Progress* progress, Solution* solution,
                   Certificate* certificate) {
  const FloatEnvironment environment;
  *certificate = {};
  SceneSolver solver(scene, patches, options, executor, progress);
  HC_TRY(solver.prepare());
  HC_TRY(solver.build_matrix());
  const Status solved = solver.solve(certificate);
  if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
    return solved;
  HC_TRY(solver.gather_black_irradiance());
  HC_TRY(solver.fill(solution, certificate));
  return solved;
}

Status compute_form_factors(const PatchSet& patches, std::span<const std::uint32_t> rows,
                            const Options& options, Executor& executor, Progress* progress,
                            FormFactorMatrix* matrix, Certificate* certificate) {
  for (const std::uint32_t row : rows)
    if (row >= patches.patch_count())
      return Status::error(StatusCode::kInvalidArgument, "row ", row, " does not exist: there are ",
                           patches.patch_count(), " patches, counted from 0");
  const auto patch_of = [&](std::uint64_t k) {
    return rows.empty() ? static_cast<std::uint32_t>(k) : rows[k];
  };
  HC_TRY(compute_rows(
      patches, rows.empty() ? patches.patch_count() : rows.size(), rows.empty(),
      [&](std::uint64_t k) { return RowPlace{patch_of(k)}; }, options, executor, progress,
      matrix, certificate));
  if (rows.empty()) {
    certificate->has_reciprocity = true;
    HC_TRY(measure_reciprocity(*matrix, patches.area.span(), executor, &certificate->reciprocity));
  }
  certificate->space.worst_patch = patch_of(certificate->space.worst_patch);
  certificate->back_side.worst_patch = patch_of(certificate->back_side.worst_patch);
  return {};
}

Status compute_point_form_factors(const PatchSet& patches, std::span<const Receiver> points,
                                  const Options& options, Executor& executor, Progress* progress,
                                  FormFactorMatrix* matrix, Certificate* certificate) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 &p = points[k].position, &n = points[k].normal;
    for (const double x : {p.x, p.y, p.z, n.x, n.y, n.z})
      if (!std::isfinite(x))
        return Status::error(StatusCode::kInvalidArgument, "point ", k, ": ", x,
                             " is not a finite number");
    if (n == Vec3(0, 0, 0))
      return Status::error(StatusCode::kInvalidArgument, "point ", k, " has no normal");
  }
  return compute_rows(
      patches, points.size(), false,
      [&](std::uint64_t k) {
        return RowPlace{RowPlace::kNoPatch, points[k].position, points[k].normal};
      },
      options, executor, progress, matrix, certificate);
}

} // namespace hemicube::radiosity
