// Lines 23 to 30 of README.md: degenerate input and floating point.

#include "radiosity/elementary.h"
#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/lambert.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/hard_cases/hard_case.h"
#include "tests/support/polygon_lists.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/scene_files.h"

#include <array>
#include <limits>

namespace hemicube::test {
namespace {

class HardCaseInput : public radiosity::test::SceneFiles {
protected:
  void write_material(const std::string& values) const {
    write("room.mtl", "newmtl wall\n" + values + "\n");
  }

  /// Reads and meshes faces over the corners of a cube and a few more vertices.
  PatchSet mesh_of(const std::string& faces, radiosity::MeshReport* mesh) {
    write("room.obj", "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                      "v 1 1 1\nv 0 1 1\nv 2 0 0\nv 0.5 0.5 0.5\nusemtl wall\n" +
                          faces);
    scene_ = Scene();
    expect_read("room.obj");
    PatchSet patches;
    require(radiosity::build_patches(scene_, &patches, mesh));
    return patches;
  }

  Status solve_file(const std::string& faces, radiosity::Solution* solution,
                    radiosity::Certificate* certificate) {
    radiosity::MeshReport mesh;
    const PatchSet patches = mesh_of(faces, &mesh);
    radiosity::SerialExecutor serial;
    return radiosity::solve_scene(scene_, patches, kAdaptiveRung.options(64), serial, nullptr,
                                  solution, certificate);
  }
};

/// The inside of the unit cube.
const std::string kCube[] = {"f 1 2 3 4\n", "f 5 8 7 6\n", "f 1 5 6 2\n",
                             "f 2 6 7 3\n", "f 3 7 8 4\n", "f 4 8 5 1\n"};

// Catches: 0/0 normals, and bad faces that shift, hide or relight the good ones.
TEST_F(HardCaseInput, L23_BadFaces) {
  write_material("Kd 0.5 0.5 0.5\nKe 1 1 1");
  const std::string inner = "f 10 2 3\n";
  const std::string bad[] = {"f 1 1 2\n", "f 1 2 9\n", "f 1 3 2 4\n" /* a bow-tie */,
                             "f 10 10 10\n", "f 1 2 1 2\n"};
  std::string good_text, mixed_text;
  for (std::size_t k = 0; k < 6; ++k) {
    good_text += kCube[k];
    mixed_text += kCube[k] + bad[k % std::size(bad)];
  }
  radiosity::MeshReport report;
  const PatchSet good = mesh_of(good_text + inner, &report);
  const PatchSet mixed = mesh_of(mixed_text + inner, &report);
  ASSERT_EQ(mixed.patch_count(), 7u);
  EXPECT_EQ(report.dropped_repeated_index, 4u);
  EXPECT_EQ(report.dropped_zero_area, 2u);
  EXPECT_EQ(mixed.face[6], 12u) << "faces keep their numbers";
  for (const LadderLevel& level : {kHemicubeRung, kAnalyticRung, kAreaRung, kAdaptiveRung}) {
    FormFactors expected, actual;
    compute_all(good, level.options(64), 2, &expected);
    compute_all(mixed, level.options(64), 2, &actual);
    EXPECT_TRUE(same_bits(expected.matrix, actual.matrix)) << level.name;
  }

  for (const std::string word : {"nan", "inf", "-1e999"}) {
    write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 " + word + " 0\nf 1 2 3\n");
    expect_refused("bad.obj", "bad.obj:3: ");
  }
  // The left wall of the Cornell box is 10 um off its plane: it stays what it is.
  const Scene cornell = reference_scene("scenes/cornell.coarse.obj");
  PatchSet patches;
  require(radiosity::build_patches(cornell, &patches, &report));
  EXPECT_EQ(patches.patch_count(), cornell.face_count());
}

// Catches: what no surface can be, taken all the same; light that grows without end.
TEST_F(HardCaseInput, L24_Materials) {
  for (const std::string values :
       {"Kd -0.1 0 0", "Kd 1.2 0 0", "Kd nan 0 0", "Ke -1 0 0", "Ke nan 0 0", "Ke inf 0 0"}) {
    write_material(values);
    write("room.obj", "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wall\nf 1 2 3\n");
    const Status status = read("room.obj");
    EXPECT_EQ(status.code(), StatusCode::kBadScene) << values;
    EXPECT_NE(status.message().find("material 'wall'"), std::string_view::npos) << status.message();
  }
  std::string cube;
  for (const std::string& face : kCube)
    cube += face;
  write_material("Kd 1 1 1\nKe 1 1 1");
  radiosity::Solution solution;
  radiosity::Certificate certificate;
  EXPECT_EQ(solve_file(cube, &solution, &certificate).code(), StatusCode::kSingular);

  Scene white = reference_scene("scenes/corner2_90_a.coarse.obj");
  for (double& reflectance : white.reflectance)
    reflectance = 1;
  const Solved open = solve(white, kHemicubeRung.options(64));
  EXPECT_TRUE(open.certificate.converged);
  for (std::uint32_t p = 0; p < open.patches.patch_count(); ++p)
    EXPECT_TRUE(open.radiosity(p, 0) > 0 && std::isfinite(open.radiosity(p, 0))) << p;
}

// Catches: a relative residual of no light at all, 0/0; a patch alone that waits for others.
TEST_F(HardCaseInput, L25_NearlyNothing) {
  write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  expect_refused("empty.obj", "empty.obj");
  std::string cube;
  for (const std::string& face : kCube)
    cube += face;
  radiosity::Solution solution;
  radiosity::Certificate certificate;

  write_material("Kd 0.5 0.5 0.5\nKe 3 0 1");
  require(solve_file(kCube[0], &solution, &certificate));
  for (std::uint32_t band = 0; band < 3; ++band)
    EXPECT_EQ(solution.radiosity[band], solution.exitance[band]);

  write_material("Kd 0.5 0.9 1");
  require(solve_file(cube, &solution, &certificate));
  EXPECT_LE(certificate.sweeps, 1u);
  EXPECT_TRUE(certificate.converged);
  for (const double radiosity : solution.radiosity)
    EXPECT_EQ(radiosity, 0.0);

  write_material("Kd 0.5 0.25 0\nKe 1 1 1"); // each wall sends what it reflects, and 1
  require(solve_file(cube, &solution, &certificate));
  double largest = 0;
  for (std::size_t at = 0; at < solution.radiosity.size(); ++at)
    largest = std::max(largest, std::fabs(solution.radiosity[at] * (1 - solution.reflectance[at]) -
                                          solution.exitance[at]));
  expect_within("only emitters", largest, 1e-6);
}

// Catches: a sum in the order in which threads come, a state that a run leaves behind.
TEST(HardCase, L26_Determinism) {
  const Scene scene = cornell_like(4);
  for (const LadderLevel& level : {kHemicubeRung, kAnalyticRung, kAreaRung, kLooseRung}) {
    const Solved first = solve(scene, level.options(64), 1);
    for (const std::uint32_t threads : {1u, 2u, 8u})
      EXPECT_TRUE(same_bits(solve(scene, level.options(64), threads).solution.radiosity.span(),
                            first.solution.radiosity.span()))
          << level.name << ", " << threads << " threads";
  }
}

/// Every coordinate times a factor, then plus an offset.
Scene placed(Scene scene, double factor, double offset) {
  for (Vec3& vertex : scene.vertices)
    vertex = vertex * factor + Vec3(offset, offset, offset);
  return scene;
}

double largest_difference(const Solved& a, const Solved& b) {
  double largest = 0;
  for (std::size_t at = 0; at < a.solution.radiosity.size(); ++at)
    largest = std::max(largest, std::fabs(a.solution.radiosity[at] / b.solution.radiosity[at] - 1));
  return largest;
}

// The cube is made a little smaller, so that its coordinates round where it is moved to.
// Catches: arithmetic on places rather than differences, and absolute tolerances.
TEST(HardCase, L27_FarAwayTinyAndHuge) {
  const char* name = "enclosures/cube_mixed.obj";
  for (const LadderLevel& level : kAllRungs) {
    radiosity::Options options = level.options(kHardResolution);
    options.tolerance = 1e-12;
    const auto solved = [&](double factor, double offset) {
      return solve(placed(placed(reference_scene(name), 0.7, 0), factor, offset), options);
    };
    const Solved here = solved(1, 0);
    const auto difference = [&](double factor, double offset) {
      return largest_difference(solved(factor, offset), here);
    };
    const bool has_pixels = level.rung == radiosity::Rung::kHemicube;
    expect_within(level.name + std::string(", 1e6 m away"), difference(1, 1e6),
                  level.rung == radiosity::Rung::kExact ? 1e-6 : 1e-4);
    for (const double factor : {1e-6, 1e6})
      expect_within(level.name + std::string(factor < 1 ? ", times 1e-6" : ", times 1e6"),
                    difference(factor, 0), has_pixels ? 1e-4 : 1e-9);
    for (const double factor : {0x1p-20, 0x1p20})
      expect_within(level.name + std::string(factor < 1 ? ", times 2^-20" : ", times 2^20"),
                    difference(factor, 0), 0);
  }
}

// Unit squares face to face g apart: F = 1/(pi g^2) (1 - 2/(3 g^2) + O(g^-4)), by the mean of
// g^2 / (g^2 + s)^2 over the squared sideways distance s, whose mean is 1/3.
// Catches: closed forms that lose all their digits to cancellation far away, and rows that know
// their sum only as what space leaves of 1.
TEST(HardCase, L28_Cancellation) {
  for (const LadderLevel& level : kAreaRungs)
    for (const char* name : {"par_1x1_gap1000", "tiny_far_1e-8"})
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).relative(), 1e-6);
  double largest = 0;
  double largest_entry[std::size(kAreaRungs)] = {};
  for (const double gap : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
    const PolygonList pair = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                              {{0, 1, gap}, {1, 1, gap}, {1, 0, gap}, {0, 0, gap}}};
    const double exact = (1 - 2 / (3 * gap * gap)) / (radiosity::kPi * gap * gap);
    const double got =
        radiosity::exchange_area(radiosity::ConvexPolygon(pair[0]), {0, 0, 1},
                                 radiosity::ConvexPolygon(pair[1]), {0, 0, -1}, 1e-10)
            .value;
    largest = std::max(largest, std::fabs(got / exact - 1));
    for (std::size_t k = 0; k < std::size(kAreaRungs); ++k) {
      FormFactors factors;
      compute_all(patches_of(pair), kAreaRungs[k].options(kHardResolution), 1, &factors);
      const double of_row = entry(factors.matrix.row(0), 1);
      largest_entry[k] = std::max(largest_entry[k], std::fabs(of_row / exact - 1));
    }
  }
  expect_within("plates 1e3 .. 1e8 apart, the integral", largest, 1e-6);
  for (std::size_t k = 0; k < std::size(kAreaRungs); ++k)
    expect_within(std::string("the same, ") + kAreaRungs[k].name, largest_entry[k], 1e-6);
}

