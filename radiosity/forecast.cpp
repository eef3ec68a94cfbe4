#include "radiosity/forecast.h"

#include "radiosity/dial.h"
#include "radiosity/light_model.h"
#include "raster/fp_environment.h"

namespace hemicube::radiosity {
namespace {

constexpr std::uint32_t kRun = 16, kFirstRuns = 1, kExactRows = 16;
/// Rows that draw nothing but item buffers are cheap.
constexpr std::uint32_t kRuns = 14, kCheapRuns = 100;

/// Rows in runs of kRun that follow each other, as in the run itself, spread over all patches.
Status choose_runs(std::uint32_t patch_count, std::uint32_t runs, Buffer<std::uint32_t>* rows) {
  rows->clear();
  const std::uint64_t places = patch_count > kRun ? patch_count - kRun : 0;
  for (std::uint32_t k = 0; k < runs; ++k)
    for (std::uint32_t i = 0; i < kRun; ++i) {
      const auto row = static_cast<std::uint32_t>(places * k / runs + i);
      if (row < patch_count && (rows->empty() || row > rows->back()))
        HC_TRY(rows->push_back(row));
    }
  return {};
}

} // namespace

Status forecast(const Scene& scene, const PatchSet& patches, const Options& options,
                Executor& executor, ForecastProgress* progress, Forecast* forecast) {
  const FloatEnvironment environment;
  Forecast& f = *forecast;
  LightModel light;
  HC_TRY(light.init(scene, patches));
  const LightProblem problem = light.problem(patches);
  f = {};
  f.solved_bands = light.band_count;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    f.rows_to_store += problem.is_black(i) ? 0 : 1;
  f.rows_to_build = options.black_irradiance ? patches.patch_count() : f.rows_to_store;

  RowGeometry geometry;
  HC_TRY(geometry.init(patches));
  progress->finished(ForecastPart::kGeometry);

  f.setting = {options.rung, options.resolution, options.error};
  Dial dial(&geometry, &problem, options, executor);
  HC_TRY(dial.choose(&f.setting));
  f.shares_pairs = f.setting.rung >= Rung::kArea;
  progress->finished(ForecastPart::kChoice);

  Buffer<std::uint32_t> places;
  FormFactorMatrix rows;
  HC_TRY(choose_runs(patches.patch_count(), kFirstRuns, &places));
  HC_TRY(compute_sampled_rows(&geometry, f.setting, options, executor, places.span(), &rows));
  f.first_rows = rows.row_count();
  progress->finished(ForecastPart::kFirstRows);
  const std::uint32_t runs = f.setting.rung == Rung::kHemicube ? kCheapRuns : kRuns;
  HC_TRY(choose_runs(patches.patch_count(), runs, &places));
  HC_TRY(compute_sampled_rows(&geometry, f.setting, options, executor, places.span(), &rows));
  f.rows = rows.row_count();
  f.nonzeros = rows.nonzero_count();
  progress->finished(ForecastPart::kRows);

  if (!options.estimate_error || f.setting.rung == Rung::kExact)
    return {};
  RowSample sample;
  HC_TRY(sample.choose(patches.patch_count(), kExactRows));
  HC_TRY(compute_exact_rows(&geometry, f.setting, options, executor, &sample));
  f.exact_rows = sample.patches().size();
  f.exact_rows_to_build =
      patches.patch_count() < kErrorSampleRows ? patches.patch_count() : kErrorSampleRows;
  progress->finished(ForecastPart::kExactRows);
  return {};
}

} // namespace hemicube::radiosity
