#include "radiosity/balance_rows.h"
#include "radiosity/dial.h"
#include "radiosity/kept_rows.h"
#include "radiosity/radiosity.h"
#include "radiosity/row_run.h"
#include "radiosity/row_statistics.h"
#include "raster/fp_environment.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Rows of some patches, or of points, into a matrix, row k at place_of(k).
/// @param setting  how
template <typename PlaceOf>
Status compute_some_rows(RowGeometry* geometry, std::uint64_t count, PlaceOf place_of,
                         const RungSetting& setting, const Options& options, Executor& executor,
                         Progress* progress, FormFactorMatrix* matrix, Certificate* certificate) {
  RowRun run;
  RowStatistics statistics;
  HC_TRY(run.init(geometry, setting, options, count, executor, progress));
  HC_TRY(statistics.init(count, options.hash_items));
  HC_TRY(matrix->init(count, geometry->patches().patch_count()));
  HC_TRY(run.build(
      count,
      [&](std::uint64_t k, RowPlace* at) {
        *at = place_of(k);
        return true;
      },
      [&](std::uint64_t k, const RowView& row, const RowFacts* facts) {
        statistics.record(k, row, *facts);
        return matrix->append_row(k / FormFactorMatrix::kBlockRows, row, *facts);
      }));
  *certificate = {};
  certificate->patches = geometry->patches().patch_count();
  certificate->setting = setting;
  statistics.summarise(certificate);
  return {};
}

/// The rows of all patches that are not there yet.
Status build_missing_rows(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                          Executor& executor, Progress* progress, KeptRows* kept,
                          FormFactorMatrix* matrix, RowStatistics* statistics) {
  const std::uint32_t count = geometry->patches().patch_count();
  RowRun run;
  RowStorage pairs;
  std::uint64_t first = 0;
  HC_TRY(run.init(geometry, setting, options, count, executor, progress));
  kept->begin_round(setting, {});
  HC_TRY(kept->begin_matrix(KeptRows::Part::kRows, matrix, &first));
  HC_TRY(statistics->record_rows(*matrix, first));
  HC_TRY(kept->open(KeptRows::Part::kPairs, &pairs));
  run.keep_pairs(pairs);
  run.count_kept(first);
  const Status built = run.build_all(
      count, [](std::uint32_t) { return true; },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        statistics->record(i, row, *facts);
        return matrix->append_row(i / FormFactorMatrix::kBlockRows, row, *facts);
      },
      first);
  kept->report(std::max(first, run.pair_rows_kept()));
  if (!built.ok())
    matrix->flush_if_due();
  return built.ok() ? kept->finish(matrix) : built;
}

Status estimate_form_factor_error(RowGeometry* geometry, const RungSetting& setting,
                                  const Options& options, Executor& executor,
                                  const FormFactorMatrix& matrix, Certificate* certificate) {
  RowSample sample;
  FormFactorMatrix rows;
  HC_TRY(sample.choose(geometry->patches().patch_count(), kErrorSampleRows));
  HC_TRY(compute_exact_rows(geometry, setting, options, executor, &sample));
  HC_TRY(rows.copy_rows(matrix, sample.patches()));
  certificate->form_factor_error =
      sample.form_factor_error([&](std::size_t k) { return rows.row(k); });
  certificate->has_form_factor_error = true;
  return {};
}

Status compute_all_rows(const PatchSet& patches, const Options& options, Executor& executor,
                        Progress* progress, FormFactorMatrix* matrix, Certificate* certificate) {
  RowGeometry geometry;
  KeptRows kept;
  RowStatistics statistics;
  RungSetting setting{options.rung, options.resolution, options.error};
  *certificate = {};
  kept.init(patches, options, 0);
  HC_TRY(statistics.init(patches.patch_count(), options.hash_items));
  if (kept.are_given()) {
    HC_TRY(kept.read_given(matrix, &setting));
    HC_TRY(statistics.record_rows(*matrix, matrix->row_count()));
  } else {
    HC_TRY(geometry.init(patches));
    Dial dial(&geometry, nullptr, options, executor);
    HC_TRY(dial.choose(&setting));
    HC_TRY(build_missing_rows(&geometry, setting, options, executor, progress, &kept, matrix,
                              &statistics));
  }
  if (options.balance)
    HC_TRY(balance_rows(patches, executor, progress, matrix, &statistics, certificate));
  // To judge rows that were given, others would have to be rendered.
  if (options.estimate_error && setting.rung != Rung::kExact && !kept.are_given())
    HC_TRY(estimate_form_factor_error(&geometry, setting, options, executor, *matrix, certificate));
  certificate->patches = patches.patch_count();
  certificate->setting = setting;
  statistics.summarise(certificate);
  certificate->has_reciprocity = true;
  return measure_reciprocity(*matrix, patches.area.span(), executor, &certificate->reciprocity);
}

} // namespace

