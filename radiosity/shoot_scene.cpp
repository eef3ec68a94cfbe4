#include "radiosity/shoot_scene.h"

#include "radiosity/solve/enclosures.h"
#include "radiosity/solve/progressive.h"

#include <cmath>

namespace hemicube::radiosity {

Status SceneShooter::look_around(RowStatistics* statistics) {
  bool is_needed = false;
  for (const double exitance : problem_.space_exitance)
    is_needed = is_needed || exitance > 0;
  for (const double reflectance : problem_.reflectance)
    is_needed = is_needed || reflectance == 1;
  if (!is_needed)
    return shooter_.init(problem_, {});
  HC_TRY(space_.resize(problem_.patch_count()));
  EnclosureFinder finder;
  HC_TRY(finder.init(problem_, 1));
  Mutex mutex;
  const auto take = [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
    space_[i] = row.space;
    statistics->record(i, row, *facts);
    const MutexLock lock(mutex);
    if (!problem_.is_black(i))
      finder.add_row(0, static_cast<std::uint32_t>(i), row);
    return Status();
  };
  const auto place_of = [](std::uint64_t i, RowPlace* place) {
    place->patch = static_cast<std::uint32_t>(i);
    return true;
  };
  HC_TRY(rows_.build(problem_.patch_count(), place_of, take));
  Enclosures enclosures;
  HC_TRY(finder.finish(&enclosures));
  HC_TRY(shooter_.init(problem_, space_.span()));
  return check_enclosures(problem_, enclosures, shooter_.radiosity().span());
}

Status SceneShooter::make_rows(std::span<const std::uint32_t> patches, RowStatistics* statistics) {
  constexpr std::uint64_t kApart = FormFactorMatrix::kBlockRows;
  HC_TRY(made_.init(patches.size() * kApart, static_cast<std::uint32_t>(problem_.patch_count())));
  const auto place_of = [&](std::uint64_t k, RowPlace* place) {
    place->patch = patches[k / kApart];
    return k % kApart == 0;
  };
  return rows_.build(patches.size() * kApart, place_of,
                     [&](std::uint64_t k, const RowView& row, const RowFacts* facts) {
                       if (facts != nullptr)
                         statistics->record(patches[k / kApart], row, *facts);
                       return made_.append_row(k / kApart, row);
                     });
}

Status SceneShooter::tell() {
  UnshotLight& unshot = shooter_.unshot();
  unshot.survey();
  convergence_.unshot = unshot.share();
  if (!std::isfinite(unshot.share()))
    return Status::error(StatusCode::kBadScene, "the light is too bright to be computed: scale ",
                         "the exitances down");
  if (progress_ == nullptr || progress_->shot({convergence_.shots, unshot.share(),
                                               shooter_.radiosity().span(), unshot.ambient()}))
    return {};
  return Status::error(StatusCode::kCancelled, "interrupted after ", convergence_.shots, " shots");
}

Status SceneShooter::run(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                         Executor& executor, SolverProgress* progress, RowStatistics* statistics) {
  HC_TRY(check_stop_unshot(options.stop_unshot));
  const double stop = options.stop_unshot > 0 ? options.stop_unshot : kDefaultStopUnshot;
  progress_ = progress;
  convergence_ = {};
  HC_TRY(rows_.init(geometry, setting, options, problem_.patch_count(), executor, nullptr));
  HC_TRY(look_around(statistics));
  HC_TRY(tell());
  while (convergence_.unshot > stop && convergence_.shots < options.max_shots) {
    std::uint32_t brightest[kRowsAtOnce];
    const std::size_t count = shooter_.unshot().choose(brightest);
    HC_TRY(make_rows({brightest, count}, statistics));
    for (std::size_t k = 0;
         k < count && convergence_.unshot > stop && convergence_.shots < options.max_shots; ++k) {
      const FloatEnvironment environment;
      shooter_.shoot(brightest[k], made_.row(k * FormFactorMatrix::kBlockRows));
      ++convergence_.shots;
      HC_TRY(tell());
    }
  }
  convergence_.unshot_bound = shooter_.bound();
  convergence_.converged = convergence_.unshot <= stop;
  if (convergence_.converged)
    return {};
  return Status::error(StatusCode::kNotConverged, "not converged after ", convergence_.shots,
                       " shots: unshot light is ", convergence_.unshot,
                       " of what is emitted, more than ", stop);
}

EnergyBalance SceneShooter::energy(std::uint32_t band) noexcept {
  const ShotPower& power = shooter_.power(band);
  EnergyBalance energy;
  energy.emitted = shooter_.emitted(band);
  energy.absorbed = power.absorbed;
  energy.back_side = power.back_side;
  energy.escaped = power.escaped;
  energy.cut = power.cut;
  energy.unshot = shooter_.unshot_power(band);
  if (energy.emitted > 0)
    energy.imbalance = (energy.emitted - energy.absorbed - energy.back_side - energy.escaped -
                        energy.cut - energy.unshot) /
                       energy.emitted;
  return energy;
}

} // namespace hemicube::radiosity
