// Lines 1 to 15 of README.md: the near field and the hemicube's own plane; small, thin and far.

#include "radiosity/elementary.h"
#include "tests/hard_cases/hard_case.h"
#include "tests/support/lambert.h"
#include "tests/support/one_point.h"
#include "tests/support/polygon_lists.h"

#include <array>

namespace hemicube::test {
namespace {

/// The row of a point that looks at polygons.
struct PointRow {
  radiosity::FormFactorMatrix matrix;
  radiosity::RowView row() const { return matrix.row(0); }

  PointRow(const PolygonList& polygons, const Vec3& eye, const Vec3& normal,
           const LadderLevel& level) {
    const radiosity::Receiver receiver{eye, normal};
    radiosity::Certificate certificate;
    radiosity::SerialExecutor serial;
    require(radiosity::compute_point_form_factors(patches_of(polygons), {&receiver, 1},
                                                  level.options(kHardResolution), serial, nullptr,
                                                  &matrix, &certificate));
  }
};

/// F12 of a case of formfactors.json and what it is from the centre of P1: one point is what rungs
/// below area have, and near by that is far from what the areas exchange.
struct PairFromCentre {
  PatchSet patches;
  FormFactors factors;
  double got, exact;

  PairFromCentre(const std::string& name, const LadderLevel& level)
      : patches(CasePatches(reference_case("formfactors.json", name)).patches) {
    compute_all(patches, level.options(kHardResolution), 1, &factors);
    got = entry(factors.matrix.row(0), 1);
    exact = lambert_form_factor(patches.centre[0], patches.normal[0], corners_of(patches, 1));
  }
};

// Catches: patches for which one point stands although they touch.
TEST(HardCase, L01_SharedEdge) {
  for (const LadderLevel& level : kAreaRungs)
    expect_within(level.name, pair_of("perp_edge_h1_w1_l1", level).absolute(), 1e-4);

  const nlohmann::json one = reference_case("formfactors.json", "perp_edge_h1_w1_l1");
  const std::vector<Vec3> floor = points_of(one["P1"]);
  SceneBuilder builder;
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.grid(grey, floor[0], floor[1], floor[2], floor[3], 4, 4);
  builder.face(grey, points_of(one["P2"]));
  FormFactors factors;
  compute_all(patches_of(builder.finish()), kHemicubeRung.options(kHardResolution), 2, &factors);
  double mean = 0;
  for (std::uint32_t part = 0; part < 16; ++part)
    mean += entry(factors.matrix.row(part), 16) / 16;
  expect_within("hemicube, 16 parts", std::fabs(mean - one["F12"].get<double>()), 1e-3);
}

// Catches: a near plane, and integrals that meet the singularity along the edge unprepared.
TEST(HardCase, L02_SharpWedge) {
  for (const char* name : {"tilt_5_1x1x1", "tilt_1_1x1x1"}) {
    for (const LadderLevel& level : kAreaRungs)
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).relative(), 1e-3);
    for (const LadderLevel& level : kAllRungs) {
      const PairOfFactors pair = pair_of(name, level);
      EXPECT_LE(std::max(pair.got[0], pair.got[1]), 1.0) << name << ", " << level.name;
    }
  }
}

// Catches: what lies in the last row of pixels counted as nothing, or with the weight of a whole
// row; negative weights.
TEST(HardCase, L03_ObtuseWedge) {
  for (const char* name : {"tilt_175_1x1x1", "tilt_179_1x1x1"}) {
    for (const LadderLevel& level : kAreaRungs)
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).relative(), 1e-2);
    const PairFromCentre pure(name, kHemicubeRung);
    expect_within(name + std::string(", hemicube"), std::fabs(pure.got - pure.exact), 2e-5);
    EXPECT_GE(pure.got, 0.0) << name;
  }
}

// A wall with its foot in the plane of a point that looks along it, before the point's feet, or
// through them. Catches: vertices without a projection divided by nothing.
TEST(HardCase, L04_EdgeInTheReceiversPlane) {
  const Vec3 eye(0.5, 0, 0), along(0, 1, 0);
  for (const double h : {0.0, 0x1p-40, 1e-9, 1e-3, 1.0}) {
    const Polygon wall = {{0, 0, -h}, {1, 0, -h}, {1, 1, -h}, {0, 1, -h}};
    const double exact = h > 0 ? lambert_form_factor(eye, along, wall) : 0;
    for (const LadderLevel& level : kAllRungs) {
      const PointRow made({wall}, eye, along, level);
      const double got = entry(made.row(), 0);
      EXPECT_TRUE(got >= 0 && got <= 1) << level.name << ", " << h << " before: " << got;
      EXPECT_NEAR(got + made.row().space, 1, 1e-12) << level.name << ", " << h << " before";
      if (level.rung != radiosity::Rung::kHemicube) {
        EXPECT_NEAR(got, exact, 1e-12) << level.name << ", " << h << " before";
      }
    }
  }
}