// Catches: 0 log 0 and atan(v / 0) at edges and corners that patches share.
TEST(HardCase, L29_LimitsAtSharedEdges) {
  for (const char* name :
       {"perp_edge_h1_w1_l1", "perp_edge_h0.1_w1_l1", "perp_edge_h5_w1_l1", "perp_edge_h0.01_w1_l1",
        "perp_edge_h0.05_w0.05_l4", "perp_off_1", "tri_shared_edge_60"})
    for (const LadderLevel& level : kAreaRungs)
      expect_within(name + std::string(", ") + level.name, pair_of(name, level).absolute(), 1e-4);
}

// Catches: 0/0 at repeated corners and with the eye on the contour; values outside 0..1.
TEST(HardCase, L30_RepeatedCornersAndPointsOnTheContour) {
  using radiosity::point_to_polygon;
  const std::vector<Vec3> square = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const std::vector<Vec3> repeated = {square[0], square[0], square[1], square[2],
                                      square[2], square[2], square[3]};
  const Vec3 up(0, 0, 1), eye(0.25, 0.5, 0);
  EXPECT_NEAR(point_to_polygon(eye, up, repeated), point_to_polygon(eye, up, square), 1e-15);
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    const auto polygon =
        random_ngon(random, 3 + static_cast<int>(random.index(6)), random.point(-1, 1), 1);
    const Vec3 normal = random_frame(random)[2];
    const Vec3 middle = (polygon[0] + polygon[1]) * 0.5;
    for (const Vec3& place : {polygon[0], middle, (middle + polygon[2]) * 0.5}) {
      const double value = point_to_polygon(place, normal, polygon);
      EXPECT_TRUE(value >= 0 && value <= 1) << value;
    }
  }
}

} // namespace
} // namespace hemicube::test
