// `hemicube render`, `info` and `look`.

#include "tests/cli/cli_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;
using RenderTest = CliCase;
using InfoTest = CliCase;
using LookTest = CliCase;

/// Width and height of a PNG file.
std::pair<unsigned, unsigned> png_size(const std::string& bytes) {
  const auto number = [&bytes](std::size_t at) {
    unsigned value = 0;
    for (std::size_t k = 0; k < 4 && at + k < bytes.size(); ++k)
      value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(RenderTest, ASceneAndItsSolutionGiveTheSamePicture) {
  const std::string scene = write_room();
  run(0, {"solve", scene, "-o", path("out"), "--quiet"});
  const std::vector<std::string> camera = {"--size",      "64x48",           "--camera-position",
                                           "0.5,-2,0.5",  "--camera-target", "0.5,0.5,0.5",
                                           "--camera-up", "0,0,1",           "--fov",
                                           "40",          "--exposure",      "0.5"};
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), camera.begin(), camera.end());
    return run(0, arguments);
  };
  EXPECT_NE(render({scene, "-o", path("a.png")}).out.find("64x48"), std::string::npos);
  render({path("out"), "--scene", scene, "-o", path("b.png")});
  render({path("out"), "-o", path("c.png")});
  EXPECT_EQ(png_size(read("a.png")), (std::pair{64u, 48u}));
  EXPECT_EQ(read("a.png"), read("b.png"));
  EXPECT_EQ(read("a.png"), read("c.png"));
}

TEST_F(RenderTest, ASolutionRemembersItsMesh) {
  run(0, {"solve", write_room(), "--max-edge", "0.5", "-o", path("out"), "--quiet"});
  run(0, {"render", path("out"), "-o", path("a.png")});
}

TEST_F(RenderTest, ASolutionNeedsItsScene) {
  const std::string scene = write_room();
  run(0, {"solve", scene, "-o", path("out"), "--quiet"});
  write("out/report.json", "{\"run\": {}}");
  const std::set<std::string> before = new_files();
  EXPECT_NE(run(3, {"render", path("out"), "-o", path("a.png")}).err.find("--scene"),
            std::string::npos);
  // Another mesh than the one that was solved.
  const ProgramResult other =
      run(3, {"render", path("out"), "--scene", scene, "--max-edge", "0.5", "-o", path("a.png")});
  EXPECT_NE(other.err.find("patches.csv"), std::string::npos) << other.err;
  EXPECT_EQ(new_files(), before);
}

TEST_F(RenderTest, BadPicturesAreRefusedBeforeTheWork) {
  const std::string scene = write_room();
  const std::vector<std::string> work = {"--resolution", "2048", "--max-edge", "0.01"};
  const auto refused = [&](int exit, std::vector<std::string> arguments, const std::string& part) {
    arguments.insert(arguments.begin(), {"render", scene});
    arguments.insert(arguments.end(), work.begin(), work.end());
    expect_refused(exit, arguments, {part});
  };
  refused(2, {"-o", path("a.xyz")}, ".xyz");
  refused(1, {"-o", path("room.mtl") + "/a.png"}, path("room.mtl"));
  refused(2, {"-o", path("a.png"), "--scene", scene}, "--scene");
  refused(2, {"-o", path("a.png"), "--camera-position", "0,0,0", "--camera-target", "0,0,0"},
          "camera");
}

TEST_F(RenderTest, TheCameraOfASceneThatShowsNothingIsABadScene) {
  write_room();
  const std::string scene = write(
      "room.json", R"({"format": "hemicube-scene", "version": 1, "meshes": [{"file": "room.obj"}],
        "camera": {"position": [0, 0, 0], "target": [0, 0, 1], "width": 20000}})");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"solve", scene, "-o", path("out")},
        {"solve", scene},
        {"info", scene}})
    expect_refused(3, command, {path("room.json") + ":2:", "camera", "20000"});
}

TEST_F(RenderTest, TheFolderMustHoldASolution) {
  const std::string scene = write_room();
  expect_refused(3, {"render", path(""), "--scene", scene, "-o", path("a.png")}, {"patches.csv"});
}

TEST_F(InfoTest, SaysWhatWouldBeModelled) {
  const ProgramResult result = run(0, {"info", write_room()});
  for (const std::string& part :
       {path("room.obj"), path("room.mtl"), std::string("6 fronts"),
        std::string("1 patch reflects"), std::string("2 of 3 solved, because everywhere b = g"),
        std::string("nothing skipped"), std::string("0 0 0 .. 1 1 1"), std::string("scene hash")})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
}

TEST_F(InfoTest, SaysTheSameAsAnObject) {
  const std::string scene = write_room(std::string(kRoomObj) + "f 1 2 2\n");
  const Json info = Json::parse(run(0, {"info", scene, "--json"}).out);
  EXPECT_EQ(info["faces"], 7);
  EXPECT_EQ(info["patches"], 6);
  EXPECT_EQ(info["backs"], 0);
  EXPECT_EQ(info["black_patches"], 1);
  EXPECT_EQ(info["emitting_patches"], 1);
  EXPECT_EQ(info["solved_bands"], 2);
  EXPECT_EQ(info["bands"][2]["solved_as"], "g");
  EXPECT_EQ(info["bands"][0]["emitted"], 10.0);
  EXPECT_EQ(info["changed"].size(), 1u);
  EXPECT_EQ(info["bounds"][1], (std::vector<double>{1, 1, 1}));
  EXPECT_GT(info["cost"]["matrix_bytes"], 0.0);
  const Json report = Json::parse(run(0, {"solve", scene, "--json"}).out);
  EXPECT_EQ(info["hashes"]["scene"], report["result"]["hashes"]["scene"]);
}