Status compute_form_factors(const PatchSet& patches, std::span<const std::uint32_t> rows,
                            const Options& options, Executor& executor, Progress* progress,
                            FormFactorMatrix* matrix, Certificate* certificate) {
  for (const std::uint32_t row : rows)
    if (row >= patches.patch_count())
      return Status::error(StatusCode::kInvalidArgument, "row ", row, " does not exist: there are ",
                           patches.patch_count(), " patches, counted from 0");
  if (options.balance && !rows.empty())
    return Status::error(StatusCode::kInvalidArgument, "some rows alone cannot be balanced: ",
                         "balance needs those of all patches");
  const FloatEnvironment environment;
  if (rows.empty())
    return compute_all_rows(patches, options, executor, progress, matrix, certificate);
  RowGeometry geometry;
  RungSetting setting{options.rung, options.resolution, options.error};
  HC_TRY(geometry.init(patches));
  Dial dial(&geometry, nullptr, options, executor);
  HC_TRY(dial.choose(&setting));
  HC_TRY(compute_some_rows(
      &geometry, rows.size(), [&](std::uint64_t k) { return RowPlace{rows[k]}; }, setting, options,
      executor, progress, matrix, certificate));
  for (WorstFraction* fraction : {&certificate->space, &certificate->back_side}) {
    fraction->worst_patch = rows[fraction->worst_patch];
    for (std::size_t k = 0; k < fraction->listed().size(); ++k)
      fraction->worst[k].patch = rows[fraction->worst[k].patch];
  }
  return {};
}

Status stream_form_factors(const PatchSet& patches, const Options& options, Executor& executor,
                           Progress* progress, RowSink* sink, Certificate* certificate) {
  if (options.balance)
    return Status::error(StatusCode::kInvalidArgument, "rows that are not kept cannot be ",
                         "balanced: balance needs those of all patches");
  const FloatEnvironment environment;
  const std::uint32_t count = patches.patch_count();
  RowGeometry geometry;
  RowRun run;
  RowStatistics statistics;
  RungSetting setting{options.rung, options.resolution, options.error};
  *certificate = {};
  HC_TRY(geometry.init(patches));
  Dial dial(&geometry, nullptr, options, executor);
  HC_TRY(dial.choose(&setting));
  HC_TRY(run.init(&geometry, setting, options, count, executor, progress));
  HC_TRY(statistics.init(count, options.hash_items));
  Mutex mutex;
  HC_TRY(run.build_all(
      count, [](std::uint32_t) { return true; },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        statistics.record(i, row, *facts);
        const MutexLock lock(mutex);
        return sink->take(i, row);
      }));
  certificate->patches = count;
  certificate->setting = setting;
  statistics.summarise(certificate);
  return {};
}

Status compute_point_form_factors(const PatchSet& patches, std::span<const Receiver> points,
                                  const Options& options, Executor& executor, Progress* progress,
                                  FormFactorMatrix* matrix, Certificate* certificate) {
  if (options.balance)
    return Status::error(StatusCode::kInvalidArgument, "rows of points cannot be balanced: ",
                         "points have no area to be reciprocal with");
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 &p = points[k].position, &n = points[k].normal;
    for (const double x : {p.x, p.y, p.z, n.x, n.y, n.z})
      if (!std::isfinite(x))
        return Status::error(StatusCode::kInvalidArgument, "point ", k, ": ", x,
                             " is not a finite number");
    if (n == Vec3(0, 0, 0))
      return Status::error(StatusCode::kInvalidArgument, "point ", k, " has no normal");
  }
  const FloatEnvironment environment;
  RowGeometry geometry;
  RungSetting setting{options.rung, options.resolution, options.error};
  if (options.choose_rung) // exact at points
    setting.rung = Rung::kAdaptive;
  HC_TRY(geometry.init(patches));
  return compute_some_rows(
      &geometry, points.size(),
      [&](std::uint64_t k) {
        return RowPlace{RowPlace::kNoPatch, points[k].position, points[k].normal};
      },
      setting, options, executor, progress, matrix, certificate);
}

} // namespace hemicube::radiosity
