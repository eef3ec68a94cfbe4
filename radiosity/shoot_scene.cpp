#include "radiosity/shoot_scene.h"

#include "radiosity/solve/enclosures.h"
#include "radiosity/solve/progressive.h"

namespace hemicube::radiosity {

Status SceneShooter::look_around() {
  bool is_needed = false;
  for (const double exitance : problem_.space_exitance)
    is_needed = is_needed || exitance > 0;
  for (const double reflectance : problem_.reflectance)
    is_needed = is_needed || reflectance == 1;
  if (!is_needed)
    return shooting_.init(problem_, {}, this);
  HC_TRY(space_.resize(problem_.patch_count()));
  EnclosureFinder finder;
  HC_TRY(finder.init(problem_, 1));
  Mutex mutex;
  const auto take = [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
    space_[i] = row.space;
    statistics_->record(i, row, *facts);
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
  HC_TRY(shooting_.init(problem_, space_.span(), this));
  return check_enclosures(problem_, enclosures, light().radiosity().span());
}

Status SceneShooter::prepare(std::span<const std::uint32_t> patches) {
  constexpr std::uint64_t kApart = FormFactorMatrix::kBlockRows;
  HC_TRY(made_.init(patches.size() * kApart, static_cast<std::uint32_t>(problem_.patch_count())));
  const auto place_of = [&](std::uint64_t k, RowPlace* place) {
    place->patch = patches[k / kApart];
    return k % kApart == 0;
  };
  return rows_.build(patches.size() * kApart, place_of,
                     [&](std::uint64_t k, const RowView& row, const RowFacts* facts) {
                       if (facts != nullptr)
                         statistics_->record(patches[k / kApart], row, *facts);
                       return made_.append_row(k / kApart, row);
                     });
}

Status SceneShooter::row(std::size_t k, RowView* row) {
  *row = made_.row(k * FormFactorMatrix::kBlockRows);
  return {};
}

Status SceneShooter::tell() {
  convergence_.shots = shooting_.shots();
  convergence_.unshot = shooting_.unshot();
  if (progress_ == nullptr ||
      progress_->shot({convergence_.shots, convergence_.unshot, light().radiosity().span(),
                       light().unshot().ambient()}))
    return {};
  return Status::error(StatusCode::kCancelled, "interrupted after ", convergence_.shots, " shots");
}

Status SceneShooter::run(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                         Executor& executor, SolverProgress* progress, RowStatistics* statistics) {
  HC_TRY(check_stop_unshot(options.stop_unshot));
  const double stop = options.stop_unshot > 0 ? options.stop_unshot : kDefaultStopUnshot;
  progress_ = progress;
  statistics_ = statistics;
  convergence_ = {};
  HC_TRY(rows_.init(geometry, setting, options, problem_.patch_count(), executor, nullptr));
  HC_TRY(look_around());
  HC_TRY(shooting_.survey());
  HC_TRY(tell());
  while (convergence_.unshot > stop && convergence_.shots < options.max_shots) {
    HC_TRY(shooting_.shoot());
    HC_TRY(tell());
  }
  convergence_.unshot_bound = light().bound();
  convergence_.converged = convergence_.unshot <= stop;
  if (convergence_.converged)
    return {};
  return Status::error(StatusCode::kNotConverged, "not converged after ", convergence_.shots,
                       " shots: unshot light is ", convergence_.unshot,
                       " of what is emitted, more than ", stop);
}

EnergyBalance SceneShooter::energy(std::uint32_t band) noexcept {
  const ShotPower& power = light().power(band);
  EnergyBalance energy;
  energy.emitted = light().emitted(band);
  energy.absorbed = power.absorbed;
  energy.back_side = power.back_side;
  energy.escaped = power.escaped;
  energy.cut = power.cut;
  energy.unshot = light().unshot_power(band);
  if (energy.emitted > 0)
    energy.imbalance = (energy.emitted - energy.absorbed - energy.back_side - energy.escaped -
                        energy.cut - energy.unshot) /
                       energy.emitted;
  return energy;
}

} // namespace hemicube::radiosity