// Catches: what is behind a plane mirrored to the front.
TEST(HardCase, L05_StraddlingTheHorizon) {
  for (const char* name : {"horizon_wall_half", "horizon_tilted", "horizon_triangle"}) {
    for (const LadderLevel& level : kAreaRungs)
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).relative(), 1e-3);
    for (const LadderLevel& level : {kHemicubeRung, kAnalyticRung}) {
      const PairFromCentre pair(name, level);
      expect_within(name + std::string(", ") + level.name, std::fabs(pair.got / pair.exact - 1),
                    1e-2);
    }
  }
}

// Catches: a near plane at any distance: at some scale it would cut.
TEST(HardCase, L06_SharedCorner) {
  for (const LadderLevel& level : kAreaRungs)
    expect_within(level.name, pair_of("perp_off_1", level).absolute(), 1e-4);
  const PairFromCentre pure("perp_off_1", kHemicubeRung);
  expect_within("hemicube", std::fabs(pure.got - pure.exact), 2.5e-4);
  for (const double scale : {0x1p-30, 0x1p-10, 0x1p10, 0x1p30}) {
    FormFactors scaled;
    compute_all(patches_of(moved(list_of(pure.patches), scale, {0, 0, 0})),
                kHemicubeRung.options(kHardResolution), 1, &scaled);
    EXPECT_TRUE(same_bits(scaled.matrix, pure.factors.matrix)) << scale;
  }
}

// Catches: a rim that few pixels show; an occluder just before the receiver.
TEST(HardCase, L07_NearCoincidentPlates) {
  for (const LadderLevel& level : kAreaRungs)
    expect_within(std::string("plates, ") + level.name,
                  pair_of("par_1x1_gap0.001", level).absolute(), 2e-4);
  for (const LadderLevel& level : {kAdaptiveRung, kExactRung})
    expect_within(std::string("occluder, ") + level.name,
                  pair_of("occ_near_receiver", level).absolute(), 2e-4);
}

// Catches: weights of pixel centres, which sum to 1 + 2e-6.
TEST(HardCase, L08_PointNearAPlate) {
  const nlohmann::json one = reference_case("formfactors.json", "pt_near_1e-3");
  for (const LadderLevel& level : kAllRungs) {
    const PointRow made({facing_polygon(one)}, point_of(one["P1"][0]), point_of(one["normal1"]),
                        level);
    const double got = entry(made.row(), 0);
    expect_within(level.name + std::string(", all of it"), std::fabs(got + made.row().space - 1),
                  1e-12);
    if (level.rung != radiosity::Rung::kHemicube)
      expect_within(level.name + std::string(", the plate"),
                    std::fabs(got - one["F12"].get<double>()), 1e-12);
  }
}

// Catches: what falls between pixels.
TEST(HardCase, L09_TinyFarLight) {
  for (const char* name : {"tiny_far_1e-8", "tiny_far_rev", "tiny_light_in_room"})
    for (const LadderLevel& level : kAreaRungs)
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).relative(), 1e-6);
}

// Catches: the same, in one direction.
TEST(HardCase, L10_Slivers) {
  for (const char* name : {"sliver_par", "sliver_wall", "sliver_tri"})
    for (const LadderLevel& level : kAreaRungs)
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).relative(), 1e-3);
}

// Catches: a shadow lost between the points of a receiver, or doubled.
TEST(HardCase, L11_ThinWire) {
  for (const LadderLevel& level : {kAdaptiveRung, kExactRung})
    expect_within(level.name, pair_of("occ_thin_wire", level).absolute(), 3e-4);
}

/// F of the unit square of z = 0 to an upright square of edge h, d away along x, whose lower edge
/// is at z = h and which looks back at it: Simpson's rule of the kernel over both, far enough for
/// it.
static double far_and_low(double d, double h) {
  constexpr double kAt[] = {0, 0.5, 1}, kWeight[] = {1. / 6, 4. / 6, 1. / 6};
  double sum = 0;
  for (int i = 0; i < 81; ++i) {
    const int u = i % 3, v = i / 3 % 3, s = i / 9 % 3, t = i / 27;
    const Vec3 way(d - kAt[u], h * kAt[s] - kAt[v], h + h * kAt[t]);
    const double squared = glm::dot(way, way);
    sum += kWeight[u] * kWeight[v] * kWeight[s] * kWeight[t] * way.z * way.x / (squared * squared);
  }
  return sum * h * h / radiosity::kPi;
}

