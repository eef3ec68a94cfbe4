// Rows of every rung of the accuracy ladder as functions of the scene alone: closed, reciprocal,
// the same bits for any workers, kernels and power-of-two scale, the same numbers in any order and
// place.

#include "radiosity/parallel/thread_pool.h"
#include "tests/support/drawn_face.h"
#include "tests/support/ladder_levels.h"
#include "tests/support/polygon_lists.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace hemicube::test {
namespace {

/// Two walls, a lamp and a table whose backs are seen, a lone triangle: nothing closes by chance,
/// nothing is alike.
PolygonList open_scene() {
  PolygonList scene = rectangle_grid(0, 0, 2, 2, 4, 4);
  const auto stand_up = [](PolygonList polygons) {
    return turned(std::move(polygons), {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}});
  };
  append(&scene, stand_up(rectangle_grid(0, 0, 2, 1, 3, 2)));
  append(&scene, reversed(moved(rectangle_grid(0.5, 0.5, 1, 1.1, 2, 2), 1, {0, 0, 1.5})));
  append(&scene, {{{0.4, 0.4, 0.7}, {1.1, 0.4, 0.8}, {1.1, 1.1, 0.8}, {0.4, 1.1, 0.7}}});
  append(&scene, {{{9, 9, 9}, {10, 9, 9}, {9, 10, 9}}});
  return scene;
}

/// Two plates and a small one in between, of which the lower sees the back.
PolygonList tiny_scene() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          {{0.1, 0, 1}, {0.1, 0.8, 1}, {1, 0.8, 1}, {1, 0, 1}},
          {{0.4, 0.4, 0.5}, {0.5, 0.4, 0.5}, {0.5, 0.5, 0.5}, {0.4, 0.5, 0.5}}};
}

/// Polygons of any shape and size across one another's planes.
PolygonList soup(std::uint32_t seed, int count) {
  Random random(seed);
  PolygonList polygons;
  for (int k = 0; k < count; ++k)
    polygons.push_back(random_ngon(random, 3 + static_cast<int>(random.index(6)),
                                   random.point(-1, 1), random.between(0.05, 0.7)));
  return polygons;
}

struct Case {
  const char* name;
  LadderLevel level;
  PolygonList (*make)();
  bool closed = false;
  double order = 1e-9; ///< what another order of faces may change
};
void PrintTo(const Case& made, std::ostream* out) {
  *out << made.name;
}
PolygonList l_shaped() {
  return list_of(patches_of(l_room(1, 0.5, 1)));
}
PolygonList t_vertices() {
  return list_of(patches_of(t_vertex_room()));
}
PolygonList random_soup() {
  return soup(3, 24);
}
const Case kCases[] = {
    {"open_analytic", kAnalyticRung, open_scene},
    {"open_area", kAreaRung, open_scene},
    {"open_loose", kLooseRung, open_scene},
    {"open_adaptive", kAdaptiveRung, open_scene},
    {"l_room_area", kAreaRung, l_shaped, true},
    // Of two patches of one area the lower is integrated over: errors within the target differ.
    {"l_room_adaptive", kAdaptiveRung, l_shaped, true, 1.2e-4},
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
    const double share = 1 - row.space - row.back_side; // -1e-17 in rows that see no patch
    EXPECT_LE(radiosity::row_sum(row), std::max(share, 0.0)) << "row " << i;
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

// Catches: absolute tolerances.
TEST_P(Ladder, PowersOfTwoChangeNoBit) {
  FormFactors expected;
  compute(GetParam().make(), &expected);
  for (const double scale : {0x1p-30, 0x1p-3, 0x1p20}) {
    FormFactors actual;
    compute(moved(GetParam().make(), scale, {0, 0, 0}), &actual);
    EXPECT_TRUE(same_bits(expected.matrix, actual.matrix)) << scale;
  }
}

double largest_difference(const FormFactors& a, const FormFactors& b,
                          std::span<const std::uint32_t> order) {
  double largest = 0;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const std::vector<double> x = a.dense_row(order[i]), y = b.dense_row(i);
    for (std::uint32_t j = 0; j < order.size(); ++j)
      largest = std::max(largest, std::fabs(x[order[j]] - y[j]));
    largest = std::max(largest, std::fabs(a.matrix.row(order[i]).space - b.matrix.row(i).space));
  }
  return largest;
}

// Catches: arithmetic on positions rather than differences, tolerances that do not grow with them.
TEST_P(Ladder, FarFromTheOriginLittleChanges) {
  FormFactors near, far;
  const PolygonList polygons = GetParam().make();
  compute(polygons, &near);
  compute(moved(polygons, 1, {1e6, -1e6, 1e6}), &far);
  std::vector<std::uint32_t> order(polygons.size());
  std::iota(order.begin(), order.end(), 0u);
  const double largest = largest_difference(near, far, order);
  std::printf("%s: 1e6 m away form factors differ by %.1e\n", GetParam().name, largest);
  EXPECT_LE(largest, 1e-6);
}

// Catches: form factors that depend on the order of faces.
TEST_P(Ladder, OrderOfFacesOnlyPermutesTheMatrix) {
  const PolygonList polygons = GetParam().make();
  std::vector<std::uint32_t> order(polygons.size());
  std::iota(order.begin(), order.end(), 0u);
  Random random(5);
  for (std::size_t k = order.size(); k > 1; --k)
    std::swap(order[k - 1], order[random.index(static_cast<std::uint32_t>(k))]);
  PolygonList permuted;
  for (const std::uint32_t k : order)
    permuted.push_back(polygons[k]);
  FormFactors expected, actual;
  compute(polygons, &expected);
  compute(permuted, &actual);
  const double largest = largest_difference(expected, actual, order);
  std::printf("%s: in another order form factors differ by %.1e\n", GetParam().name, largest);
  EXPECT_LE(largest, GetParam().order);
}

INSTANTIATE_TEST_SUITE_P(, Ladder, testing::ValuesIn(kCases),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace hemicube::test
