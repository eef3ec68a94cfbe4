#include "radiosity/forecast.h"

#include "radiosity/dial.h"
#include "radiosity/light_model.h"
#include "raster/fp_environment.h"

namespace hemicube::radiosity {
namespace {

constexpr std::uint32_t kRows = 64, kExactRows = 16;

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

  RowSample sample;
  FormFactorMatrix rows;
  HC_TRY(sample.choose(patches.patch_count(), kRows));
  HC_TRY(compute_sampled_rows(&geometry, f.setting, options, executor, sample.patches(), &rows));
  f.rows = rows.row_count();
  f.nonzeros = rows.nonzero_count();
  progress->finished(ForecastPart::kRows);

  if (!options.estimate_error || f.setting.rung == Rung::kExact)
    return {};
  HC_TRY(sample.choose(patches.patch_count(), kExactRows));
  HC_TRY(compute_exact_rows(&geometry, f.setting, options, executor, &sample));
  f.exact_rows = sample.patches().size();
  f.exact_rows_to_build =
      patches.patch_count() < kErrorSampleRows ? patches.patch_count() : kErrorSampleRows;
  progress->finished(ForecastPart::kExactRows);
  return {};
}

} // namespace hemicube::radiosity
