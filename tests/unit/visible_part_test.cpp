// Exact visibility from a point, against rays and closed cases.

#include "radiosity/form_factor/lambert.h"
#include "tests/support/facets.h"
#include "tests/support/polygon_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

using radiosity::Blocker;
using radiosity::point_to_polygon;
using radiosity::PointFormFactors;

const Vec3 kEye(0, 0, 0), kUp(0, 0, 1);

/// [x0, x1] x [y0, y1] at height z, seen from below.
Polygon overhead(double x0, double x1, double y0, double y1, double z) {
  return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

/// In the plane x, across y.
Polygon wall(double x, double z0, double z1) {
  return {{x, -9, z0}, {x, 9, z0}, {x, 9, z1}, {x, -9, z1}};
}

double from_eye(const Polygon& polygon) {
  return point_to_polygon(kEye, kUp, polygon);
}

/// What is seen of [-1, 1]^2 at height 2 past blockers.
PointFormFactors of_square(const PolygonList& blockers, bool in_target_plane = false) {
  const OwnedFacet target(overhead(-1, 1, -1, 1, 2));
  std::vector<OwnedFacet> facets;
  for (const Polygon& polygon : blockers)
    facets.emplace_back(polygon);
  std::vector<Blocker> list;
  for (const OwnedFacet& owned : facets)
    list.push_back({&owned.facet, 0, in_target_plane});
  const PointFormFactors found = visible_part(kEye, kUp, target.facet, list);
  EXPECT_NEAR(found.whole, from_eye(target.corners), 1e-15);
  return found;
}

double visible_of_square(const PolygonList& blockers, bool in_target_plane = false) {
  return of_square(blockers, in_target_plane).visible;
}

constexpr double kRounding = 1e-13;

// Catches: shadows of the wrong side, pieces counted twice or lost, blockers that count twice where
// they overlap.
TEST(VisiblePart, PartsOfASquare) {
  const double whole = from_eye(overhead(-1, 1, -1, 1, 2));
  EXPECT_EQ(visible_of_square({}), whole);
  const Polygon half = overhead(-0.5, 0, -0.5, 0.5, 1);
  EXPECT_NEAR(visible_of_square({half}), whole / 2, kRounding);
  EXPECT_NEAR(visible_of_square({reversed(half)}), whole / 2, kRounding)
      << "opaque from both sides";
  EXPECT_NEAR(visible_of_square({half, half}), whole / 2, kRounding);
  EXPECT_NEAR(visible_of_square({half, overhead(-9, 9, -9, 0, 0.1)}), whole / 4, kRounding);
  EXPECT_EQ(visible_of_square({overhead(-0.5, 0.5, -0.5, 0.5, 1)}), 0.0) << "exactly filled";
  EXPECT_EQ(visible_of_square({half, overhead(0, 9, -9, 9, 1.5)}), 0.0) << "two halves";
  const double middle = from_eye(overhead(-0.25, 0.25, -0.25, 0.25, 1));
  EXPECT_NEAR(visible_of_square({overhead(-0.25, 0.25, -0.25, 0.25, 1)}), whole - middle,
              kRounding);
  EXPECT_EQ(visible_of_square({overhead(-0.5, 0.5, -0.5, 0.5, 3)}), whole) << "beyond the target";
  EXPECT_EQ(visible_of_square({overhead(0.5, 9, -9, 9, 1)}), whole) << "beside it, touching";
}

// Catches: a near plane, points behind the eye mirrored to the front, and the part of a blocker
// beyond the target that still casts a shadow.
TEST(VisiblePart, BlockersThatCrossThePlanesOfEyeAndTarget) {
  const double whole = from_eye(overhead(-1, 1, -1, 1, 2));
  const double past_wall = from_eye(overhead(-1, 0.5, -1, 1, 2));
  EXPECT_NEAR(visible_of_square({wall(0.5, 1, 2)}), past_wall, kRounding) << "touches the target";
  EXPECT_NEAR(visible_of_square({wall(0.5, 1, 3)}), past_wall, kRounding) << "crosses its plane";
  EXPECT_NEAR(visible_of_square({wall(0.5, 0, 3)}), past_wall, kRounding) << "touches the eye's";
  EXPECT_NEAR(visible_of_square({wall(0.5, -5, 3)}), past_wall, kRounding) << "crosses the eye's";
  EXPECT_EQ(visible_of_square({wall(0.5, -5, 0)}), whole) << "below the eye's, touching";
  EXPECT_EQ(visible_of_square({overhead(-9, 9, -9, 9, -1)}), whole) << "behind the eye";
  EXPECT_EQ(visible_of_square({wall(0.5, 2, 3)}), whole) << "stands on the target from behind";
  EXPECT_EQ(visible_of_square({wall(0, 0.5, 3)}), whole) << "edge-on through the eye";
  EXPECT_EQ(visible_of_square({overhead(-9, 9, -9, 9, 0)}), whole) << "the eye lies on it";
  // Leans from below the eye's plane over the eye: through x = 1 at z = -1 and x = -0.5 at z = 2.
  const Polygon leaning = {{1, -9, -1}, {1, 9, -1}, {-0.5, 9, 2}, {-0.5, -9, 2}};
  EXPECT_NEAR(visible_of_square({leaning}), from_eye(overhead(-1, -0.5, -1, 1, 2)), kRounding);
  const Polygon farther = {{1, -9, -1}, {1, 9, -1}, {-1.5, 9, 4}, {-1.5, -9, 4}};
  EXPECT_NEAR(visible_of_square({farther}), from_eye(overhead(-1, -0.5, -1, 1, 2)), kRounding)
      << "the same plane, through the target";
}

// Catches: eyes behind the target or in its plane that see it; a target below the eye's horizon.
TEST(VisiblePart, NothingIsSeenFromBehind) {
  const OwnedFacet target(overhead(-1, 1, -1, 1, 2));
  const OwnedFacet blocker(overhead(-1, 0, -1, 1, 1));
  const Blocker list[] = {{&blocker.facet, 0, false}};
  for (const double height : {2.0, 2.5}) {
    const PointFormFactors found = visible_part({0, 0, height}, -kUp, target.facet, list);
    EXPECT_EQ(found.whole, 0.0);
    EXPECT_EQ(found.visible, 0.0);
  }
  const PointFormFactors below = visible_part(kEye, -kUp, target.facet, list);
  EXPECT_EQ(below.whole, 0.0);
  EXPECT_EQ(below.visible, 0.0);
}

// Catches: coincident surfaces both of which are seen, or neither; a shadow that needs distance.
TEST(VisiblePart, BlockersInTheTargetsPlane) {
  const double whole = from_eye(overhead(-1, 1, -1, 1, 2));
  EXPECT_EQ(visible_of_square({overhead(-1, 1, -1, 1, 2)}, true), 0.0) << "a duplicate";
  EXPECT_EQ(visible_of_square({reversed(overhead(-1, 1, -1, 1, 2))}, true), 0.0);
  EXPECT_NEAR(visible_of_square({overhead(0, 3, -2, 2, 2)}, true), whole / 2, kRounding);
  EXPECT_NEAR(visible_of_square({overhead(0, 1, -1, 1, 2), overhead(-1, 1, 0, 1, 2)}, true),
              whole / 4, kRounding);
  EXPECT_EQ(visible_of_square({overhead(1, 2, -1, 1, 2)}, true), whole) << "beside it, touching";
  const double hole = from_eye(overhead(-0.5, 0.25, -0.5, 0.5, 2));
  EXPECT_NEAR(visible_of_square({overhead(-0.5, 0.25, -0.5, 0.5, 2)}, true), whole - hole,
              kRounding);
  // The same polygons as ordinary blockers lie in the target and hide nothing of it.
  EXPECT_NEAR(visible_of_square({overhead(0, 3, -2, 2, 2)}), whole, kRounding);
}

// Catches: a stack of pieces that loses some, results that depend on the order by more than
// rounding.
TEST(VisiblePart, AChessBoardOfBlockers) {
  constexpr int kFields = 12;
  PolygonList blockers;
  double seen = 0;
  for (int i = 0; i < kFields; ++i)
    for (int j = 0; j < kFields; ++j) {
      const double x = 2.0 * i / kFields - 1, y = 2.0 * j / kFields - 1, step = 2.0 / kFields;
      if ((i + j) % 2 == 0)
        seen += from_eye(overhead(x, x + step, y, y + step, 2));
      else
        blockers.push_back(overhead(x / 2, (x + step) / 2, y / 2, (y + step) / 2, 1));
    }
  EXPECT_NEAR(visible_of_square(blockers), seen, 1e-12);
  for (const std::uint32_t seed : {1u, 2u, 3u})
    EXPECT_NEAR(visible_of_square(shuffled(blockers, seed)), seen, 1e-12) << seed;
  PolygonList twice = blockers;
  append(&twice, blockers);
  EXPECT_NEAR(visible_of_square(twice), seen, 1e-12);
  append(&blockers, {overhead(-9, 9, -9, 9, 0.5)});
  EXPECT_EQ(visible_of_square(blockers), 0.0);
}

// Catches: shadows of many-cornered blockers that are cut short.
TEST(VisiblePart, ABlockerOfThirtyTwoCorners) {
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const Polygon disk = random_ngon(random, 32, {0, 0, 1}, random.between(0.05, 0.2));
    const double shadow = std::fabs(from_eye(disk)); // within the target's image
    EXPECT_NEAR(visible_of_square({disk}), from_eye(overhead(-1, 1, -1, 1, 2)) - shadow, kRounding);
    EXPECT_NEAR(visible_of_square({reversed(disk)}), from_eye(overhead(-1, 1, -1, 1, 2)) - shadow,
                kRounding);
  }
}

