// Form factors of polygons that nothing stands between: a point's (Lambert) and an area's, against
// the reference data and against what must hold for any polygons.

#include "radiosity/elementary.h"
#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/lambert.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

using radiosity::AreaIntegral;
using radiosity::ConvexPolygon;
using radiosity::exchange_area;
using radiosity::point_to_polygon;

ConvexPolygon polygon_of(const std::vector<Vec3>& corners) {
  ConvexPolygon polygon;
  for (const Vec3& corner : corners)
    polygon.append(corner);
  return polygon;
}

Vec3 normal_of(const std::vector<Vec3>& corners) {
  return unit(radiosity::area_vector(corners));
}

AreaIntegral exchange(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                      double relative_error) {
  return exchange_area(polygon_of(p), normal_of(p), polygon_of(q), normal_of(q), relative_error);
}

template <class Function>
std::vector<Vec3> mapped(std::vector<Vec3> polygon, const Function& function) {
  for (Vec3& corner : polygon)
    corner = function(corner);
  return polygon;
}

/// A pair of polygons of 3..9 corners, 0.05 .. 2 in size, 0 .. 4 apart.
struct RandomPair {
  std::vector<Vec3> p, q;

  explicit RandomPair(Random& random) {
    const auto make = [&](const Vec3& centre) {
      return random_ngon(random, 3 + static_cast<int>(random.index(7)), centre,
                         std::ldexp(random.between(0.5, 1), 1 - static_cast<int>(random.index(5))));
    };
    p = make(random.point(-0.1, 0.1));
    q = make(random.point(-2, 2));
  }
};

/// Sum over 4 x 4 parts of both polygons at the tightest error.
AreaIntegral by_parts(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  AreaIntegral sum;
  for (const auto& half_p : halves(p, 0.4))
    for (const auto& part_p : halves(half_p, 0.55))
      for (const auto& half_q : halves(q, 0.35))
        for (const auto& part_q : halves(half_q, 0.6)) {
          const AreaIntegral one = exchange(part_p, part_q, 1e-11);
          sum.value += one.value;
          sum.error += one.error;
        }
  return sum;
}

std::vector<nlohmann::json> unoccluded(bool points) {
  std::vector<nlohmann::json> selected;
  const nlohmann::json all = reference_json("formfactors.json");
  for (const nlohmann::json& one : all["cases"])
    if ((one["P1"].size() < 3) == points && !(one.contains("blockers") && !one["blockers"].empty()))
      selected.push_back(one);
  return selected;
}

// Catches: a lost sign, a wrong clip at the horizon, acos instead of atan2, cancellation far away.
TEST(PointToPolygon, AgreesWithTheReference) {
  for (const nlohmann::json& one : unoccluded(true)) {
    const double exact = one["F12"];
    const Vec3 eye = point_of(one["P1"][0]), normal = point_of(one["normal1"]);
    const auto corners = points_of(one["P2"]);
    const double value = point_to_polygon(eye, normal, corners);
    EXPECT_NEAR(std::fabs(value), exact, 1e-12 * exact) << one["name"]; // one is given from behind
    const std::vector<Vec3> turned_over(corners.rbegin(), corners.rend());
    EXPECT_NEAR(point_to_polygon(eye, normal, turned_over), -value, 1e-12 * exact) << one["name"];
  }
}

// Catches: a contour sum that cancels, or a joint between the contour sum and quadrature.
TEST(PointToPolygon, FarPolygonsKeepTheirDigits) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::ldexp(1.0, -static_cast<int>(random.index(20)));
    const auto frame = random_frame(random);
    // A square seen face to face, off the receiver's normal: the kernel's series in size.
    const double d = random.between(1, 2), c = random.between(0.05, 1);
    const Vec3 normal = frame[2] * c + frame[0] * std::sqrt(1 - c * c);
    std::vector<Vec3> square;
    for (const auto& [x, y] : {std::array{-1, -1}, {-1, 1}, {1, 1}, {1, -1}})
      square.push_back(frame[2] * d + frame[0] * (x * size / 2) + frame[1] * (y * size / 2));
    const double value = point_to_polygon(Vec3(0, 0, 0), normal, square);
    if (size * 8 > c)
      continue; // the horizon may cut it
    // Both halves of the square, whose radius is smaller: other orders, other methods.
    double parts = 0;
    for (const auto& half : halves(square, 0.5))
      for (const auto& quarter : halves(half, 0.5))
        parts += point_to_polygon(Vec3(0, 0, 0), normal, quarter);
    EXPECT_NEAR(parts, value, 2e-12 / c * value) << size;
    const double kernel = size * size * c / (radiosity::kPi * d * d);
    EXPECT_NEAR(value, kernel, (4 * size * size + 1e-15 / size) * kernel)
        << size; // coordinates are rounded
  }
}

