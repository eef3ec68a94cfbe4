// What may lie between two facets, against rays.

#include "radiosity/form_factor/shaft.h"
#include "tests/support/facets.h"
#include "tests/support/polygon_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

using radiosity::Facet;
using radiosity::lie_side_by_side;
using radiosity::Shaft;
using Verdict = Shaft::Verdict;

constexpr double kTolerance = 0x1p-46;

/// A rectangle with corners on a grid of quarters, normal along any axis: among a few of these,
/// planes, edges and corners coincide all the time.
Polygon grid_rectangle(Random& random) {
  const auto quarters = [&](std::uint32_t count) { return random.index(count) * 0.25; };
  const int axis = static_cast<int>(random.index(3));
  Vec3 u(0, 0, 0), v(0, 0, 0);
  u[(axis + 1) % 3] = 0.25 + quarters(4);
  v[(axis + 2) % 3] = 0.25 + quarters(4);
  const Vec3 corner(quarters(5), quarters(5), quarters(5));
  if (random.index(2) == 0)
    std::swap(u, v);
  return {corner, corner + u, corner + u + v, corner + v};
}

Polygon any_polygon(Random& random) {
  return random_ngon(random, 3 + static_cast<int>(random.index(6)), random.point(-1, 1),
                     random.between(0.1, 1.5));
}

/// What rays between two facets say of a blocker.
struct Rays {
  int cross = 0, miss = 0;
  int all() const { return cross + miss; }
};
Rays cast(Random& random, const Facet& p, const Facet& q, const Facet& blocker, int count) {
  Rays rays;
  for (int k = 0; k < count; ++k) {
    const Vec3 a = random_place(random, p), b = random_place(random, q);
    if (!(p.plane.side(b) > 1e-9 && q.plane.side(a) > 1e-9))
      continue;
    const Crossing found = crossing(a, b, blocker, 1e-9);
    rays.cross += found == Crossing::kCrosses;
    rays.miss += found == Crossing::kMisses;
  }
  return rays;
}

struct Counts {
  int misses = 0, may_block = 0, blocks_all = 0, in_doubt_for_nothing = 0;
};

/// Tests random triples; half of the receivers are points if wanted.
Counts compare(std::uint32_t seed, int triples, Polygon (*make)(Random&)) {
  Random random(seed);
  Counts counts;
  for (int i = 0; i < triples; ++i) {
    const OwnedFacet area(make(random));
    const OwnedFacet point(random_place(random, area.facet), area.facet.plane.normal);
    const Facet& p = i % 2 == 0 ? area.facet : point.facet;
    const OwnedFacet q(make(random)), blocker(make(random));
    Shaft shaft(p, q.facet, kTolerance);
    const Verdict verdict = shaft.test(blocker.facet);
    EXPECT_EQ(shaft.test(blocker.facet), verdict) << i << ": a shaft forgot";
    // The facets may be exchanged, and a blocker hides from both sides.
    Shaft back(q.facet, p, kTolerance);
    EXPECT_EQ(back.test(blocker.facet), verdict) << i;
    const OwnedFacet other_side(reversed(blocker.corners));
    EXPECT_EQ(shaft.test(other_side.facet), verdict) << i;
    const Rays rays = cast(random, p, q.facet, blocker.facet, 60);
    if (verdict == Verdict::kMisses) {
      EXPECT_EQ(rays.cross, 0) << i << ": a blocked shaft is taken for free";
    }
    if (verdict == Verdict::kBlocksAll) {
      EXPECT_EQ(rays.miss, 0) << i << ": a ray gets past what is said to block all";
    }
    counts.misses += verdict == Verdict::kMisses;
    counts.may_block += verdict == Verdict::kMayBlock;
    counts.blocks_all += verdict == Verdict::kBlocksAll;
    counts.in_doubt_for_nothing +=
        verdict == Verdict::kMayBlock && rays.all() > 30 && rays.cross == 0;
  }
  std::printf("%d misses, %d may block (%d of them without a blocked ray), %d block all\n",
              counts.misses, counts.may_block, counts.in_doubt_for_nothing, counts.blocks_all);
  return counts;
}

// Catches: a plane of the hull with the wrong side out, a hull of the boxes, a corner forgotten.
TEST(Shaft, VerdictsAgreeWithRaysAmongRandomPolygons) {
  const Counts counts = compare(1, 20000, any_polygon);
  EXPECT_GT(counts.misses, 4000);
  EXPECT_GT(counts.may_block, 2000);
  EXPECT_GT(counts.blocks_all, 20);
  EXPECT_LT(counts.in_doubt_for_nothing, counts.may_block / 4) << "the hull is too wide";
}

// Catches: the same where planes, edges and corners coincide; coplanar blockers taken for walls in
// between; tolerances that open a gap at a touching edge.
TEST(Shaft, VerdictsAgreeWithRaysAmongAlignedRectangles) {
  const Counts counts = compare(2, 40000, grid_rectangle);
  EXPECT_GT(counts.misses, 20000);
  EXPECT_GT(counts.may_block, 2000);
  EXPECT_GT(counts.blocks_all, 50);
}

const Polygon kFloor = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Polygon kCeiling = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};

Verdict between_floor_and_ceiling(const Polygon& blocker) {
  const OwnedFacet floor(kFloor), ceiling(kCeiling), between(blocker);
  Shaft shaft(floor.facet, ceiling.facet, kTolerance);
  return shaft.test(between.facet);
}