/// A point that sees a parallelogram, and polygons that may be in the way: some in its plane, some
/// through eye or target.
struct RandomView {
  Vec3 eye, normal;
  std::vector<OwnedFacet> facets; ///< [0] is the target
  std::vector<Blocker> blockers;

  RandomView(Random& random, int blocker_count) {
    const auto frame = random_frame(random);
    eye = random.point(-0.5, 0.5);
    normal = frame[2];
    const Vec3 corner = random.point(-1, 1) + frame[2] * random.between(0, 2);
    const auto other = random_frame(random);
    const Vec3 u = other[0] * random.between(0.3, 2);
    const Vec3 v = (other[1] + other[0] * random.between(-0.5, 0.5)) * random.between(0.3, 2);
    Polygon target = {corner, corner + u, corner + u + v, corner + v};
    if (glm::dot(glm::cross(u, v), eye - corner) < 0)
      target = reversed(target);
    facets.emplace_back(target);
    for (int k = 0; k < blocker_count; ++k) {
      if (k % 4 == 3) {
        const Vec3 from = spot(target, random.between(-0.5, 1), random.between(-0.5, 1));
        const Vec3 a = (target[1] - target[0]) * random.between(0.1, 1);
        const Vec3 b = (target[3] - target[0]) * random.between(0.1, 1);
        facets.emplace_back(Polygon{from, from + a, from + a + b, from + b});
      } else {
        const Vec3 between =
            eye + (spot(target, random.unit(), random.unit()) - eye) * random.between(-0.1, 1.1);
        facets.emplace_back(random_ngon(random, 3 + static_cast<int>(random.index(6)), between,
                                        random.between(0.02, 0.6)));
      }
    }
    for (int k = 0; k < blocker_count; ++k)
      blockers.push_back({&facets[static_cast<std::size_t>(k) + 1].facet, 0, k % 4 == 3});
  }
};

