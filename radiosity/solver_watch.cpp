#include "radiosity/solver_watch.h"

#include <algorithm>

namespace hemicube::radiosity {

Status fill_light(const LightModel& light, std::uint32_t band_count,
                  std::span<const double> radiosity, std::span<const double> ambient,
                  Solution* solution) {
  Solution& s = *solution;
  s.band_count = band_count;
  const std::size_t patches = radiosity.size() / light.band_count;
  for (Buffer<double>* values : {&s.reflectance, &s.exitance, &s.radiosity})
    HC_TRY(values->resize(patches * band_count));
  for (std::size_t i = 0; i < patches; ++i)
    for (std::uint32_t b = 0; b < band_count; ++b) {
      const std::size_t from = i * light.band_count + light.solved_band[b];
      const std::size_t to = i * band_count + b;
      s.reflectance[to] = light.reflectance[from];
      s.exitance[to] = light.exitance[from];
      s.radiosity[to] = radiosity[from];
    }
  s.ambient.clear();
  for (std::uint32_t b = 0; b < band_count && !ambient.empty(); ++b)
    HC_TRY(s.ambient.push_back(ambient[light.solved_band[b]]));
  return {};
}

bool SolverWatch::shot(const ShotState& state) noexcept {
  if (ambient_.empty())
    failure_ = ambient_.resize(state.ambient.size());
  if (failure_.ok()) {
    std::copy(state.ambient.begin(), state.ambient.end(), ambient_.begin());
    if (progress_ != nullptr && options_.snapshot_every != 0 &&
        state.shots % options_.snapshot_every == 0)
      failure_ = take_snapshot(state);
  }
  return failure_.ok() && (progress_ == nullptr || progress_->shots(state.shots, state.unshot));
}

Status SolverWatch::take_snapshot(const ShotState& state) {
  const LightProblem problem = light_.problem(patches_);
  Buffer<double> radiosity;
  HC_TRY(radiosity.resize(state.radiosity.size()));
  for (std::size_t at = 0; at < radiosity.size(); ++at)
    radiosity[at] =
        problem.is_black(at / problem.band_count) ? problem.exitance[at] : state.radiosity[at];
  Solution solution;
  HC_TRY(fill_light(light_, scene_.band_count(), radiosity.span(), state.ambient, &solution));
  return progress_->snapshot(state.shots, solution);
}

} // namespace hemicube::radiosity
