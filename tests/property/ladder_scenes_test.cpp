// Scenes whose form factors are known, or known to be those of another scene, on every rung of the
// accuracy ladder: coincident patches, sheets, polygons of many corners, closed and open rooms.

#include "tests/support/facets.h"
#include "tests/support/ladder_levels.h"
#include "tests/support/polygon_lists.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

constexpr LadderLevel kLevels[] = {kHemicubeRung, kAnalyticRung, kAreaRung,
                                   kLooseRung,    kAdaptiveRung, kExactRung};

class EachRung : public testing::TestWithParam<LadderLevel> {
protected:
  void compute(const PolygonList& polygons, FormFactors* factors) const {
    compute_all(patches_of(polygons), GetParam().options(128), 2, factors);
  }
  radiosity::Rung rung() const { return GetParam().rung; }
};

Polygon square(double low, double high, double z, bool up) {
  const Polygon polygon = {{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}};
  return up ? polygon : Polygon(polygon.rbegin(), polygon.rend());
}

// Catches: the back of a sheet that is seen through its front, a sheet that shadows itself.
TEST_P(EachRung, TwoSidesOfASheet) {
  const PolygonList sheet = {square(0, 1, 0, true), square(0, 1, 0, false), square(0, 1, 1, false),
                             square(0, 1, -1, true)};
  const PolygonList above = {sheet[0], sheet[2]}; // what the other half of the scene sees, mirrored
  FormFactors both, half;
  compute(sheet, &both);
  compute(above, &half);
  const double exact = 0.19982489569838738; // par_1x1_gap1
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(both.matrix.row(i).back_side, 0.0) << i;
    const std::vector<double> row = both.dense_row(i);
    for (std::uint32_t j = 0; j < 4; ++j) {
      const bool sees = (i ^ j) == 2;
      EXPECT_NEAR(row[j], sees ? half.dense_row(i / 2)[1 - i / 2] : 0,
                  rung() == radiosity::Rung::kHemicube ? 2e-3 : 1e-12)
          << i << " to " << j;
      if (sees && rung() >= radiosity::Rung::kArea) {
        EXPECT_NEAR(row[j], exact, 1e-5 * exact);
      }
    }
  }
}

// Catches: space that is what happens to be missing: errors of partly visible pairs, backs.
TEST_P(EachRung, OpenScenesSeeSpace) {
  FormFactors alone, pair;
  compute({square(0, 1, 0, true)}, &alone);
  EXPECT_EQ(alone.matrix.row(0).space, 1.0);
  compute({square(0, 1, 0, true), square(0, 1, 1, false)}, &pair);
  const bool is_area = rung() >= radiosity::Rung::kArea;
  const double exact = is_area ? 0.19982489569838738 : 0.23945602;
  for (const std::uint64_t i : {0u, 1u}) {
    EXPECT_NEAR(pair.matrix.row(i).space, 1 - exact,
                rung() == radiosity::Rung::kHemicube ? 2e-3 : 1e-5);
    EXPECT_EQ(pair.matrix.row(i).back_side, 0.0);
  }
  // The back of the second plate: as much is lost there as its front would get.
  FormFactors averted;
  compute({square(0, 1, 0, true), square(0, 1, 1, true)}, &averted);
  EXPECT_NEAR(averted.matrix.row(0).back_side, 1 - pair.matrix.row(0).space, 1e-12);
  EXPECT_EQ(averted.matrix.row(1).space, 1.0);
}

/// A convex polygon cut into quads around its first corner.
PolygonList fan(const Polygon& polygon) {
  PolygonList quads;
  for (std::size_t k = 1; k + 2 < polygon.size() + 1; k += 2) {
    quads.push_back({polygon[0], polygon[k], polygon[k + 1]});
    if (k + 2 < polygon.size())
      quads.back().push_back(polygon[k + 2]);
  }
  return quads;
}

// Catches: patches of more corners than a face may have: pieces forgotten, seen twice, shading one
// another.
TEST_P(EachRung, ADiskIsTheSumOfItsPieces) {
  for (const bool is_blocked : {false, true}) {
    if (is_blocked && rung() == radiosity::Rung::kExact)
      continue; // slow
    // Partly hidden, a patch of several pieces is seen from few points on rung `area`.
    if (is_blocked && rung() == radiosity::Rung::kArea)
      continue;
    const double tolerance = !is_blocked                       ? 1e-6
                             : rung() < radiosity::Rung::kArea ? 2e-3
                                                               : 0.1 * GetParam().error;
    const Polygon disk = regular(48); // at height 1, facing up
    PolygonList rest = {{{1, -1, 2}, {1, 1, 2}, {3, 1, 2}, {3, -1, 2}}};
    if (is_blocked)
      append(&rest, {{{1.8, -0.4, 1.5}, {2.7, -0.4, 1.5}, {2.7, 0.6, 1.6}, {1.8, 0.6, 1.6}}});
    PolygonList whole = {disk}, pieces = fan(disk);
    const std::size_t count = pieces.size();
    append(&whole, rest);
    append(&pieces, rest);
    FormFactors of_whole, of_pieces;
    compute(whole, &of_whole);
    compute(pieces, &of_pieces);
    const PatchSet patches = patches_of(pieces);
    double area = 0, sent = 0, seen = 0, space = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      area += patches.area[k];
      sent += patches.area[k] * of_pieces.dense_row(k)[count];
      space += patches.area[k] * of_pieces.matrix.row(k).space;
      seen += of_pieces.dense_row(count)[k];
    }
    const double as_target = of_whole.dense_row(1)[0], as_receiver = of_whole.dense_row(0)[1];
    EXPECT_GT(seen, 0.1);
    EXPECT_NEAR(as_target, seen, tolerance * seen) << "as a target";
    if (rung() >= radiosity::Rung::kArea) { // from its centre a disk sees something else
      EXPECT_NEAR(as_receiver, sent / area, tolerance * sent / area) << "as a receiver";
      EXPECT_NEAR(of_whole.matrix.row(0).space, space / area, tolerance);
    }
    std::printf("%s, %s: a disk differs from its pieces by %.1e\n", GetParam().name,
                is_blocked ? "blocked" : "free", std::fabs(as_target / seen - 1));
  }
}

