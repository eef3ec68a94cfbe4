#include "radiosity/solve/unshot_light.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {

Status UnshotLight::init(const LightProblem& problem, std::span<const double> source,
                         std::span<const double> emitted) {
  problem_ = &problem;
  const std::uint32_t bands = problem.band_count;
  HC_TRY(values_.resize(source.size()));
  std::copy(source.begin(), source.end(), values_.begin());
  for (Buffer<double>* per_band : {&emitted_, &power_, &ambient_, &ambient_per_power_})
    HC_TRY(per_band->resize(bands));
  std::copy(emitted.begin(), emitted.end(), emitted_.begin());
  for (std::uint32_t b = 0; b < bands; ++b) {
    double absorbing = 0; // sum A (1 - rho)
    for (std::size_t i = 0; i < problem.patch_count(); ++i)
      absorbing += problem.area[i] * (1 - problem.reflectance[i * bands + b]);
    ambient_per_power_[b] = absorbing > 0 ? 1 / absorbing : 0;
  }
  survey();
  return {};
}

void UnshotLight::survey() noexcept {
  const std::uint32_t bands = problem_->band_count;
  share_ = 0;
  for (std::uint32_t b = 0; b < bands; ++b)
    power_[b] = ambient_[b] = 0;
  for (std::size_t i = 0; i < problem_->patch_count(); ++i)
    for (std::uint32_t b = 0; b < bands; ++b) {
      const double power = problem_->area[i] * values_[i * bands + b];
      power_[b] += std::fabs(power);
      ambient_[b] += power;
    }
  for (std::uint32_t b = 0; b < bands; ++b) {
    ambient_[b] = std::max(ambient_[b], 0.0) * ambient_per_power_[b];
    if (power_[b] > 0)
      share_ = std::max(share_, power_[b] / emitted_[b]);
  }
}

double UnshotLight::overshoot(std::size_t patch, std::uint32_t band) const noexcept {
  const std::size_t at = patch * problem_->band_count + band;
  const double later = problem_->reflectance[at] * ambient_[band];
  return std::max(0.0, std::min(later, kMostOvershot * values_[at]));
}

std::size_t UnshotLight::choose(std::span<std::uint32_t> patches) const noexcept {
  constexpr std::size_t kMost = 64;
  HC_ASSERT(patches.size() <= kMost && !patches.empty());
  const std::uint32_t bands = problem_->band_count;
  double powers[kMost];
  std::size_t count = 0;
  for (std::size_t i = 0; i < problem_->patch_count(); ++i) {
    double power = 0;
    for (std::uint32_t b = 0; b < bands; ++b)
      power += std::fabs(values_[i * bands + b] + overshoot(i, b));
    power *= problem_->area[i];
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): count <= kMost
    if (!(power > 0) || (count == patches.size() && power <= powers[count - 1]))
      continue;
    std::size_t place = count < patches.size() ? count++ : count - 1;
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): place < count
    for (; place > 0 && powers[place - 1] < power; --place) {
      powers[place] = powers[place - 1];
      patches[place] = patches[place - 1];
    }
    powers[place] = power;
    patches[place] = static_cast<std::uint32_t>(i);
  }
  return count;
}

void UnshotLight::take(std::uint32_t patch, double* shot) noexcept {
  for (std::uint32_t b = 0; b < problem_->band_count; ++b) {
    double& value = values_[std::size_t{patch} * problem_->band_count + b];
    const double more = overshoot(patch, b);
    shot[b] = value + more;
    value = -more;
  }
}

} // namespace hemicube::radiosity
