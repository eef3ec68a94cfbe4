// `hemicube probe`, and rows at points whose values are known.

#include "tests/cli/cli_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;

Json reference(const std::string& name) {
  std::ifstream file(HC_SOURCE_DIR "/tests/reference/" + name);
  return Json::parse(file);
}

std::vector<double> numbers(const std::string& csv, const std::string& column) {
  std::vector<double> values;
  for (const std::string& text : column_of(csv, column))
    values.push_back(std::strtod(text.c_str(), nullptr));
  return values;
}

/// "1,2,3", read back to the same bits.
std::string fields(const Json& vector) {
  std::string text;
  for (const Json& value : vector)
    text += (text.empty() ? "" : ",") + value.dump();
  return text;
}

class ProbeTest : public CliCase {
protected:
  std::string points(const std::string& lines) {
    return write("p.csv", "x,y,z,nx,ny,nz\n" + lines);
  }
  /// Solves the room into the folder "out", which counts as there before.
  std::string solve_room(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"solve", write_room(), "-o", path("out"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(0, arguments);
    return path("out");
  }
  /// As expect_refused, beside the files of the solution.
  void expect_no_probe(int exit_code, const std::vector<std::string>& arguments,
                       const std::vector<std::string>& parts) const {
    const std::set<std::string> before = new_files();
    const ProgramResult result = run(exit_code, arguments);
    EXPECT_EQ(lines_of(result.err).size(), 1u) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << " in: " << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(new_files(), before);
  }
};

// Catches: points or numbers that do not come back as they were given, bands in another order.
TEST_F(ProbeTest, TheTableRepeatsThePointsAndAddsTheirLight) {
  const std::string file = points("0.1,0.25,0.3333333333333333,0,0,-2.5\n0.5,0.5,0.5,1,0,0\n");
  const ProgramResult shown = run(0, {"probe", solve_room(), "--points", file});
  EXPECT_EQ(lines_of(shown.out)[0],
            "x,y,z,nx,ny,nz,space,back_side,irradiance_r,irradiance_g,irradiance_b");
  EXPECT_EQ(lines_of(shown.out)[1].substr(0, 41), "0.1,0.25,0.3333333333333333,0,0,-2.5,0,0,");
  EXPECT_EQ(lines_of(shown.out).size(), 3u);
  run(0, {"probe", path("out"), "--points", file, "-o", path("h.csv"), "--quiet"});
  EXPECT_EQ(read("h.csv"), shown.out);
  const Json report = Json::parse(
      run(0, {"probe", path("out"), "--points", file, "-o", path("h.csv"), "--json"}).out);
  EXPECT_EQ(report["result"]["patches"], 6);
}

// H = sum F B + s E_space, put together by hand from two other outputs. Catches: space that is dark
// to probes, B of another patch, F of another rung.
TEST_F(ProbeTest, IrradianceIsTheRowTimesTheRadiositiesAndSpace) {
  write("open.mtl", "newmtl lamp\nKd 0.5 0.25 0\nKe 1 2 3\n");
  write("open.obj",
        "mtllib open.mtl\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\nusemtl lamp\nf 1 2 3 4\n");
  const std::string scene =
      write("open.json", R"({"format": "hemicube-scene", "version": 1, "space_exitance": [4, 5, 6],
                             "meshes": [{"file": "open.obj"}]})");
  run(0, {"solve", scene, "-o", path("out"), "--quiet"});
  const std::string file = points("0.25,0.5,0,0,0,1\n");
  const std::string csv = run(0, {"probe", path("out"), "--points", file}).out;
  run(0, {"formfactors", scene, "--points", file, "-o", path("f.mtx"), "--quiet"});
  const double f = numbers(read("f.rows.csv"), "row_sum")[0];
  const double s = numbers(read("f.rows.csv"), "space")[0];
  EXPECT_EQ(numbers(csv, "space")[0], s);
  EXPECT_NEAR(f + s, 1, 1e-15);
  int band = 0;
  for (const std::string name : {"r", "g", "b"}) {
    const double b = numbers(read("out/patches.csv"), "radiosity_" + name)[0];
    EXPECT_NEAR(numbers(csv, "irradiance_" + name)[0], f * b + s * (4 + band), 1e-13) << name;
    ++band;
  }
}