// Catches: a near plane; back parts mirrored to the front; the horizon's piece of the contour.
TEST(PointToPolygon, TheHorizonCutsPolygons) {
  const Vec3 up(0, 0, 1);
  // An infinite-like wall, half of it below the horizon.
  const std::vector<Vec3> wall = {{1, -1e6, -1e6}, {1, -1e6, 1e6}, {1, 1e6, 1e6}, {1, 1e6, -1e6}};
  EXPECT_NEAR(point_to_polygon(Vec3(0, 0, 0), up, wall), 0.5, 1e-6);
  const std::vector<Vec3> below = {{1, -1, -2}, {1, -1, -1}, {1, 1, -1}, {1, 1, -2}};
  EXPECT_EQ(point_to_polygon(Vec3(0, 0, 0), up, below), 0.0);
}

// Catches: a contour that rounding lets leave the horizon several times and that is closed once.
TEST(PointToPolygon, PolygonsInTheHorizonGiveNothing) {
  Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const auto frame = random_frame(random);
    std::vector<Vec3> polygon;
    for (const Vec3& corner : random_ngon(random, 12, {0, 0, 0}, 1)) // in the plane of x and y
      polygon.push_back(frame[0] * (corner.x + 3) + frame[1] * corner.y);
    const double value = point_to_polygon(Vec3(0, 0, 0), frame[2], polygon);
    EXPECT_NEAR(value, 0, 1e-15) << i;
  }
}

// Catches: everything that one shape, distance or angle can have wrong, see the tags.
TEST(AreaToArea, AgreesWithTheReference) {
  for (const nlohmann::json& one : unoccluded(false)) {
    const std::string name = one["name"];
    const auto p = points_of(one["P1"]), q = points_of(one["P2"]);
    const double exact = static_cast<double>(one["F12"]) * static_cast<double>(one["A1"]);
    for (const double asked : {1e-2, 1e-5, 1e-10}) {
      const AreaIntegral found = exchange(p, q, asked);
      const double error = std::fabs(found.value - exact);
      EXPECT_LE(error, std::max(asked, 2e-11) * exact) << name << " at " << asked;
      EXPECT_LE(error, found.error) << name << " at " << asked;
      EXPECT_LE(found.error, 16 * asked * exact) << name << " at " << asked;
    }
  }
}

// Catches: sums in the order of the arguments.
TEST(AreaToArea, IsSymmetricInBits) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const RandomPair pair(random);
    const AreaIntegral there = exchange(pair.p, pair.q, 1e-6),
                       back = exchange(pair.q, pair.p, 1e-6);
    ASSERT_EQ(there.value, back.value) << i;
    ASSERT_EQ(there.error, back.error) << i;
  }
}

// Catches: absolute epsilons.
TEST(AreaToArea, PowersOfTwoScaleTheBits) {
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const RandomPair pair(random);
    const AreaIntegral one = exchange(pair.p, pair.q, 1e-6);
    for (const int power : {-20, 3, 20}) {
      const auto scaled = [&](const Vec3& v) { return v * std::ldexp(1.0, power); };
      const AreaIntegral other = exchange(mapped(pair.p, scaled), mapped(pair.q, scaled), 1e-6);
      ASSERT_EQ(other.value, std::ldexp(one.value, 2 * power)) << i;
      ASSERT_EQ(other.error, std::ldexp(one.error, 2 * power)) << i;
    }
  }
}

// Catches: bounds that do not hold, whichever method is taken; methods that do not agree.
TEST(AreaToArea, PartsSumToTheWholeWithinTheErrorsStated) {
  Random random(7);
  double worst = 0;
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    const RandomPair pair(random);
    const AreaIntegral parts = by_parts(pair.p, pair.q);
    for (const double asked : {1e-2, 1e-3, 1e-5, 1e-8, 1e-11}) {
      const AreaIntegral whole = exchange(pair.p, pair.q, asked);
      const double error = std::fabs(whole.value - parts.value);
      ASSERT_LE(error, whole.error + parts.error) << i << " at " << asked;
      ASSERT_LE(error, std::max(asked, 1e-11) * parts.value + parts.error) << i << " at " << asked;
      if (asked == 1e-11 && parts.value > 0)
        worst = std::max(worst, error / parts.value);
    }
    seen += parts.value > 0;
  }
  EXPECT_GT(seen, 80);
  std::printf("parts and whole, %d pairs: relative difference up to %.1e\n", seen, worst);
}

