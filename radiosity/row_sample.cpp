#include "radiosity/row_sample.h"

#include <cmath>

namespace hemicube::radiosity {

double RowSample::root(double x) noexcept {
  return std::sqrt(x);
}

Status RowSample::choose(std::uint32_t patch_count, std::uint32_t count) noexcept {
  patches_.clear();
  if (count > patch_count)
    count = patch_count;
  for (std::uint64_t k = 0; k < count; ++k)
    HC_TRY(patches_.push_back(
        static_cast<std::uint32_t>((2 * k + 1) * patch_count / (2 * std::uint64_t{count}))));
  return exact.init(count, patch_count);
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
