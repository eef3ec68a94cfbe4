// How much gets past what is between two areas, and the table of what pairs exchange.

#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/exchange_table.h"
#include "radiosity/form_factor/visible_share.h"
#include "tests/support/facets.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

using radiosity::Blocker;
using radiosity::Effort;
using radiosity::ExchangeTable;
using radiosity::PairExchange;
using radiosity::ReceiverExchange;
using radiosity::ShareIntegrator;
using radiosity::VisibleShare;

/// A receiver, a target and what may be in between.
struct Pair {
  std::vector<OwnedFacet> facets; ///< receiver, target, blockers
  std::vector<Blocker> blockers;

  explicit Pair(const PolygonList& polygons) {
    for (const Polygon& polygon : polygons)
      facets.emplace_back(polygon);
    for (std::size_t k = 2; k < facets.size(); ++k)
      blockers.push_back({&facets[k].facet, static_cast<std::uint32_t>(k), false});
  }

  radiosity::ConvexPolygon polygon(std::size_t k) const {
    radiosity::ConvexPolygon polygon;
    for (const Vec3& corner : facets[k].corners)
      polygon.append(corner);
    return polygon;
  }

  /// What receiver and target would exchange.
  double whole() const {
    return radiosity::exchange_area(polygon(0), facets[0].facet.plane.normal, polygon(1),
                                    facets[1].facet.plane.normal, 1e-10)
        .value;
  }

  VisibleShare share(const Effort& effort, std::uint64_t* points = nullptr) const {
    ShareIntegrator integrator;
    require(integrator.init(static_cast<std::uint32_t>(facets.size()), 0x1p-46));
    integrator.set_receiver(facets[0].facet);
    VisibleShare found;
    require(integrator.find(facets[1].facet, blockers, whole(), effort, &found));
    if (points != nullptr)
      *points = integrator.point_count();
    return found;
  }
};

constexpr Effort kTight = {1e-6, 1.0 / 4096, 1u << 18};

PolygonList random_pair(Random& random, int blocker_count) {
  PolygonList polygons;
  const Vec3 apart(0, 0, random.between(0.5, 2));
  const auto quad = [&](const Vec3& at, bool up) {
    const auto side = [&] { return random.between(0.3, 1); };
    const auto lean = [&] { return random.between(-0.3, 0.3); };
    const Vec3 u(side(), lean(), lean()), v(lean(), side(), lean());
    Polygon polygon = {at, at + u, at + u + v, at + v};
    return up ? polygon : reversed(polygon);
  };
  polygons.push_back(quad({random.unit() - 1, random.unit() - 1, 0}, true));
  polygons.push_back(quad(Vec3(random.unit() - 1, random.unit() - 1, 0) + apart, false));
  for (int k = 0; k < blocker_count; ++k)
    polygons.push_back(random_ngon(random, 3 + static_cast<int>(random.index(5)),
                                   apart * random.between(0.2, 0.8) + random.point(-0.3, 0.3),
                                   random.between(0.05, 0.4)));
  return polygons;
}

// Catches: an estimate that is blind to shadows between the points, or that says much more than
// there is; errors that do not follow the tolerance.
TEST(ShareIntegrator, ErrorEstimatesHoldAgainstATightRun) {
  Random random(11);
  struct Level {
    Effort effort;
    double actual = 0, estimated = 0; ///< sums of squares
    int too_low = 0;
  };
  Level levels[] = {{{0.1, 0.25, 1u << 16}}, {{1e-2, 0.1, 1u << 16}}, {{1e-3, 0.01, 1u << 16}}};
  int partly = 0;
  for (int i = 0; i < 60; ++i) {
    const Pair pair(random_pair(random, 1 + i % 5));
    const VisibleShare truth = pair.share({1e-5, 1.0 / 1024, 1u << 16});
    if (!(truth.share > 0.01 && truth.share < 0.99))
      continue;
    ++partly;
    for (Level& level : levels) {
      const VisibleShare found = pair.share(level.effort);
      ASSERT_TRUE(found.share >= 0 && found.share <= 1) << i;
      ASSERT_GE(found.error, 0.0) << i;
      ASSERT_GE(found.doubt, found.error) << i;
      const double actual = std::fabs(found.share - truth.share);
      EXPECT_LE(actual, 4 * level.effort.tolerance) << i << " at " << level.effort.tolerance;
      level.actual += actual * actual;
      level.estimated += found.error * found.error;
      level.too_low += actual > 2 * found.error + 1e-6;
    }
  }
  EXPECT_GT(partly, 30);
  for (const Level& level : levels) {
    const double actual = std::sqrt(level.actual / partly);
    const double estimated = std::sqrt(level.estimated / partly);
    std::printf("tolerance %.0e, %d pairs: RMS error %.1e, RMS estimate %.1e, %d more than twice "
                "too low\n",
                level.effort.tolerance, partly, actual, estimated, level.too_low);
    EXPECT_LE(actual, level.effort.tolerance);
    EXPECT_LE(actual, estimated);
    EXPECT_LE(estimated, 100 * actual) << "the estimate is worth nothing";
    EXPECT_LE(level.too_low, partly / 10);
  }
}

// Catches: a share of 1 that is not exact, or a hidden pair through which something leaks.
TEST(ShareIntegrator, NothingAndEverythingHidden) {
  const Polygon floor = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Polygon ceiling = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const auto level = [](double x0, double x1, double z) {
    return Polygon{{x0, 0, z}, {x1, 0, z}, {x1, 1, z}, {x0, 1, z}};
  };
  for (const Effort& effort : {Effort{1, 1, 1}, Effort{1e-2, 0.1, 65536}}) {
    EXPECT_EQ(Pair({floor, ceiling}).share(effort).share, 1.0);
    EXPECT_EQ(Pair({floor, ceiling, level(3, 4, 0.5)}).share(effort).share, 1.0)
        << "out of the way";
    EXPECT_EQ(Pair({floor, ceiling, level(-1, 0.5, 0.4), level(0.5, 2, 0.4)}).share(effort).share,
              0)
        << "two halves of a wall";
  }
}