TEST_F(LookTest, PrintsTheRowLargestFirst) {
  const ProgramResult result = run(0, {"look", write_room(), "--patch", "0"});
  const std::size_t header = result.out.find("patch,face,material,form_factor\n");
  ASSERT_NE(header, std::string::npos) << result.out;
  const std::string csv = result.out.substr(header);
  EXPECT_EQ(column_of(csv, "patch").front(), "1") << csv; // the ceiling
  EXPECT_EQ(column_of(csv, "material").front(), "light");
  std::vector<double> form_factors;
  for (const std::string& text : column_of(csv, "form_factor"))
    form_factors.push_back(std::stod(text));
  EXPECT_EQ(form_factors.size(), 5u);
  EXPECT_TRUE(std::is_sorted(form_factors.rbegin(), form_factors.rend())) << csv;
  EXPECT_NE(result.out.find("# space 0\n"), std::string::npos) << result.out;
}

// Catches: a leak that is only a number.
TEST_F(LookTest, SaysWhereLightIsLost) {
  write_room();
  const std::string scene = write("backs.obj", "mtllib room.mtl\n"
                                               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                               "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                               "usemtl white\nf 1 2 3 4\nf 5 6 7 8\n");
  const std::vector<std::string> look = {"look", scene, "--patch", "0", "--rung", "hemicube"};
  std::vector<std::string> json = look;
  json.push_back("--json");
  const Json found = Json::parse(run(0, json).out);
  ASSERT_EQ(found["backs"].size(), 1u);
  EXPECT_EQ(found["backs"][0]["patch"], 1);
  EXPECT_EQ(found["backs"][0]["material"], "white");
  EXPECT_NEAR(found["backs"][0]["fraction"], found["back_side"], 1e-12) << "both are of pixels";
  EXPECT_GT(found["space_towards"][2], 0.0) << "up, past the sheet";
  const std::string text = run(0, look).out;
  EXPECT_NE(text.find("\n# space towards "), std::string::npos) << text;
  EXPECT_NE(text.find("\n# back of patch,face,material 1,1,white: 0.2"), std::string::npos) << text;
  const Json closed = Json::parse(run(0, {"look", write_room(), "--patch", "0", "--json"}).out);
  EXPECT_FALSE(closed.contains("space_towards"));
  EXPECT_FALSE(closed.contains("backs"));
}

TEST_F(LookTest, PrintsTheWholeRowOnRequest) {
  const std::string scene = write_room();
  const std::vector<std::string> look = {"look",       scene, "--patch", "0",
                                         "--max-edge", "0.3", "--json"};
  std::vector<std::string> all = look;
  all.push_back("--all");
  const Json some = Json::parse(run(0, look).out), whole = Json::parse(run(0, all).out);
  EXPECT_EQ(some["row"].size(), 20u);
  EXPECT_EQ(whole["row"].size(), whole["nonzeros"]);
  EXPECT_GT(whole["row"].size(), 20u);
  EXPECT_EQ(some["hashes"]["items"], whole["hashes"]["items"]);
  double sum = whole["space"].get<double>() + whole["back_side"].get<double>();
  for (const Json& entry : whole["row"])
    sum += entry["form_factor"].get<double>();
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST_F(LookTest, AFaceMeansItsFirstPatch) {
  const ProgramResult result =
      run(0, {"look", write_room(), "--face", "2", "--max-edge", "0.5", "--json"});
  const Json look = Json::parse(result.out);
  EXPECT_EQ(look["patch"], 8);
  EXPECT_EQ(look["face"], 2);
  EXPECT_NE(result.err.find("face 2 has 4 patches"), std::string::npos) << result.err;
}

TEST_F(LookTest, DrawsTheHemicube) {
  run(0, {"look", write_room(), "--patch", "0", "-o", path("l.png"), "--resolution", "64"});
  EXPECT_EQ(new_files(), std::set<std::string>{"l.png"});
  EXPECT_GT(png_size(read("l.png")).first, 3 * 128u);
}

TEST_F(LookTest, WhatDoesNotExistIsNamed) {
  const std::string scene = write_room(std::string(kRoomObj) + "f 1 2 2\n");
  expect_refused(2, {"look", scene, "--patch", "6", "--quiet"}, {"--patch 6", "6 patches"});
  expect_refused(2, {"look", scene, "--face", "7", "--quiet"}, {"--face 7", "7 faces"});
  expect_refused(2, {"look", scene, "--face", "6", "--quiet"}, {"--face 6", "dropped"});
  expect_refused(2, {"look", scene, "--patch", "0", "-o", path("l.exr")}, {path("l.exr"), ".png"});
}

} // namespace
} // namespace hemicube::test