// Catches: bands at the horizon thinner than a pixel, and small things in them.
TEST(HardCase, L12_Grazing) {
  for (const LadderLevel& level : kAreaRungs) {
    const PairOfFactors pair = pair_of("coplanar_step_1e-3", level);
    expect_within(level.name + std::string(", relative"), pair.relative(), 1e-2);
    expect_within(level.name + std::string(", absolute"), pair.absolute(), 1e-6);
    for (const auto& [d, h] : {std::pair(40., 0.1), {100., 1e-2}, {1e4, 1e-3}}) {
      const PatchSet patches = patches_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                           {{d, 0, h}, {d, 0, 2 * h}, {d, h, 2 * h}, {d, h, h}}});
      FormFactors factors;
      compute_all(patches, level.options(kHardResolution), 1, &factors);
      expect_within(level.name + std::string(", tiny and far"),
                    std::fabs(entry(factors.matrix.row(0), 1) / far_and_low(d, h) - 1), 1e-2);
    }
  }
}

// The square above, and squares below turned about one centre: hemicubes turn with them.
// Catches: pixels that agree with the edges of rooms, which hides how wrong they are elsewhere.
TEST(HardCase, L13_OrientationAliasing) {
  constexpr std::uint32_t kTurns = 64;
  PolygonList squares;
  for (std::uint32_t k = 0; k < kTurns; ++k) {
    const double angle = 2 * radiosity::kPi * k / kTurns;
    const Vec3 along(std::cos(angle) / 2, std::sin(angle) / 2, 0), across(-along.y, along.x, 0);
    squares.push_back({-along - across, along - across, along + across, across - along});
  }
  const Polygon above = {{-0.5, -0.5, 1}, {-0.5, 0.5, 1}, {0.5, 0.5, 1}, {0.5, -0.5, 1}};
  squares.push_back(above);
  FormFactors factors;
  compute_all(patches_of(squares), kHemicubeRung.options(kHardResolution), 2, &factors);
  const double exact = lambert_form_factor({0, 0, 0}, {0, 0, 1}, above); // 0.239456
  double sum = 0, squared = 0;
  for (std::uint32_t k = 0; k < kTurns; ++k) {
    const double error = entry(factors.matrix.row(k), kTurns) - exact;
    sum += error;
    squared += error * error;
  }
  expect_within("hemicube, deviation", std::sqrt(squared / kTurns - sum * sum / kTurns / kTurns),
                2.5e-4);
  expect_within("hemicube, RMS error", std::sqrt(squared / kTurns), 2.5e-4);
}

// A closed room 1 x 1 x 0.1: all walls lie on two or three faces of any hemicube. Catches: pixels
// drawn twice or never at the seams of faces.
TEST(HardCase, L14_PatchesOnSeveralFaces) {
  const PolygonList room = list_of(patches_of(box_enclosure({1, 1, 0.1}, 1, 1, 1, 0.5, 1)));
  const auto ceiling = static_cast<std::uint32_t>(
      std::find_if(room.begin(), room.end(),
                   [](const Polygon& wall) {
                     return std::all_of(wall.begin(), wall.end(),
                                        [](const Vec3& corner) { return corner.z == 0.1; });
                   }) -
      room.begin());
  for (const double x : {0.01, 0.35, 0.5, 0.99})
    for (const double y : {0.01, 0.2, 0.5}) {
      const Vec3 eye(x, y, 0.01), up(0, 0, 1);
      const PointRow made(room, eye, up, kHemicubeRung);
      EXPECT_EQ(made.row().space, 0.0) << x << ", " << y;
      EXPECT_EQ(made.row().back_side, 0.0) << x << ", " << y;
      EXPECT_NEAR(radiosity::row_sum(made.row()), 1, 1e-15);
      EXPECT_NEAR(entry(made.row(), ceiling), lambert_form_factor(eye, up, room[ceiling]), 2.5e-4)
          << x << ", " << y;
    }
  const nlohmann::json one = reference_case("formfactors.json", "pt_corner_par");
  const PointRow corner({facing_polygon(one)}, point_of(one["P1"][0]), point_of(one["normal1"]),
                        kHemicubeRung);
  expect_within("pt_corner_par, hemicube",
                std::fabs(entry(corner.row(), 0) - one["F12"].get<double>()), 2.5e-4);
}

// Catches: 0/0, and a sliver of rounding taken for a polygon.
TEST(HardCase, L15_EdgeOn) {
  Random random(15);
  for (const LadderLevel& level : kAllRungs) {
    const PairOfFactors coplanar = pair_of("zero_coplanar", level);
    EXPECT_EQ(coplanar.got[0], 0.0) << level.name;
    EXPECT_EQ(coplanar.got[1], 0.0) << level.name;
    for (int k = 0; k < 20; ++k) {
      const double x = random.between(-1, 1), y = random.between(-1, 1), low = random.between(0, 1);
      const auto at = [&](double r, double z) { return Vec3(r * x, r * y, z); };
      const PointRow made({{at(1, low), at(2, low), at(2, low + 1), at(1, low + 1)}}, {0, 0, 0},
                          {0, 0, 1}, level);
      EXPECT_EQ(entry(made.row(), 0), 0.0) << level.name << ", " << x << ", " << y;
      EXPECT_EQ(made.row().space, 1.0) << level.name << ", " << x << ", " << y;
    }
  }
}

} // namespace
} // namespace hemicube::test