// Catches: --max-edge or --rung of the solution forgotten, files that are not looked for where
// report.json says.
TEST_F(ProbeTest, TheSolutionSaysWhatItIsOf) {
  const std::string file = points("0.5,0.5,0.5,0,0,1\n");
  solve_room({"--max-edge", "0.5"});
  const std::string csv = run(0, {"probe", path("out"), "--points", file}).out;
  EXPECT_EQ(run(0, {"probe", path("out"), "--points", file, "--scene", path("room.obj")}).out, csv);
  EXPECT_EQ(run(0, {"probe", path("out"), "--points", file, "--rung", "adaptive"}).out, csv);
  EXPECT_NE(
      run(0, {"probe", path("out"), "--points", file, "--rung", "hemicube", "--resolution", "16"})
          .out,
      csv);
}

// Catches: light of one scene on the geometry of another.
TEST_F(ProbeTest, ASolutionOfAnotherSceneIsRefused) {
  const std::string file = points("0.5,0.5,0.5,0,0,1\n");
  const std::vector<std::string> probe = {"probe", solve_room(), "--points", file, "--quiet"};
  const std::string report = path("out/report.json");
  write_room(std::string(kRoomObj) + "f 1 2 3 4\n");
  expect_no_probe(3, probe, {report + ": is about 6 patches", "has 7", "solve it again"});
  std::string higher(kRoomObj);
  const std::string_view top = "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  higher.replace(higher.find(top), top.size(), "v 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\n");
  write_room(higher);
  expect_no_probe(3, probe, {report + ": is about a scene with hash ", "solve it again"});
  std::string brighter(kRoomMtl);
  brighter.replace(brighter.find("10 10 10"), 8, "20 20 20");
  write_room(kRoomObj, brighter);
  expect_no_probe(3, probe, {report + ": is about a scene with hash "});
  write_room();
  EXPECT_EQ(run(0, probe).err, "");
  write("out/patches.csv", "patch\n");
  expect_no_probe(3, probe, {path("out/patches.csv") + ":1:"});
}

// Numbers of a text put points on a tilted wall behind it as often as not. Catches: such points
// that see the back of their own wall and nothing else.
TEST_F(ProbeTest, PointsOnASurfaceAreInFrontOfIt) {
  const std::string mtl = "newmtl glow\nKd 0.5 0.5 0.5\nKe 1 1 1\n";
  // A tetrahedron seen from inside: everywhere B = H = 2.
  const std::string obj = "mtllib room.mtl\nusemtl glow\nv 0.1 0.2 0.3\nv 1.1 0.3 0.2\n"
                          "v 0.4 1.3 0.1\nv 0.3 0.4 1.7\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
  run(0, {"solve", write_room(obj, mtl), "-o", path("out"), "--quiet"});
  const std::string csv = read("out/patches.csv");
  const std::vector<double> x = numbers(csv, "cx"), y = numbers(csv, "cy"), z = numbers(csv, "cz");
  const std::vector<double> nx = numbers(csv, "nx"), ny = numbers(csv, "ny");
  const std::vector<double> nz = numbers(csv, "nz");
  for (const char* format : {"%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", "%.7f,%.7f,%.7f,%g,%g,%g\n",
                             "%.6f,%.6f,%.6f,%.3f,%.3f,%.3f\n"}) {
    std::string lines;
    for (std::size_t k = 0; k < x.size(); ++k) {
      char line[200];
      std::snprintf(line, sizeof line, format, x[k], y[k], z[k], nx[k], ny[k], nz[k]);
      lines += line;
    }
    const std::string out = run(0, {"probe", path("out"), "--points", points(lines)}).out;
    for (const double h : numbers(out, "irradiance_g"))
      EXPECT_NEAR(h, 2, 1e-3) << format << out;
    for (const double b : numbers(out, "back_side"))
      EXPECT_LE(b, 1e-3) << format << out;
  }
}

TEST_F(ProbeTest, BadInputIsRefusedWithItsPlace) {
  const std::string file = points("0,0,0,0,0,1\n0,0,zero,0,0,1\n");
  solve_room();
  expect_no_probe(3, {"probe", path("out"), "--points", file}, {file + ":3: z is", "zero"});
  points("0,0,0,0,0,1\n");
  expect_no_probe(3, {"probe", path("nowhere"), "--points", file}, {path("nowhere/report.json")});
  expect_no_probe(2, {"probe", path("out")}, {"--points"});
  expect_no_probe(2, {"probe", path("out"), "--points", file, "--json"}, {"--json needs -o"});
  expect_no_probe(1, {"probe", path("out"), "--points", file, "-o", path("room.mtl") + "/h.csv"},
                  {path("room.mtl")});
  std::string report = read("out/report.json");
  report.replace(report.find("\"scene\": \"/"), 8, "\"secne\":");
  write("out/report.json", report);
  expect_no_probe(3, {"probe", path("out"), "--points", file}, {"report.json", "--scene"});
  write("out/report.json", "{");
  expect_no_probe(3, {"probe", path("out"), "--points", file}, {"report.json"});
}

