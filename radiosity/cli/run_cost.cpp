#include "radiosity/cli/run_cost.h"

#include "radiosity/cli/memory_plan.h"
#include "radiosity/cli/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity::cli {
namespace {

/// What a pair takes that is found once for both rows, in bytes an entry: twice, as it is
/// transposed, and with room to grow.
constexpr double kPairBytes = 30;
/// Rows are read so fast, and so often beside the sweeps: reciprocity, enclosures, the estimate of
/// the error.
constexpr double kSweepBytesPerSecond = 5e9, kOtherPasses = 8;

class PartTimes final : public ForecastProgress {
public:
  void finished(ForecastPart part) noexcept override {
    seconds[static_cast<std::size_t>(part)] = watch_.lap();
  }
  double operator[](ForecastPart part) const { return seconds[static_cast<std::size_t>(part)]; }

private:
  double seconds[5] = {};
  Stopwatch watch_;
};

/// Sweeps until the light that is left is below the tolerance, if it loses in each what walls
/// absorb.
double expected_sweeps(const LoadedScene& loaded, double tolerance) {
  double area = 0, reflecting = 0;
  const std::uint32_t bands = loaded.scene.band_count();
  for (std::uint32_t i = 0; i < loaded.patches.patch_count(); ++i) {
    double most = 0;
    for (std::uint32_t b = 0; b < bands; ++b)
      most = std::max(most, loaded.scene.reflectance[loaded.patches.material[i] * bands + b]);
    area += loaded.patches.area[i];
    reflecting += most * loaded.patches.area[i];
  }
  const double mean = std::clamp(reflecting / area, 0.01, 0.99);
  return std::log(tolerance) / std::log(mean) / 2; // Gauss-Seidel: twice as fast as Jacobi
}

} // namespace

Status predict_cost(Session* session, RunCost* cost) {
  RunCost& c = *cost;
  PartTimes times;
  const Options& options = session->line.options;
  const LoadedScene& loaded = session->loaded;
  HC_TRY(session->forecast(&times, &c.forecast));
  const Forecast& f = c.forecast;
  const auto of = [](std::uint64_t count) { return static_cast<double>(count); };
  const double patches = of(loaded.patches.patch_count()), rows = std::max(1.0, of(f.rows));
  c.nonzeros_per_row = of(f.nonzeros) / rows;
  c.matrix_bytes = of(f.rows_to_store) * (8 * c.nonzeros_per_row + 96);
  const double pair_bytes = f.shares_pairs ? patches * c.nonzeros_per_row * kPairBytes : 0;
  c.memory_bytes =
      of(other_memory(loaded.patches.patch_count(), f.solved_bands, session->run.threads)) +
      1.1 * c.matrix_bytes + pair_bytes;
  // What workers need before their first row is in both samples, and once in the run.
  const double more = times[ForecastPart::kRows] - times[ForecastPart::kFirstRows];
  const double row_seconds = f.rows > f.first_rows && more > 0 ? more / of(f.rows - f.first_rows)
                                                               : times[ForecastPart::kRows] / rows;
  const double begin_seconds =
      std::max(0.0, times[ForecastPart::kFirstRows] - row_seconds * of(f.first_rows));
  c.form_factor_seconds =
      begin_seconds + row_seconds * of(f.rows_to_build) / (f.shares_pairs ? 2 : 1);
  const double exact_seconds =
      f.exact_rows == 0
          ? 0
          : begin_seconds + std::max(0.0, times[ForecastPart::kExactRows] - begin_seconds) *
                                of(f.exact_rows_to_build) / of(f.exact_rows);
  const double passes = 2 * expected_sweeps(loaded, options.tolerance) + kOtherPasses;
  c.seconds = session->run.read_seconds + session->run.mesh_seconds +
              times[ForecastPart::kGeometry] + times[ForecastPart::kChoice] +
              c.form_factor_seconds + exact_seconds +
              passes * c.matrix_bytes / kSweepBytesPerSecond;
  return {};
}

} // namespace hemicube::radiosity::cli
