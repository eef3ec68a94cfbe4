#include "radiosity/solve/rescaling.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {

Status EnclosureRescaling::init(const Enclosures& enclosures, std::uint32_t band_count) {
  balances_.clear();
  return balances_.resize(enclosures.first_patch.size() * band_count, {0, 0, 0, 0, -1, 0, 0, 0});
}

double EnclosureRescaling::choose_gain(Balance* balance) {
  constexpr std::uint32_t kMostFailures = 20;
  Balance& b = *balance;
  if (b.wait > 0) {
    --b.wait;
    return 0;
  }
  const double relative = b.brightest > 0 ? b.residual / b.brightest : 0;
  if (b.last >= 0 && relative >= b.last) {
    b.wait = (1u << b.failures) - 1;
    b.failures = std::min(b.failures + 1, kMostFailures);
    b.last = -1;
    return 0;
  }
  if (!(b.lost_power > 0) || !(b.residual_power > -b.lost_power))
    return 0;
  b.last = relative;
  return b.residual_power / b.lost_power;
}

void EnclosureRescaling::apply(const LightProblem& problem, const Enclosures& enclosures,
                               std::span<const double> source, std::span<const double> from_source,
                               std::span<double> x, std::span<double> gathered) {
  const std::uint32_t bands = problem.band_count;
  const auto for_each_unknown = [&](auto visit) {
    for (std::size_t i = 0; i < problem.patch_count(); ++i)
      if (const std::size_t e = enclosures.of_patch[i]; e != Enclosures::kNone)
        for (std::uint32_t b = 0; b < bands; ++b)
          visit(i, i * bands + b, balances_[e * bands + b]);
  };
  for (Balance& b : balances_)
    b.residual_power = b.lost_power = b.residual = b.brightest = 0;
  for_each_unknown([&](std::size_t i, std::size_t at, Balance& b) {
    const double rho = problem.reflectance[at];
    const double residual = source[at] + rho * gathered[at] - x[at];
    const double loss = (x[at] - source[at]) - rho * (gathered[at] - from_source[at]);
    b.residual_power += problem.area[i] * residual;
    b.lost_power += problem.area[i] * loss;
    b.residual = std::max(b.residual, std::fabs(residual));
    b.brightest = std::max(b.brightest, x[at]);
  });
  for (Balance& b : balances_)
    b.gain = choose_gain(&b);
  for_each_unknown([&](std::size_t, std::size_t at, const Balance& b) {
    x[at] += b.gain * (x[at] - source[at]);
    gathered[at] += b.gain * (gathered[at] - from_source[at]);
  });
}

} // namespace hemicube::radiosity
