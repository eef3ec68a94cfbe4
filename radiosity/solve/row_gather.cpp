#include "radiosity/solve/row_gather.h"

#include <algorithm>

namespace hemicube::radiosity {

Status RowGather::init(std::size_t patch_count, std::uint32_t band_count,
                       const RowKernels& kernels) {
  patch_count_ = patch_count;
  band_count_ = band_count;
  groups_.clear();
  std::size_t size = 0;
  for (std::uint32_t first = 0; first < band_count; first += 4) {
    const std::uint32_t bands = std::min(band_count - first, 4u);
    const RowSums kernel[] = {kernels.of_1, kernels.of_2, kernels.of_3, kernels.of_4};
    HC_TRY(groups_.push_back({first, bands, size, kernel[bands - 1]}));
    size += bands * patch_count;
  }
  ++size; // kernels read one more
  values_.clear();
  HC_TRY(values_.reserve_huge(size));
  return values_.resize(size);
}

void RowGather::set(std::size_t patch, const double* values) noexcept {
  for (const Group& group : groups_) {
    double* const to = values_.data() + group.begin + patch * group.band_count;
    for (std::uint32_t b = 0; b < group.band_count; ++b)
      to[b] = values[group.first_band + b];
  }
}

void RowGather::fill(std::span<const double> values) noexcept {
  for (std::size_t i = 0; i < patch_count_; ++i)
    set(i, &values[i * band_count_]);
}

void RowGather::sum(const RowView& row, std::size_t first, std::size_t last,
                    double* sums) const noexcept {
  for (const Group& group : groups_) {
    double of_group[4];
    group.sums(row.columns.data() + first, row.values.data() + first, last - first,
               values_.data() + group.begin, of_group);
    for (std::uint32_t b = 0; b < group.band_count; ++b)
      sums[group.first_band + b] = row.scale * of_group[b];
  }
}

} // namespace hemicube::radiosity