// Catches: logarithms of 0, quadrature that does not follow an edge's singularity, closed forms
// that cancel; wedges sharp and flat, shapes with nothing parallel.
TEST(AreaToArea, PartsSumToTheWholeAcrossASharedEdge) {
  Random random(9);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const auto frame = random_frame(random);
    const double degrees = std::array{1.0, 5.0, 40.0, 90.0, 130.0, 175.0, 179.0}[i % 7];
    const double angle = degrees * radiosity::kPi / 180, length = random.between(0.2, 3);
    const auto place = [&](double along, double out, double turn) {
      return frame[0] * along + (frame[1] * std::cos(turn) + frame[2] * std::sin(turn)) * out;
    };
    const auto rim = [&] { return random.between(0.2, 1); };
    const std::vector<Vec3> p = {place(0, 0, 0), place(length, 0, 0),
                                 place(length * rim(), rim(), 0)};
    const double reach = rim();
    const std::vector<Vec3> q = {p[1], p[0], place(-0.3, reach, angle),
                                 place(length * rim() + 0.1, reach, angle)};
    const AreaIntegral parts = by_parts(p, q), whole = exchange(p, q, 1e-10);
    const double error = std::fabs(whole.value - parts.value);
    EXPECT_LE(error, whole.error + parts.error) << degrees;
    EXPECT_LE(error, 1e-10 * whole.value) << degrees;
    worst = std::max(worst, error / whole.value);
  }
  std::printf("across a shared edge: relative difference up to %.1e\n", worst);
}

// Catches: a cut that needs one corner more than there is room for.
TEST(AreaToArea, FullPolygonsAreCut) {
  const std::vector<Vec3> wall = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  std::vector<Vec3> disk;
  for (int k = 0; k < ConvexPolygon::kMaxCorners; ++k) {
    const double angle = 2 * radiosity::kPi * k / ConvexPolygon::kMaxCorners + 0.01;
    disk.push_back(Vec3(0.3 + std::cos(angle), std::sin(angle), -0.2));
  }
  const AreaIntegral whole = exchange(disk, wall, 1e-9);
  double parts = 0, error = whole.error;
  for (const auto& half : halves(disk, 0.3)) {
    const AreaIntegral part = exchange(wall, half, 1e-9);
    parts += part.value;
    error += part.error;
  }
  EXPECT_GT(whole.value, 0.1);
  EXPECT_NEAR(parts, whole.value, error);
  EXPECT_LT(error, 4e-9 * parts);
}

// Catches: formulas that need axis-parallel input, and contour terms taken for parallel that are
// not.
TEST(AreaToArea, TurningBothChangesNothing) {
  Random random(8);
  for (int i = 0; i < 60; ++i) {
    const auto frame = random_frame(random);
    const auto turned = [&](const Vec3& v) {
      return frame[0] * v.x + frame[1] * v.y + frame[2] * v.z;
    };
    for (const char* name : {"perp_edge_h1_w1_l1", "par_1x1_gap0.1", "perp_off_1", "tilt_5_1x1x1",
                             "tilt_120_1x1x1", "tri_shared_edge_60", "horizon_tilted"}) {
      const nlohmann::json one = reference_case("formfactors.json", name);
      const double exact = static_cast<double>(one["F12"]) * static_cast<double>(one["A1"]);
      const auto p = mapped(points_of(one["P1"]), turned), q = mapped(points_of(one["P2"]), turned);
      EXPECT_NEAR(exchange(p, q, 1e-10).value, exact, 1e-10 * exact) << name;
    }
    const nlohmann::json flat = reference_case("formfactors.json", "zero_coplanar");
    const auto p = mapped(points_of(flat["P1"]), turned), q = mapped(points_of(flat["P2"]), turned);
    EXPECT_EQ(exchange(p, q, 1e-10).value, 0.0);
  }
}

// Catches: arithmetic on positions rather than on differences of positions.
TEST(AreaToArea, FarFromTheOriginOnlyCoordinatesAreRounded) {
  const auto moved = [](const Vec3& v) { return v + Vec3(1e6, -1e6, 1e6); };
  for (const nlohmann::json& one : unoccluded(false)) {
    const std::string name = one["name"];
    if (name.find("sliver") == 0 || name.find("tiny") == 0 || name.find("coplanar") == 0 ||
        name.find("tilt_17") == 0 || name.find("gap0.001") != std::string::npos)
      continue; // 1e-10 of rounding is much of them
    const double exact = static_cast<double>(one["F12"]) * static_cast<double>(one["A1"]);
    const auto p = mapped(points_of(one["P1"]), moved), q = mapped(points_of(one["P2"]), moved);
    EXPECT_NEAR(exchange(p, q, 1e-10).value, exact, 1e-7 * exact) << name;
  }
}

} // namespace
} // namespace hemicube::test