// Catches: crashes, NaN, rows that do not close where nothing is regular.
TEST_P(EachRung, SoupsAreFiniteAndClosed) {
  const int count = rung() == radiosity::Rung::kExact ? 5 : 30;
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    Random random(seed);
    PolygonList polygons;
    for (int k = 0; k < count; ++k)
      polygons.push_back(random_ngon(random, 3 + static_cast<int>(random.index(k == 0 ? 37 : 6)),
                                     random.point(-1, 1), random.between(0.02, 0.9)));
    FormFactors factors;
    compute(polygons, &factors);
    for (std::uint32_t i = 0; i < factors.matrix.row_count(); ++i) {
      const radiosity::RowView row = factors.matrix.row(i);
      double sum = row.space + row.back_side;
      for (const double value : factors.dense_row(i)) {
        EXPECT_TRUE(value >= 0 && value <= 1) << value;
        sum += value;
      }
      EXPECT_NEAR(sum, 1, 1e-12) << "seed " << seed << ", row " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, EachRung, testing::ValuesIn(kLevels), [](const auto& made) {
  std::string name = made.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

/// What rays that leave a patch cosine-distributed meet: the front of each patch, then space, then
/// backs.
std::vector<double> cast_row(Random& random, const std::vector<OwnedFacet>& facets,
                             std::size_t from, int rays) {
  std::vector<double> hits(facets.size() + 2, 0);
  const Vec3& normal = facets[from].facet.plane.normal;
  const Vec3 side = unit(facets[from].corners[1] - facets[from].corners[0]);
  for (int k = 0; k < rays; ++k) {
    double x = 1, y = 1;
    while (x * x + y * y >= 1) {
      x = random.between(-1, 1);
      y = random.between(-1, 1);
    }
    const Vec3 to = side * x + glm::cross(normal, side) * y + normal * std::sqrt(1 - x * x - y * y);
    const Vec3 at = random_place(random, facets[from].facet), end = at + to * 1e3;
    double nearest = 1;
    std::size_t hit = facets.size();
    for (std::size_t j = 0; j < facets.size(); ++j) {
      const auto& plane = facets[j].facet.plane;
      const double here = plane.side(at), there = plane.side(end);
      const double distance = here / (here - there);
      if (j == from || !(distance < nearest) ||
          crossing(at, end, facets[j].facet, 0) != Crossing::kCrosses)
        continue;
      nearest = distance;
      hit = here > 0 ? j : facets.size() + 1;
    }
    hits[hit] += 1.0 / rays;
  }
  return hits;
}

// Catches: anything between a scene and its rows that takes a patch for hidden or seen which is
// not: by brute force, without any of the code that is tested.
TEST(LadderRows, AgreeWithRays) {
  constexpr int kRays = 10000;
  double largest = 0, squares = 0;
  int count = 0;
  for (const std::uint32_t seed : {21u, 22u, 23u, 24u}) {
    Random random(seed);
    PolygonList polygons;
    for (int k = 0; k < 20; ++k)
      polygons.push_back(random_ngon(random, 3 + static_cast<int>(random.index(k == 0 ? 37 : 6)),
                                     random.point(-0.8, 0.8), random.between(0.1, 0.9)));
    std::vector<OwnedFacet> facets;
    for (const Polygon& polygon : polygons)
      facets.emplace_back(polygon);
    FormFactors factors;
    compute_all(patches_of(polygons), kAdaptiveRung.options(64), 2, &factors);
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
      std::vector<double> row = factors.dense_row(i);
      row.push_back(factors.matrix.row(i).space);
      row.push_back(factors.matrix.row(i).back_side);
      const std::vector<double> rays = cast_row(random, facets, i, kRays);
      for (std::size_t j = 0; j < row.size(); ++j) {
        const double noise = std::sqrt((row[j] * (1 - row[j]) + 2.0 / kRays) / kRays);
        const double deviation = (row[j] - rays[j]) / noise;
        EXPECT_LE(std::fabs(deviation), 5) << "seed " << seed << ", " << i << " to " << j << ": "
                                           << row[j] << ", rays " << rays[j];
        largest = std::max(largest, std::fabs(deviation));
        squares += rays[j] > 0 ? deviation * deviation : 0;
        count += rays[j] > 0;
      }
    }
  }
  std::printf("rows and rays: %d entries, RMS %.2f and at most %.1f standard deviations\n", count,
              std::sqrt(squares / count), largest);
  EXPECT_GT(count, 500);
  EXPECT_LT(std::sqrt(squares / count), 1.1);
}

} // namespace
} // namespace hemicube::test