// Catches: rules that do not converge, or converge to something else.
TEST(ShareIntegrator, TightRunsAgreeWithTheReference) {
  for (const char* name : {"occ_centre_square", "occ_small_square", "occ_offcentre", "occ_strip1",
                           "occ_tilted_blocker", "occ_near_receiver", "occ_screen_floor_wall"}) {
    const nlohmann::json one = reference_case("formfactors.json", name);
    PolygonList polygons = {points_of(one["P1"]), points_of(one["P2"])};
    for (const auto& blocker : one["blockers"])
      polygons.push_back(points_of(blocker.is_object() ? blocker["vertices"] : blocker));
    const double area = one["A1"], other_area = one["A2"];
    if (other_area < area) // points are placed on the smaller one
      std::swap(polygons[0], polygons[1]);
    const Pair pair(polygons);
    const double whole =
        radiosity::exchange_area(pair.polygon(0), pair.facets[0].facet.plane.normal,
                                 pair.polygon(1), pair.facets[1].facet.plane.normal, 1e-10)
            .value;
    const double exact = one["F12"].get<double>() * area / whole;
    const VisibleShare found = pair.share(kTight);
    std::printf("%s: share %.9f, error %.1e, estimate %.1e\n", name, found.share,
                found.share - exact, found.error);
    EXPECT_NEAR(found.share, exact, 1e-5) << name;
  }
}

// Catches: recursion without end, and points spent where none are allowed.
TEST(ShareIntegrator, SpendsAboutWhatItMay) {
  Random random(12);
  for (int i = 0; i < 20; ++i) {
    const Pair pair(random_pair(random, 3));
    std::uint64_t least = 0;
    pair.share({1, 1, 1}, &least);
    EXPECT_EQ(least, 4u) << "one cell, four points";
    for (const std::uint32_t most : {64u, 1024u, 8192u}) {
      std::uint64_t points = 0;
      pair.share({1e-12, 1e-9, most}, &points);
      EXPECT_LE(points, most + 64);
    }
  }
}

// Catches: shadows kept from the receiver before, or from another target.
TEST(ShareIntegrator, ForgetsTheReceiverBefore) {
  Random random(13);
  ShareIntegrator used;
  require(used.init(8, 0x1p-46));
  for (int i = 0; i < 30; ++i) {
    const Pair pair(random_pair(random, 4));
    for (const Effort& effort : {Effort{1, 1, 1}, Effort{1e-2, 0.1, 4096}}) {
      VisibleShare found;
      used.set_receiver(pair.facets[0].facet);
      require(used.find(pair.facets[1].facet, pair.blockers, pair.whole(), effort, &found));
      const VisibleShare fresh = pair.share(effort);
      EXPECT_EQ(found.share, fresh.share) << i;
      EXPECT_EQ(found.error, fresh.error) << i;
    }
  }
}

// Catches: pairs that get lost between blocks, or end in the wrong row or order.
TEST(ExchangeTable, TransposesPairs) {
  for (const std::uint32_t rows : {0u, 1u, 7u, 8u, 9u, 37u}) {
    Random random(rows);
    ExchangeTable table;
    EXPECT_TRUE(table.empty());
    require(table.init(rows));
    std::vector<std::vector<PairExchange>> pairs(rows), others(rows);
    for (std::uint32_t i = 0; i < rows; ++i) {
      for (std::uint32_t j = 0; j < rows; ++j)
        if (j != i && random.index(3) == 0) {
          const bool is_mutual = random.index(4) != 0; // else it is the row's own
          const std::uint32_t flags = (random.index(2) == 0 ? PairExchange::kEstimated : 0) |
                                      (is_mutual ? PairExchange::kMutual : 0);
          pairs[i].push_back(
              {j, static_cast<float>(i), 0.5f, flags, static_cast<double>(i * 1000 + j)});
          PairExchange other = pairs[i].back();
          other.patch = i;
          if (is_mutual)
            others[j].push_back(other);
        }
      require(table.append_row(i / ExchangeTable::kBlockRows,
                               {pairs[i], 1.0 + i, 0.25 * i, 0.125 * i, i % 2 == 0, 0.0625 * i},
                               {.hemicubes = i}));
    }
    require(table.transpose());
    const auto expect_same = [](std::span<const PairExchange> a,
                                const std::vector<PairExchange>& b) {
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].patch, b[k].patch);
        EXPECT_EQ(a[k].error, b[k].error);
        EXPECT_EQ(a[k].doubt, b[k].doubt);
        EXPECT_EQ(a[k].flags, b[k].flags);
        EXPECT_EQ(a[k].value, b[k].value);
      }
    };
    for (std::uint32_t i = 0; i < rows; ++i) {
      const ReceiverExchange row = table.row(i);
      EXPECT_EQ(row.area, 1.0 + i);
      EXPECT_EQ(row.back_side, 0.25 * i);
      EXPECT_EQ(row.back_side_error, 0.125 * i);
      EXPECT_EQ(row.is_rendered, i % 2 == 0);
      EXPECT_EQ(row.space, 0.0625 * i);
      EXPECT_EQ(table.facts(i).hemicubes, i);
      expect_same(row.pairs, pairs[i]);
      expect_same(table.others(i), others[i]);
    }
  }
}

} // namespace
} // namespace hemicube::test
