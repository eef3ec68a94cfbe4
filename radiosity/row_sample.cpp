#include "radiosity/row_sample.h"

namespace hemicube::radiosity {

Status RowSample::choose(std::uint32_t patch_count, std::uint32_t count,
                         std::span<const double> weights) noexcept {
  patches_.clear();
  stands_for_.clear();
  double all = 0;
  for (const double weight : weights)
    all += weight;
  const auto share_of = [&](std::uint32_t i) {
    const double even = 1.0 / patch_count;
    return all > 0 ? 0.5 * even + 0.5 * weights[i] / all : even;
  };
  // Systematic sampling: a patch is taken wherever the running sum of shares passes a mark.
  double sum = 0;
  std::uint32_t passed = 0;
  for (std::uint32_t i = 0; i < patch_count; ++i) {
    const double share = share_of(i);
    sum += share;
    const double marks = sum * count + 0.5;
    const std::uint32_t now = count >= patch_count ? passed + 1 : static_cast<std::uint32_t>(marks);
    if (now <= passed)
      continue;
    passed = now;
    const double chance = share * count;
    HC_TRY(patches_.push_back(i));
    HC_TRY(stands_for_.push_back(count >= patch_count || chance > 1 ? 1 : 1 / chance));
  }
  return exact.init(patches_.size(), patch_count);
}

void RowSample::defect(std::size_t k, const RowView& row, const LightProblem& problem,
                       std::span<const double> radiosity, double* defect) const noexcept {
  const std::uint32_t bands = problem.band_count;
  const RowView truth = exact.row(k);
  for (std::uint32_t b = 0; b < bands; ++b)
    defect[b] = (row.space - truth.space) * problem.space_exitance[b];
  for_each_difference(row, truth, [&](std::uint32_t column, double difference) {
    for (std::uint32_t b = 0; b < bands; ++b)
      defect[b] += difference * radiosity[std::size_t{column} * bands + b];
  });
  for (std::uint32_t b = 0; b < bands; ++b)
    defect[b] *= problem.reflectance[std::size_t{patches_[k]} * bands + b];
}

} // namespace hemicube::radiosity
