#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/solve/light_problem.h"

#include <cmath>

namespace hemicube::radiosity {

/// Some rows of a matrix computed much more exactly: what the error of all rows is judged by.
class RowSample {
public:
  /// Chooses at most `count` patches, spread evenly over all by number or, with weights, half of
  /// them by number and half by weight; or all if there are not more.
  /// @param weights  [patch] >= 0; empty: none
  Status choose(std::uint32_t patch_count, std::uint32_t count,
                std::span<const double> weights = {}) noexcept;

  /// How many patches the k-th one stands for.
  double stands_for(std::size_t k) const noexcept { return stands_for_[k]; }

  std::span<const std::uint32_t> patches() const noexcept { return patches_.span(); }

  /// The exact rows: row k belongs to patches()[k].
  FormFactorMatrix exact;

  /// RMS error of a form factor over all pairs over the RMS of a form factor, as far as the sample
  /// tells.
  /// @param row_of  RowView(k), the row to judge of patches()[k]; skipped unless it is computed
  template <typename RowOf> double form_factor_error(RowOf row_of) const {
    double errors = 0, all = 0;
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      const RowView row = row_of(k), truth = exact.row(k);
      if (!is_computed(row))
        continue;
      double row_errors = 0;
      for_each_difference(row, truth, [&](std::uint32_t, double difference) {
        row_errors += difference * difference;
      });
      errors += stands_for_[k] * row_errors;
      double row_all = 0;
      for (const float value : truth.values)
        row_all += static_cast<double>(value) * static_cast<double>(value);
      all += stands_for_[k] * truth.scale * truth.scale * row_all;
    }
    return all > 0 ? std::sqrt(errors / all) : 0;
  }

  /// What a row gathers too much: rho_i (sum_j (F_ij - exact) B_j + (s_i - exact) E_space).
  /// @param radiosity  [patch][band], W/m^2
  /// @param defect     [band], out
  void defect(std::size_t k, const RowView& row, const LightProblem& problem,
              std::span<const double> radiosity, double* defect) const noexcept;

  /// Calls take(column, a - b) for every column that either row has, ascending.
  template <typename Take>
  static void for_each_difference(const RowView& a, const RowView& b, Take take) {
    std::size_t i = 0, j = 0;
    while (i < a.columns.size() || j < b.columns.size()) {
      const bool takes_a =
          j == b.columns.size() || (i < a.columns.size() && a.columns[i] <= b.columns[j]);
      const bool takes_b =
          i == a.columns.size() || (j < b.columns.size() && b.columns[j] <= a.columns[i]);
      const std::uint32_t column = takes_a ? a.columns[i] : b.columns[j];
      double difference = 0;
      if (takes_a)
        difference += a.scale * static_cast<double>(a.values[i++]);
      if (takes_b)
        difference -= b.scale * static_cast<double>(b.values[j++]);
      take(column, difference);
    }
  }

private:
  Buffer<std::uint32_t> patches_; ///< ascending
  Buffer<double> stands_for_;     ///< [sampled patch]
};

} // namespace hemicube::radiosity
