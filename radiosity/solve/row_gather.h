#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/solve/row_kernels.h"

namespace hemicube::radiosity {

/// Values of all patches, [patch][band], laid out for the row kernels, and sums of them over rows:
/// the bits of row_dot(), all bands of a row in one pass over its entries (more than four in one
/// pass for four each).
class RowGather {
public:
  Status init(std::size_t patch_count, std::uint32_t band_count, const RowKernels& kernels);

  /// @param values  [patch][band]
  void fill(std::span<const double> values) noexcept;
  /// @param values  [band]
  void set(std::size_t patch, const double* values) noexcept;

  /// sums[band] = sum of F_ij * value of patch j, over the entries first <= k < last of a row.
  void sum(const RowView& row, std::size_t first, std::size_t last, double* sums) const noexcept;
  void sum(const RowView& row, double* sums) const noexcept {
    sum(row, 0, row.columns.size(), sums);
  }

private:
  /// Up to four bands that lie side by side.
  struct Group {
    std::uint32_t first_band, band_count;
    std::size_t begin; ///< of its values: [patch][band_count]
    RowSums sums;
  };
  Buffer<Group> groups_;
  Buffer<double> values_;
  std::size_t patch_count_ = 0;
  std::uint32_t band_count_ = 0;
};

} // namespace hemicube::radiosity
