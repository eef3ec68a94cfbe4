#include "tests/support/solved.h"

#include "radiosity/parallel/thread_pool.h"

#include <cstring>

namespace hemicube::test {

Solved solve(const Scene& scene, const radiosity::Options& options, std::uint32_t threads) {
  Solved result;
  result.patches = patches_of(scene);
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  require(radiosity::solve_scene(scene, result.patches, options, pool, nullptr, &result.solution,
                                 &result.certificate));
  return result;
}

void compute_all(const PatchSet& patches, const radiosity::Options& options, std::uint32_t threads,
                 FormFactors* result) {
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  require(radiosity::compute_form_factors(patches, {}, options, pool, nullptr, &result->matrix,
                                          &result->certificate));
}

std::vector<double> FormFactors::dense_row(std::uint64_t i) const {
  std::vector<double> dense(matrix.column_count(), 0.0);
  const radiosity::RowView row = matrix.row(i);
  for (std::size_t k = 0; k < row.columns.size(); ++k)
    dense[row.columns[k]] = row.scale * static_cast<double>(row.values[k]);
  return dense;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool same_bits(const radiosity::FormFactorMatrix& a, const radiosity::FormFactorMatrix& b) {
  if (a.row_count() != b.row_count() || a.column_count() != b.column_count())
    return false;
  for (std::uint64_t i = 0; i < a.row_count(); ++i) {
    const radiosity::RowView x = a.row(i), y = b.row(i);
    const double shares_x[3] = {x.scale, x.space, x.back_side};
    const double shares_y[3] = {y.scale, y.space, y.back_side};
    if (!same_bits(shares_x, shares_y) || x.columns.size() != y.columns.size() ||
        std::memcmp(x.columns.data(), y.columns.data(), x.columns.size_bytes()) != 0 ||
        std::memcmp(x.values.data(), y.values.data(), x.values.size_bytes()) != 0)
      return false;
  }
  return true;
}

} // namespace hemicube::test
