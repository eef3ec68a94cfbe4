// `solve --adaptive`, and what is done with its solution afterwards.

#include "tests/cli/cli_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class AdaptiveTest : public CliCase {
protected:
  /// The room with a small picture of it.
  std::string write_scene() {
    write_room();
    return write("room.json",
                 R"({"format": "hemicube-scene", "version": 1, "meshes": [{"file": "room.obj"}],
        "camera": {"position": [0.5, 0.02, 0.5], "target": [0.5, 1, 0.3], "up": [0, 0, 1],
                   "vertical_field_of_view": 90, "width": 64, "height": 48}})");
  }
  /// Its 24 patches with at most 70 elements.
  static Words adaptive(Words words, const Words& more = {}) {
    for (const char* word : {"--adaptive", "--variation", "0.1", "--max-elements", "70",
                             "--max-edge", "0.5", "--resolution", "32"})
      words.push_back(word);
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Json report() const { return Json::parse(read("out/report.json")); }

  /// As expect_refused, beside the files of a solution.
  void expect_refused_beside(int exit_code, const Words& arguments, const Words& parts) const {
    const std::set<std::string> before = new_files();
    const ProgramResult result = run(exit_code, arguments);
    EXPECT_EQ(lines_of(result.err).size(), 1u) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << " in: " << result.err;
    EXPECT_EQ(new_files(), before);
  }
};

// Catches: a table of patches or elements that does not fit the other, facts that are not told; a
// picture or a probe of patches instead of elements; damage that is not named.
TEST_F(AdaptiveTest, ASolutionSaysHowItWasCutAndIsUsedThatWay) {
  const std::string scene = write_scene();
  const ProgramResult shown = run(0, adaptive({"solve", scene, "-o", path("out")}));
  const Json result = report()["result"];
  const Json& cut = result["adaptive"];
  EXPECT_EQ(cut["patches"], 24);
  const std::size_t elements = cut["elements"];
  EXPECT_GT(elements, 50u);
  EXPECT_LE(elements, 70u);
  EXPECT_EQ(result["patches"], elements);
  EXPECT_GT(cut["rounds"], 0);
  EXPECT_GE(cut["rows_gathered"], elements);
  EXPECT_GT(cut["largest_variation"], 0.1);
  EXPECT_EQ(cut["ended_by"], "max_elements");
  EXPECT_EQ(result["options"]["variation"], 0.1);
  EXPECT_EQ(result["options"]["max_elements"], 70);
  EXPECT_EQ(result["options"]["min_edge"], 0.0625) << "an 8th of a patch of 0.5 m";
  EXPECT_NE(shown.out.find(std::to_string(elements) + " elements of 24 patches"), std::string::npos)
      << shown.out;

  const Words patch = column_of(read("out/elements.csv"), "patch");
  EXPECT_EQ(patch.size(), elements); // no backs
  EXPECT_EQ(column_of(read("out/patches.csv"), "parent"), patch);
  EXPECT_EQ(column_of(read("out/patches.csv"), "patch").size(), elements);

  run(0, {"render", path("out"), "-o", path("a.png"), "--quiet"});
  EXPECT_EQ(read("a.png"), read("out/view.png"));
  run(0, adaptive({"render", scene, "-o", path("b.png"), "--quiet"}));
  EXPECT_EQ(read("b.png"), read("out/view.png"));

  // In the middle of the floor, below the lamp, it is brighter than the elements are on average.
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.001,0,0,1\n");
  const double h = std::stod(
      column_of(run(0, {"probe", path("out"), "--points", points}).out, "irradiance_r").at(0));
  const std::string table = read("out/patches.csv");
  const Words face = column_of(table, "face"), irradiance = column_of(table, "irradiance_r");
  double brightest = 0;
  for (std::size_t k = 0; k < face.size(); ++k)
    if (face[k] == "0")
      brightest = std::max(brightest, std::stod(irradiance[k]));
  EXPECT_GT(h, brightest);
  EXPECT_LT(h, 1.15 * brightest);

  const std::string elements_csv = read("out/elements.csv");
  const auto expect_refusal = [&](const std::string& part) {
    expect_refused_beside(3, {"render", path("out"), "-o", path("a.png"), "--quiet"},
                          {path("out/elements.csv") + part});
    expect_refused_beside(3, {"probe", path("out"), "--points", points, "--quiet"},
                          {path("out/elements.csv") + part});
  };
  write("out/elements.csv", elements_csv.substr(0, elements_csv.size() / 2));
  expect_refusal(":");
  write("out/elements.csv", elements_csv + "0,7\n");
  expect_refusal(":" + std::to_string(lines_of(elements_csv).size() + 1) + ": patch 0");
  std::filesystem::remove(path("out/elements.csv"));
  expect_refusal(": ");
}

