#include "radiosity/solve/row_shooter.h"

#include "radiosity/solve/progressive.h"

#include <algorithm>

namespace hemicube::radiosity {

Status RowShooter::init(const LightProblem& problem, std::span<const double> space) {
  problem_ = &problem;
  const std::uint32_t bands = problem.band_count;
  const std::size_t count = problem.patch_count() * bands;
  power_.clear();
  emitted_.clear();
  for (Buffer<double>* values : {&radiosity_, &irradiance_})
    HC_TRY(values->resize(count));
  for (Buffer<double>* values : {&shot_, &emitted_})
    HC_TRY(values->resize(bands));
  HC_TRY(power_.resize(bands));
  for (std::size_t at = 0; at < count; ++at) {
    const std::size_t i = at / bands;
    const std::uint32_t b = static_cast<std::uint32_t>(at % bands);
    const double area = problem.area[i], rho = problem.reflectance[at];
    irradiance_[at] = space.empty() ? 0 : space[i] * problem.space_exitance[b];
    radiosity_[at] = problem.exitance[at] + rho * irradiance_[at];
    power_[b].absorbed += area * (1 - rho) * irradiance_[at];
    emitted_[b] += area * (problem.exitance[at] + irradiance_[at]);
  }
  return unshot_.init(problem, radiosity_.span(), emitted_.span());
}

void RowShooter::shoot(std::uint32_t patch, const RowView& row) noexcept {
  const LightProblem& problem = *problem_;
  const std::uint32_t bands = problem.band_count;
  const double area = problem.area[patch];
  unshot_.take(patch, shot_.data());
  for (std::uint32_t b = 0; b < bands; ++b) {
    power_[b].escaped += area * row.space * shot_[b];
    power_[b].back_side += area * row.back_side * shot_[b];
  }
  for (std::size_t k = 0; k < row.columns.size(); ++k) {
    const std::size_t i = row.columns[k];
    const double sent = area * (row.scale * static_cast<double>(row.values[k]));
    const double form_factor = std::min(sent / problem.area[i], 1.0);
    const double cut = sent > problem.area[i] ? sent - problem.area[i] : 0;
    for (std::uint32_t b = 0; b < bands; ++b) {
      const std::size_t at = i * bands + b;
      const double arriving = form_factor * shot_[b];
      const double reflected = problem.reflectance[at] * arriving;
      irradiance_[at] += arriving;
      radiosity_[at] += reflected;
      unshot_.values()[at] += reflected;
      power_[b].absorbed += problem.area[i] * (arriving - reflected);
      power_[b].cut += cut * shot_[b];
    }
  }
}

double RowShooter::unshot_power(std::uint32_t band) noexcept {
  double power = 0;
  for (std::size_t i = 0; i < problem_->patch_count(); ++i)
    power += problem_->area[i] * unshot_.values()[i * problem_->band_count + band];
  return power;
}

double RowShooter::bound() const noexcept {
  const std::uint32_t bands = problem_->band_count;
  double bound = 0;
  for (std::uint32_t b = 0; b < bands; ++b) {
    double rate = 0, total = 0;
    for (std::size_t i = 0; i < problem_->patch_count(); ++i) {
      rate = std::max(rate, problem_->reflectance[i * bands + b]);
      total += problem_->area[i] * radiosity_[i * bands + b];
    }
    bound = std::max(bound, unshot_bound(rate, unshot_.power(b), total));
  }
  return bound;
}

} // namespace hemicube::radiosity