struct Room {
  const char* name;
  const char* max_edge; ///< metres
  double rms, largest;  ///< bounds on the relative error of the irradiance, less two sigma
};
// Bounds: twice what was measured.
const Room kRooms[] = {{"cornell", "0.04", 1.4e-3, 6e-3},
                       {"tableroom_a", "0.4", 9e-3, 2.8e-2},
                       {"tworooms_a", "0.4", 1.2e-2, 3.5e-2},
                       {"corridor_a", "0.15", 1.3e-2, 4.5e-2}};

class ProbedRooms : public ProbeTest, public ::testing::WithParamInterface<Room> {};

// The irradiance of the continuous solution, found by walks from the points. What is left is the
// error of the mesh: the light of a patch is constant, and form factors between patches are those
// of their centres. Catches: probes that see through walls or their own surface.
TEST_P(ProbedRooms, IrradianceIsThatOfTheContinuousSolution) {
  const std::string name = GetParam().name;
  run(0, {"solve", HC_SOURCE_DIR "/tests/reference/scenes/" + name + ".coarse.obj", "-o",
          path("out"), "--quiet", "--rung", "hemicube", "--max-edge", GetParam().max_edge});
  const Json probes = reference("scenes/" + name + ".probes.json");
  std::string lines;
  for (const Json& probe : probes)
    lines += fields(probe["position"]) + "," + fields(probe["normal"]) + "\n";
  const std::string csv = run(0, {"probe", path("out"), "--points", points(lines)}).out;
  double squares = 0, largest = 0;
  int band = 0;
  for (const std::string column : {"irradiance_r", "irradiance_g", "irradiance_b"}) {
    const std::vector<double> actual = numbers(csv, column);
    ASSERT_EQ(actual.size(), probes.size());
    for (std::size_t k = 0; k < actual.size(); ++k) {
      const double expected = probes[k]["irradiance"][band], sigma = probes[k]["sigma"][band];
      const double error = std::max(0.0, std::fabs(actual[k] - expected) - 2 * sigma) / expected;
      squares += error * error;
      largest = std::max(largest, error);
    }
    ++band;
  }
  const double rms = std::sqrt(squares / (3 * static_cast<double>(probes.size())));
  const Json report = Json::parse(read("out/report.json"));
  std::printf("%s, %d patches: relative error of the irradiance at %zu points: RMS %.2e, largest "
              "%.2e\n",
              name.c_str(), report["result"]["patches"].get<int>(), probes.size(), rms, largest);
  EXPECT_LE(rms, GetParam().rms);
  EXPECT_LE(largest, GetParam().largest);
}

INSTANTIATE_TEST_SUITE_P(, ProbedRooms, ::testing::ValuesIn(kRooms),
                         [](const auto& made) { return std::string(made.param.name); });

// Lambert's formula for one polygon before a point. Catches: rows at points that are of another
// rung than was asked for, polygons cut at the horizon, far and near ones lost. In pt_general_tri
// the point sees the back of P2: nothing arrives there, and it is counted.
TEST_F(ProbeTest, RowsAtPointsAreExactOnRungAdaptive) {
  int seen = 0;
  const Json all = reference("formfactors.json");
  for (const Json& one : all["cases"]) {
    if (one["P1"].size() != 1)
      continue;
    std::string obj, face = "f";
    int corners = 0;
    for (const Json& corner : one["P2"]) {
      std::string line = fields(corner);
      std::replace(line.begin(), line.end(), ',', ' ');
      obj += "v " + line + "\n";
      face += " " + std::to_string(++corners);
    }
    const std::string scene = write("p2.obj", obj + face + "\n");
    const std::string file = points(fields(one["P1"][0]) + "," + fields(one["normal1"]) + "\n");
    run(0, {"formfactors", scene, "--points", file, "--rung", "adaptive", "-o", path("f.mtx"),
            "--quiet"});
    const double expected = one["F12"];
    const bool is_back = one["name"] == "pt_general_tri";
    EXPECT_NEAR(numbers(read("f.rows.csv"), is_back ? "back_side" : "row_sum")[0], expected,
                1e-6 * expected)
        << one["name"];
    EXPECT_EQ(numbers(read("f.rows.csv"), is_back ? "row_sum" : "back_side")[0], 0) << one["name"];
    ++seen;
  }
  EXPECT_EQ(seen, 6);
}

} // namespace
} // namespace hemicube::test
