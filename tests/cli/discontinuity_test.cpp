// `--discontinuity`: the meshes it makes are used by all commands, found again, and reported.

#include "tests/cli/cli_case.h"

#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

const std::string kPlate = HC_SOURCE_DIR "/scenes/plate.json";

class DiscontinuityTest : public CliCase {
protected:
  static Words cut(Words words) {
    for (const char* word : {"--discontinuity", "--rung", "hemicube", "--resolution", "32"})
      words.push_back(word);
    return words;
  }
};

// Catches: counts that are not told; a mesh that `render` and `probe` do not find again.
TEST_F(DiscontinuityTest, ASolutionSaysHowItWasCutAndIsUsedThatWay) {
  run(0, cut({"solve", kPlate, "-o", path("out"), "--quiet"}));
  const Json result = Json::parse(read("out/report.json"))["result"];
  const Json& report = result["discontinuity"];
  EXPECT_EQ(report["patches"], 84);
  EXPECT_EQ(report["elements"], result["patches"]);
  EXPECT_GT(report["elements"], 84);
  EXPECT_EQ(report["emitters"], 1);
  EXPECT_EQ(report["emitters_treated"], 1);
  EXPECT_EQ(report["power_treated"], 1.0);
  EXPECT_EQ(report["contact_lines"], 0);
  EXPECT_EQ(report["shadow_lines"], 24) << "4 corners past 3 edges, 4 edges past 3 corners";
  EXPECT_EQ(report["lines_skipped"], 0);
  EXPECT_EQ(report["wedges"], 40) << "and 4 times 4 quarters of the lamp's horizon";
  EXPECT_EQ(report["wedges_skipped"], 0);
  EXPECT_EQ(result["options"]["discontinuity"]["max_emitters"], 4);
  EXPECT_GT(result["options"]["discontinuity"]["snap"], 0);

  run(0, {"render", path("out"), "-o", path("a.png"), "--quiet"});
  EXPECT_EQ(read("a.png"), read("out/view.png"));
  run(0, cut({"render", kPlate, "-o", path("b.png"), "--quiet"}));
  EXPECT_EQ(read("b.png"), read("out/view.png"));
  run(0, {"render", path("out"), "-o", path("w.png"), "--wedges", "--quiet"});
  EXPECT_NE(read("w.png"), read("out/view.png"));
  const std::string points =
      write("p.csv", "x,y,z,nx,ny,nz\n0,0,0.001,0,0,1\n1.9,1.9,0.001,0,0,1\n");
  const Words h = column_of(run(0, {"probe", path("out"), "--points", points}).out, "irradiance_r");
  EXPECT_LT(std::stod(h.at(0)), 0.5 * std::stod(h.at(1))) << "in the shadow, and out of it";
}

// Catches: refinement that begins with other patches; threads that matter; limits that do not.
TEST_F(DiscontinuityTest, RefinementBeginsWithTheElements) {
  const auto solved = [&](const Words& more) {
    Words words = cut({"solve", kPlate, "--json"});
    words.insert(words.end(), more.begin(), more.end());
    return Json::parse(run(0, words).out)["result"];
  };
  const Json one = solved({"--adaptive", "--max-elements", "400", "--threads", "1"});
  EXPECT_EQ(one["adaptive"]["patches"], one["discontinuity"]["elements"]);
  EXPECT_GT(one["adaptive"]["elements"], one["adaptive"]["patches"]);
  EXPECT_EQ(one, solved({"--adaptive", "--max-elements", "400", "--threads", "3"}));
  const Json coarse = solved({"--snap", "0.2"}), dark = solved({"--max-emitters", "0"});
  EXPECT_LT(coarse["patches"], one["discontinuity"]["elements"]);
  EXPECT_EQ(dark["patches"], 84);
  EXPECT_EQ(dark["discontinuity"]["emitters_treated"], 0);
  EXPECT_EQ(dark["discontinuity"]["power_treated"], 0.0);
}

TEST_F(DiscontinuityTest, InfoTellsWhatWouldBeCut) {
  const ProgramResult shown = run(0, {"info", kPlate, "--discontinuity"});
  EXPECT_NE(shown.out.find("84 patches cut into"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("24 borders of shadows"), std::string::npos) << shown.out;
}

// Catches: options that are ignored in silence where they have no meaning.
TEST_F(DiscontinuityTest, WhatMakesNoSenseIsRefused) {
  const std::string scene = write_room();
  for (const char* option : {"--snap", "--max-emitters"})
    expect_refused(2, {"solve", scene, option, "1"}, {option, "--discontinuity"});
  expect_refused(2, {"solve", scene, "--discontinuity", "--snap", "-1"}, {"--snap -1"});
  expect_refused(2, {"render", scene, "-o", path("a.png"), "--wedges"},
                 {"--wedges", "--discontinuity"});
  expect_refused(2, {"render", scene, "-o", path("a.exr"), "--wedges", "--discontinuity"},
                 {"--wedges", ".png"});
}

} // namespace
} // namespace hemicube::test
