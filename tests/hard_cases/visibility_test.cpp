// Lines 16 to 22 of README.md: visibility and watertightness.

#include "tests/hard_cases/hard_case.h"
#include "tests/support/polygon_lists.h"

#include <numeric>

namespace hemicube::test {
namespace {

using radiosity::Rung;

/// What the patches of a room see of space and of backs, at most: before closure takes up what is
/// missing, as integer sums of pixels need none.
struct Leaks {
  double space, back_side;
};
Leaks leaks_of(const PatchSet& patches, const LadderLevel& level) {
  FormFactors factors;
  compute_all(patches, level.options(level.rung == Rung::kHemicube ? kHardResolution : 64), 2,
              &factors);
  return {factors.certificate.space.max, factors.certificate.back_side.max};
}

constexpr LadderLevel kWatertightLevels[] = {kHemicubeRung, kAreaRung, kLooseRung};
/// Of backs in a receiver's plane.
constexpr double kRounding = 1e-15;

// Catches: gaps along shared edges: background pixels, and backs of boxes seen through their
// fronts; errors of a closed row taken for space.
TEST(HardCase, L16_NoBackgroundInClosedRooms) {
  for (const std::string name : {"furnace_cube", "furnace_lroom", "furnace_boxes",
                                 "furnace_icosphere2", "furnace_torus", "furnace_cube_0999"})
    for (const LadderLevel& level : kWatertightLevels) {
      if (name == "furnace_torus" && level.rung == Rung::kArea)
        continue; // slow
      const Leaks leaks =
          leaks_of(patches_of(reference_scene("enclosures/" + name + ".obj")), level);
      expect_within(name + ", " + level.name + ", space", leaks.space, 0);
      EXPECT_LE(leaks.back_side, level.rung == Rung::kHemicube ? 0 : kRounding)
          << name << ", " << level.name;
    }
}

// Catches: the same where vertices lie on the edges of neighbours.
TEST(HardCase, L17_TVertices) {
  std::vector<std::pair<std::string, PatchSet>> rooms;
  for (const std::string name : {"tableroom_a", "tworooms_a", "corridor_a"})
    rooms.emplace_back(name, patches_of(reference_scene("scenes/" + name + ".coarse.obj")));
  rooms.emplace_back("t_vertex_room", patches_of(t_vertex_room()));
  rooms.emplace_back("t_vertex_room, far away", patches_of(t_vertex_room(1, {1000.3, 7.7, -55})));
  for (const auto& [name, patches] : rooms)
    for (const LadderLevel& level : kWatertightLevels) {
      const Leaks leaks = leaks_of(patches, level);
      expect_within(name + ", " + level.name + ", space and backs", leaks.space + leaks.back_side,
                    1e-6);
      if (level.rung != Rung::kHemicube) {
        EXPECT_EQ(leaks.space, 0.0) << name << ", " << level.name;
      }
    }
}

Polygon square(double low, double high, double z, bool up) {
  const Polygon polygon = {{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}};
  return up ? polygon : Polygon(polygon.rbegin(), polygon.rend());
}

/// A floor, a wall, a ceiling, and a table in between.
PolygonList furnished() {
  return {square(0, 1, 0, true),
          {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
          square(0, 1, 1, false),
          square(0.3, 0.8, 0.4, true)};
}

/// Rows of a scene with one patch twice, the second time from another corner on, are those of the
/// scene without the second one, and nobody sees that.
void expect_copy_unseen(const PolygonList& list, std::uint32_t unseen, const LadderLevel& level) {
  PolygonList single = list;
  single.erase(single.begin() + unseen);
  FormFactors expected, actual;
  compute_all(patches_of(single), level.options(128), 2, &expected);
  compute_all(patches_of(list), level.options(128), 1, &actual);
  for (const std::uint32_t threads : {2u, 8u}) {
    FormFactors again;
    compute_all(patches_of(list), level.options(128), threads, &again);
    EXPECT_TRUE(same_bits(again.matrix, actual.matrix)) << threads << " threads, " << level.name;
  }
  double largest = 0;
  for (std::uint32_t i = 0; i < single.size(); ++i) {
    const std::vector<double> a = expected.dense_row(i);
    std::vector<double> b = actual.dense_row(i + (i >= unseen));
    EXPECT_EQ(b[unseen], 0.0) << level.name << ": the copy is seen from " << i;
    b.erase(b.begin() + unseen);
    for (std::uint32_t j = 0; j < single.size(); ++j)
      largest = std::max(largest, std::fabs(b[j] - a[j]));
  }
  expect_within(level.name + std::string(", copy ") + std::to_string(unseen), largest, 1e-12);
}

/// The same with every patch copied, and whatever the order.
void expect_copies_unseen(const PolygonList& single, const LadderLevel& level) {
  for (std::size_t copied = 0; copied < single.size(); ++copied) {
    PolygonList twice = single;
    append(&twice, {single[copied]});
    std::rotate(twice.back().begin(), twice.back().begin() + 1, twice.back().end());
    const auto last = static_cast<std::uint32_t>(single.size());
    expect_copy_unseen(twice, last, level);
    std::reverse(twice.begin(), twice.end());
    expect_copy_unseen(twice, last - static_cast<std::uint32_t>(copied), level);
  }
}

// Catches: z-fighting: both copies seen, or neither, or now one and now the other.
TEST(HardCase, L18_CoplanarDuplicates) {
  for (const LadderLevel& level : kAllRungs)
    if (level.rung == Rung::kExact) // slow with blockers
      expect_copies_unseen({square(0, 1, 0, true), square(0, 0.5, 1, false)}, level);
    else
      expect_copies_unseen(furnished(), level);
}

// Room 2 is some 430 times darker than room 1. Catches: a leak past the door: of 1e-3 it would make
// room 2 half as bright again; one point a patch makes it a quarter brighter.
TEST(HardCase, L19_LeaksIntoADarkRoom) {
  const Scene scene = reference_scene("scenes/tworooms_a.coarse.obj");
  const auto truth = reference_json("scenes/tworooms_a.truth.json")["coarse_constant_element_B"];
  const Solved solved = solve(scene, kLooseRung.options());
  for (std::uint32_t band = 0; band < 3; ++band) {
    double actual = 0, expected = 0;
    for (std::uint32_t p = 0; p < solved.patches.patch_count(); ++p)
      if (scene.materials[solved.patches.material[p]] == "room2") {
        actual += solved.patches.area[p] * solved.radiosity(p, band);
        expected += solved.patches.area[p] * truth[p][band].get<double>();
      }
    ASSERT_GT(expected, 0);
    expect_within("adaptive at 0.3, band " + std::to_string(band), std::fabs(actual / expected - 1),
                  2e-2);
  }
}

// Catches: backs that are left out before it is known what they hide; backs that receive.
TEST(HardCase, L20_BacksBlockAndReceiveNothing) {
  const nlohmann::json one = reference_case("formfactors.json", "occ_strip1");
  const Polygon from = points_of(one["P1"]), to = points_of(one["P2"]);
  Polygon blocker = CasePatches(one).blockers[0];
  FormFactors facing;
  for (const LadderLevel& level : kAllRungs) {
    const PairOfFactors averted = pair_of("zero_backfacing", level);
    EXPECT_EQ(averted.got[0], 0.0) << level.name;
    EXPECT_EQ(averted.got[1], 0.0) << level.name;
    // The blocker from either side alone: one of the plates sees its back.
    for (const bool turned : {false, true}) {
      std::reverse(blocker.begin(), blocker.end());
      FormFactors factors;
      compute_all(patches_of({from, to, blocker}), level.options(kHardResolution), 2, &factors);
      const std::uint32_t behind = factors.matrix.row(0).back_side > 0 ? 0 : 1;
      EXPECT_EQ(entry(factors.matrix.row(behind), 2), 0.0) << level.name;
      EXPECT_GT(entry(factors.matrix.row(1 - behind), 2), 0.1) << level.name;
      EXPECT_GT(factors.matrix.row(behind).back_side, 0.1) << level.name;
      EXPECT_EQ(factors.matrix.row(1 - behind).back_side, 0.0) << level.name;
      if (level.rung >= Rung::kAdaptive)
        expect_within(level.name + std::string(turned ? ", turned" : ", past it"),
                      std::fabs(entry(factors.matrix.row(0), 1) / one["F12"].get<double>() - 1),
                      1e-3);
    }
  }
}

// Catches: leaks at the rim of a blocker that just hides all.
TEST(HardCase, L21_TotalOcclusion) {
  for (const LadderLevel& level : kAllRungs)
    expect_within(level.name, pair_of("occ_total", level).absolute(), 0);
  for (const std::uint32_t resolution : {16u, 64u, 200u, 256u, 1024u})
    expect_within("hemicube at " + std::to_string(resolution),
                  pair_of("occ_total", kHemicubeRung, resolution).absolute(), 0);
}

/// The largest relative error of what the patches of a room see of its emitter; the absolute one
/// where that is nothing.
double error_to_emitter(const std::string& name, const LadderLevel& level) {
  const Scene scene = reference_scene("enclosures/" + name + ".obj");
  const PatchSet patches = patches_of(scene);
  const nlohmann::json truth = reference_case("enclosures.json", name)["truth"];
  const nlohmann::json& means = truth["patch_mean_form_factor_to_emitter"];
  FormFactors factors;
  compute_all(patches, level.options(), 2, &factors);
  double largest = 0;
  for (std::uint32_t p = 0; p < means.size(); ++p) {
    if (means[p].is_null())
      continue;
    double got = 0;
    for (std::uint32_t q = 0; q < patches.patch_count(); ++q)
      if (scene.materials[patches.material[q]] == "emitter")
        got += entry(factors.matrix.row(p), q);
    const double exact = means[p];
    largest = std::max(largest, exact > 0 ? std::fabs(got / exact - 1) : got);
  }
  return largest;
}

// Three quads on one edge: two floors and a wall of two coincident sides. Catches: the wrong side
// that wins, or a sheet that shadows itself.
TEST(HardCase, L22_NonManifold) {
  const Polygon left = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
  const Polygon right = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Polygon wall = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}; // faces the right
  const PatchSet patches = patches_of({left, right, wall, Polygon(wall.rbegin(), wall.rend())});
  for (const LadderLevel& level : kAllRungs) {
    FormFactors factors;
    compute_all(patches, level.options(kHardResolution), 2, &factors);
    for (std::uint32_t side : {0u, 1u}) {
      const std::vector<double> floor = factors.dense_row(side),
                                front = factors.dense_row(3 - side);
      EXPECT_EQ(floor[1 - side] + floor[2 + side], 0.0) << level.name << ", floor " << side;
      EXPECT_EQ(front[1 - side] + front[2 + side], 0.0) << level.name << ", wall " << side;
      EXPECT_EQ(factors.matrix.row(side).back_side, 0.0) << level.name;
      if (level.rung >= Rung::kArea) {
        expect_within(level.name + std::string(", floor and wall ") + std::to_string(side),
                      std::max(std::fabs(floor[3 - side] - 0.20004377607540316),
                               std::fabs(front[side] - 0.20004377607540316)),
                      1e-4);
      }
    }
  }
  for (const char* name : {"black_room", "black_room_blocker"})
    expect_within(std::string(name) + ", " + kTightRung.name, error_to_emitter(name, kTightRung),
                  1e-3);
}

} // namespace
} // namespace hemicube::test