// Catches: options that are not passed on; a mesh or light that depends on the number of threads.
TEST_F(AdaptiveTest, OptionsAreFollowedAndThreadsDoNotMatter) {
  const std::string scene = write_room();
  const auto solved = [&](const Words& more) {
    Words words = {"solve", scene, "--json", "--resolution", "32"};
    words.insert(words.end(), more.begin(), more.end());
    return Json::parse(run(0, words).out)["result"];
  };
  const Json one =
      solved({"--adaptive", "--min-edge", "0.2", "--variation", "0.01", "--threads", "1"});
  EXPECT_EQ(one["adaptive"]["ended_by"], "min_edge");
  EXPECT_EQ(one["adaptive"]["elements"], 5 * 16 + 4) << "the lamp is black, but keeps up";
  EXPECT_EQ(one,
            solved({"--adaptive", "--min-edge", "0.2", "--variation", "0.01", "--threads", "3"}));
  EXPECT_FALSE(solved({}).contains("adaptive"));
  const Json coarse = solved({"--adaptive", "--variation", "1e6"});
  EXPECT_EQ(coarse["adaptive"]["ended_by"], "variation");
  EXPECT_EQ(coarse["hashes"]["radiosity"], solved({})["hashes"]["radiosity"]);
}

// Catches: options that are ignored in silence where they have no meaning.
TEST_F(AdaptiveTest, WhatCannotBeTogetherIsRefused) {
  const std::string scene = write_room();
  for (const Words& limit :
       {Words{"--variation", "0.1"}, Words{"--min-edge", "0.1"}, Words{"--max-elements", "100"}})
    for (const Words& command :
         {Words{"solve", scene}, Words{"render", scene, "-o", path("a.png")}}) {
      Words words = command;
      words.insert(words.end(), limit.begin(), limit.end());
      expect_refused(2, words, {limit[0], "--adaptive"});
    }
  const auto refused = [&](const Words& more, const Words& parts) {
    Words words = {"solve", scene, "--adaptive"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(2, words, parts);
  };
  refused({"--solver", "progressive"}, {"--adaptive", "--solver progressive"});
  refused({"--form-factors", path("f.hcf")}, {"--adaptive", "--form-factors"});
  refused({"--memory", "1GiB"}, {"--adaptive", "--memory"});
  refused({"--min-edge", "0.5", "--max-edge", "0.4"}, {"--min-edge 0.5", "--max-edge 0.4"});
  refused({"--max-elements", "5"}, {"5", "6 patches"});
  for (const std::string value : {"0", "-1", "nan", "inf", "0.1x", ""})
    for (const std::string option : {"--variation", "--min-edge"})
      refused({option, value}, {option + " " + value});
  for (const std::string value : {"0", "-1", "1.5", "1e3", "99999999999999999999"})
    refused({"--max-elements", value}, {"--max-elements " + value});
  for (const std::string command : {"info", "formfactors"})
    expect_refused(2, {command, scene, "--adaptive"}, {"--adaptive"});
}

// Catches: a solution that is solved again by a command that draws.
TEST_F(AdaptiveTest, ASolvedFolderIsNotCutAgain) {
  std::filesystem::create_directories(path("out"));
  expect_refused_beside(2, {"render", path("out"), "--adaptive", "-o", path("a.png")},
                        {"--adaptive", path("out")});
}

} // namespace
} // namespace hemicube::test
