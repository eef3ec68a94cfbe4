// Rows of every rung of the accuracy ladder as functions of the scene alone: closed, reciprocal,
// the same bits for any workers and kernels. What place, size and order may change:
// invariance_test.cpp.

#include "radiosity/parallel/thread_pool.h"
#include "tests/support/drawn_face.h"
#include "tests/support/ladder_levels.h"
#include "tests/support/ladder_scenes.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

struct Case {
  const char* name;
  LadderLevel level;
  PolygonList (*make)();
  bool closed = false;
};
void PrintTo(const Case& made, std::ostream* out) {
  *out << made.name;
}
const Case kCases[] = {
    {"open_analytic", kAnalyticRung, open_scene},
    {"open_area", kAreaRung, open_scene},
    {"open_loose", kLooseRung, open_scene},
    {"open_adaptive", kAdaptiveRung, open_scene},
    {"l_room_area", kAreaRung, l_shaped, true},
    {"l_room_adaptive", kAdaptiveRung, l_shaped, true},
    {"t_vertices_analytic", kAnalyticRung, t_vertices, true},
    {"t_vertices_area", kAreaRung, t_vertices, true},
    {"t_vertices_adaptive", kAdaptiveRung, t_vertices, true},
    {"soup_analytic", kAnalyticRung, random_soup},
    {"soup_area", kAreaRung, random_soup},
    {"soup_loose", kLooseRung, random_soup},
    {"soup_adaptive", kAdaptiveRung, random_soup},
    {"tiny_exact", kExactRung, tiny_scene},
};

class Ladder : public testing::TestWithParam<Case> {
protected:
  radiosity::Options options() const { return GetParam().level.options(64); }
  bool shares_pairs() const { return GetParam().level.rung >= radiosity::Rung::kAdaptive; }

  void compute(const PolygonList& polygons, FormFactors* factors) const {
    compute_all(patches_of(polygons), options(), 2, factors);
  }
};

// Catches: closure that closes nothing, entries of 0 or NaN, light made from rounding.
TEST_P(Ladder, RowsClose) {
  FormFactors factors;
  compute(GetParam().make(), &factors);
  for (std::uint64_t i = 0; i < factors.matrix.row_count(); ++i) {
    const radiosity::RowView row = factors.matrix.row(i);
    long double sum = static_cast<long double>(row.space) + row.back_side;
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      EXPECT_TRUE(row.values[k] > 0 && std::isfinite(row.values[k])) << i;
      EXPECT_NE(row.columns[k], i) << "a patch sees itself";
      if (k > 0) {
        EXPECT_LT(row.columns[k - 1], row.columns[k]) << "columns must ascend";
      }
      sum += static_cast<long double>(row.scale) * static_cast<long double>(row.values[k]);
    }
    EXPECT_NEAR(static_cast<double>(sum), 1.0, 1e-12) << "row " << i;
    const double share = 1 - row.space - row.back_side; // known to 2^-53: sums below 1/1024 to more
    const double most = row.columns.empty() ? 0 : share < 0x1p-9 ? share + 0x1p-53 : share;
    EXPECT_LE(radiosity::row_sum(row), most) << "row " << i;
    EXPECT_GE(row.space, 0.0) << "row " << i;
    EXPECT_GE(row.back_side, 0.0) << "row " << i;
    if (GetParam().closed) {
      EXPECT_EQ(row.space, 0.0) << "row " << i;
      EXPECT_EQ(row.back_side, 0.0) << "row " << i;
    }
  }
}

// Catches: a row that depends on the worker, on the rows before it or on the vector width.
TEST_P(Ladder, NeitherWorkersNorKernelsChangeABit) {
  const PatchSet patches = patches_of(GetParam().make());
  radiosity::Options options = this->options();
  options.kernels = raster::kernels_by_name("scalar");
  FormFactors expected;
  compute_all(patches, options, 1, &expected);
  const auto expect_same = [&](const std::string& isa, std::uint32_t threads) {
    options.kernels = raster::kernels_by_name(isa);
    FormFactors actual;
    compute_all(patches, options, threads, &actual);
    EXPECT_TRUE(same_bits(expected.matrix, actual.matrix)) << isa << ", " << threads << " workers";
    EXPECT_EQ(expected.certificate.form_factor_hash, actual.certificate.form_factor_hash) << isa;
  };
  for (const std::uint32_t threads : {2u, 3u, 7u})
    expect_same("scalar", threads);
  for (const std::string& isa : kernels_here())
    expect_same(isa, 2);
}

// Catches: a pair found from one side for all rows and from the other for some.
TEST_P(Ladder, ASelectionOfRowsIsThatOfAllRows) {
  const PatchSet patches = patches_of(GetParam().make());
  FormFactors all, some;
  compute_all(patches, options(), 2, &all);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < patches.patch_count(); i += 3)
    rows.push_back(patches.patch_count() - 1 - i);
  radiosity::ThreadPool pool;
  require(pool.init(2));
  require(radiosity::compute_form_factors(patches, rows, options(), pool, nullptr, &some.matrix,
                                          &some.certificate));
  for (std::size_t k = 0; k < rows.size(); ++k)
    EXPECT_EQ(radiosity::hash_row(some.matrix.row(k)), radiosity::hash_row(all.matrix.row(rows[k])))
        << "row " << rows[k];
}

// Catches: the two rows of a pair saying different things; closure that spoils it in open scenes.
TEST_P(Ladder, PairsAreReciprocal) {
  if (!shares_pairs())
    return; // rows of this rung are found one by one
  const PatchSet patches = patches_of(GetParam().make());
  FormFactors factors;
  compute_all(patches, options(), 2, &factors);
  std::vector<std::vector<double>> rows;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    rows.push_back(factors.dense_row(i));
  double largest = 0;
  for (std::uint32_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j) {
      const double there = patches.area[i] * rows[i][j], back = patches.area[j] * rows[j][i];
      if (there + back > 0)
        largest = std::max(largest, std::fabs(there - back) / std::max(there, back));
    }
  std::printf("%s: relative reciprocity %.1e\n", GetParam().name, largest);
  EXPECT_LE(largest, GetParam().closed ? 4e-3 : 1e-6); // closure scales what was estimated
}

INSTANTIATE_TEST_SUITE_P(, Ladder, testing::ValuesIn(kCases),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace hemicube::test