// Catches: whatever the closed cases have too much symmetry for.
TEST(VisiblePart, AgreesWithRays) {
  Random random(6);
  constexpr int kRays = 80;
  double squares = 0, sum = 0, worst = 0;
  int count = 0, partly = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomView view(random, 1 + i % 12);
    const OwnedFacet& target = view.facets[0];
    const PointFormFactors found = visible_part(view.eye, view.normal, target.facet, view.blockers);
    const PointFormFactors rays = sampled(view.eye, view.normal, target, view.blockers, kRays);
    ASSERT_GE(found.visible, 0.0) << i;
    ASSERT_LE(found.visible, found.whole) << i;
    if (!(found.whole > 1e-3))
      continue;
    // The kernel varies across a cell only if the eye is near.
    if (std::fabs(rays.whole - found.whole) > 1e-3 * found.whole)
      continue;
    const double difference = found.visible / found.whole - rays.visible / rays.whole;
    EXPECT_NEAR(difference, 0, 0.02) << i;
    worst = std::max(worst, std::fabs(difference));
    squares += difference * difference;
    sum += difference;
    ++count;
    partly += found.visible > 0 && found.visible < found.whole;
  }
  const double rms = std::sqrt(squares / count);
  std::printf(
      "shares of %d targets, %d partly seen: RMS difference %.1e, mean %.1e, largest %.1e\n", count,
      partly, rms, sum / count, worst);
  EXPECT_GT(partly, 100);
  EXPECT_LT(rms, 3e-3) << "what rays on a grid of 80 x 80 leave";
  EXPECT_LT(std::fabs(sum / count), 5e-4);
}

// Catches: absolute tolerances.
TEST(VisiblePart, PowersOfTwoChangeNoBit) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const RandomView view(random, 1 + i % 8);
    const auto at_scale = [&](double scale) {
      std::vector<OwnedFacet> facets;
      for (const OwnedFacet& owned : view.facets)
        facets.emplace_back(moved({owned.corners}, scale, {0, 0, 0})[0]);
      std::vector<Blocker> blockers = view.blockers;
      for (std::size_t k = 0; k < blockers.size(); ++k)
        blockers[k].facet = &facets[k + 1].facet;
      return visible_part(view.eye * scale, view.normal, facets[0].facet, blockers);
    };
    const PointFormFactors one = at_scale(1);
    for (const double scale : {0x1p-30, 0x1p20}) {
      EXPECT_EQ(at_scale(scale).visible, one.visible) << i;
      EXPECT_EQ(at_scale(scale).whole, one.whole) << i;
    }
  }
}

} // namespace
} // namespace hemicube::test
