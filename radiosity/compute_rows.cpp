#include "radiosity/balance_rows.h"
#include "radiosity/dial.h"
#include "radiosity/radiosity.h"
#include "radiosity/row_run.h"
#include "radiosity/row_statistics.h"
#include "raster/fp_environment.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// What there are rows of: every patch in order, some patches, or points.
enum class Receivers { kAllPatches, kSomePatches, kPoints };

/// Rows of any receivers into a matrix, row k at place_of(k).
template <typename PlaceOf>
Status compute_rows(const PatchSet& patches, std::uint64_t count, Receivers receivers,
                    PlaceOf place_of, const Options& options, Executor& executor,
                    Progress* progress, FormFactorMatrix* matrix, Certificate* certificate) {
  const FloatEnvironment environment;
  RowGeometry geometry;
  RungSetting setting{options.rung, options.resolution, options.error};
  HC_TRY(geometry.init(patches));
  Dial dial(&geometry, nullptr, options, executor);
  const bool is_all = receivers == Receivers::kAllPatches;
  if (receivers != Receivers::kPoints)
    HC_TRY(dial.choose(&setting));
  else if (options.choose_rung) // exact at points
    setting.rung = Rung::kAdaptive;
  RowRun run;
  RowStatistics statistics;
  HC_TRY(run.init(&geometry, setting, options, count, executor, progress));
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
  if (options.balance)
    HC_TRY(balance_rows(patches, executor, progress, matrix, &statistics, certificate));
  certificate->patches = patches.patch_count();
  certificate->setting = setting;
  if (is_all && options.estimate_error && setting.rung != Rung::kExact) {
    RowSample sample;
    HC_TRY(sample.choose(patches.patch_count(), kErrorSampleRows));
    HC_TRY(compute_exact_rows(&geometry, setting, options, executor, &sample));
    certificate->form_factor_error =
        sample.form_factor_error([&](std::size_t k) { return matrix->row(sample.patches()[k]); });
    certificate->has_form_factor_error = true;
  }
  statistics.summarise(certificate);
  return {};
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
  const auto patch_of = [&](std::uint64_t k) {
    return rows.empty() ? static_cast<std::uint32_t>(k) : rows[k];
  };
  HC_TRY(compute_rows(
      patches, rows.empty() ? patches.patch_count() : rows.size(),
      rows.empty() ? Receivers::kAllPatches : Receivers::kSomePatches,
      [&](std::uint64_t k) { return RowPlace{patch_of(k)}; }, options, executor, progress, matrix,
      certificate));
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
  return compute_rows(
      patches, points.size(), Receivers::kPoints,
      [&](std::uint64_t k) {
        return RowPlace{RowPlace::kNoPatch, points[k].position, points[k].normal};
      },
      options, executor, progress, matrix, certificate);
}

} // namespace hemicube::radiosity