Polygon level(double x0, double x1, double z) {
  return {{x0, 0, z}, {x1, 0, z}, {x1, 1, z}, {x0, 1, z}};
}

// Catches: a blocker that just fills the shaft and is not seen to, or that leaves a slit and is
// taken to; contact mistaken for occlusion.
TEST(Shaft, ClosedCases) {
  EXPECT_EQ(between_floor_and_ceiling(level(-1e-9, 1, 0.5)), Verdict::kBlocksAll);
  EXPECT_EQ(between_floor_and_ceiling(level(0, 1, 0.01)), Verdict::kBlocksAll) << "just fills it";
  EXPECT_EQ(between_floor_and_ceiling(level(1e-9, 1, 0.5)), Verdict::kMayBlock);
  EXPECT_EQ(between_floor_and_ceiling(level(0, 0.5, 0.5)), Verdict::kMayBlock);
  EXPECT_EQ(between_floor_and_ceiling(level(1, 2, 0.5)), Verdict::kMisses) << "touches an edge";
  EXPECT_EQ(between_floor_and_ceiling(level(0, 0.5, 0)), Verdict::kMisses) << "lies on the floor";
  EXPECT_EQ(between_floor_and_ceiling(level(0, 1, 1)), Verdict::kMisses) << "lies on the ceiling";
  EXPECT_EQ(between_floor_and_ceiling(level(0, 1, -0.1)), Verdict::kMisses);
  const Polygon wall = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  EXPECT_EQ(between_floor_and_ceiling(wall), Verdict::kMisses) << "a side of the shaft";
  const Polygon stands = {{0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, 0.5}, {0.5, 0, 0.5}};
  EXPECT_EQ(between_floor_and_ceiling(stands), Verdict::kMayBlock) << "stands on the floor";
  const Polygon crosses = {{0.5, 0, -1}, {0.5, 1, -1}, {0.5, 1, 0.5}, {0.5, 0, 0.5}};
  EXPECT_EQ(between_floor_and_ceiling(crosses), Verdict::kMayBlock);
}

// Catches: planes of the shaft through an edge that is not there, or a box for a pyramid.
TEST(Shaft, OfAPointIsAPyramid) {
  const OwnedFacet eye({0.5, 0.5, 0}, {0, 0, 1}), ceiling(kCeiling);
  Shaft shaft(eye.facet, ceiling.facet, kTolerance);
  const auto at = [&](double x0, double x1, double z) {
    const OwnedFacet blocker(Polygon{
        {x0, 0.5 - z / 2, z}, {x1, 0.5 - z / 2, z}, {x1, 0.5 + z / 2, z}, {x0, 0.5 + z / 2, z}});
    return shaft.test(blocker.facet);
  };
  EXPECT_EQ(at(0.25, 0.75, 0.5), Verdict::kBlocksAll);
  EXPECT_EQ(at(0.375, 0.625, 0.25), Verdict::kBlocksAll);
  EXPECT_EQ(at(0.376, 0.625, 0.25), Verdict::kMayBlock);
  EXPECT_EQ(at(0.76, 1, 0.5), Verdict::kMisses) << "in the box, beside the pyramid";
  EXPECT_EQ(at(0.74, 1, 0.5), Verdict::kMayBlock);
}

// Catches: neighbours of a warped wall that occlude one another by its warp, and steps and folds
// that are taken for warps.
TEST(SideBySide, NeighboursInAPlaneDoNotOccludeOneAnother) {
  const auto beside = [](double x0, double z0, double z1) {
    return Polygon{{x0, 0, z0}, {x0 + 1, 0, z1}, {x0 + 1, 1, z1}, {x0, 1, z0}};
  };
  const OwnedFacet floor(kFloor);
  const auto lies_beside_floor = [&](const Polygon& polygon) {
    const OwnedFacet other(polygon), turned_over(reversed(polygon));
    const bool lies = lie_side_by_side(floor.facet, other.facet, kTolerance);
    EXPECT_EQ(lie_side_by_side(other.facet, floor.facet, kTolerance), lies);
    EXPECT_EQ(lie_side_by_side(floor.facet, turned_over.facet, kTolerance), lies);
    return lies;
  };
  EXPECT_TRUE(lies_beside_floor(beside(1, 0, 0)));
  EXPECT_TRUE(lies_beside_floor(beside(1.5, 0, 0))) << "a gap";
  EXPECT_TRUE(lies_beside_floor(beside(1, 0, 1e-4))) << "a fold of 1e-4";
  EXPECT_FALSE(lies_beside_floor(beside(1, 0, 1e-3))) << "a fold of 1e-3";
  EXPECT_FALSE(lies_beside_floor(beside(1, 1e-2, 1e-2))) << "a step";
  EXPECT_FALSE(lies_beside_floor(beside(0.5, 0, 0))) << "overlaps";
  EXPECT_FALSE(lies_beside_floor(kFloor));
  // Far from the origin a tolerance of its own counts.
  const Vec3 far(1e6, 0, 1e6);
  PolygonList moved_pair = moved({kFloor, beside(1, 0, 0)}, 1, far);
  const OwnedFacet a(moved_pair[0]), b(moved_pair[1]);
  EXPECT_TRUE(lie_side_by_side(a.facet, b.facet, 64 * 0x1p-52 * 1e6));
}

} // namespace
} // namespace hemicube::test
