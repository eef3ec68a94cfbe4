// `--require`: conditions on the certificate of solve and formfactors.

#include "tests/cli/cli_case.h"

#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

/// The floor of the room alone, in the open.
inline constexpr std::string_view kFloorObj = "mtllib room.mtl\n"
                                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                              "usemtl white\nf 1 2 3 4\n";
/// Two sheets face to back: the lower one sees the back of the upper one.
inline constexpr std::string_view kBacksObj = "mtllib room.mtl\n"
                                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                              "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                              "usemtl white\nf 1 2 3 4\nf 5 6 7 8\n";

class RequireTest : public CliCase {
protected:
  /// Conditions that hold: nothing is said of them.
  void expect_holds(const std::string& command, const std::string& scene, const std::string& list,
                    const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {command,   scene,       "--rung", "hemicube",
                                          "--quiet", "--require", list};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(0, arguments).err, "") << list;
  }

  /// Conditions that do not: exit 1 and one line that names them.
  void expect_broken(const std::string& command, const std::string& scene, const std::string& list,
                     const std::vector<std::string>& parts,
                     const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {command,   scene,       "--rung", "hemicube",
                                          "--quiet", "--require", list};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(1, arguments, parts);
  }
};

// Catches: a condition that is parsed and never looked at, a bound compared the wrong way round.
TEST_F(RequireTest, WhatHoldsOfAClosedRoomIsNotMentioned) {
  const std::string scene = write_room();
  for (const std::string list :
       {"closed", "closure=1e-12", "reciprocity=0.9", "residual=1e-5", "imbalance=0.5", "converged",
        "closed,closure=1e-12,reciprocity=1,residual=1e-5,imbalance=1,converged"})
    expect_holds("solve", scene, list);
  for (const std::string list : {"closed", "closure=1e-12", "reciprocity=0.9"})
    expect_holds("formfactors", scene, list);
}

// Catches: `closed` that looks at one of the two losses, or at the mean.
TEST_F(RequireTest, OpenScenesAreNotClosed) {
  write_room();
  for (const std::string command : {"solve", "formfactors"}) {
    expect_broken(command, write("floor.obj", kFloorObj), "closed",
                  {"--require closed: space.max is 1,",
                   "at most 1e-12 (1 row sees space, most that of patch 0", "close the gap",
                   "look SCENE --patch 0 "});
    expect_broken(command, write("backs.obj", kBacksObj), "closed",
                  {"closed: space.max is 1,", "2 rows see space, most that of patch 1",
                   "closed: back_side.max is 0.2", "1 row sees back sides, most that of patch 0",
                   "turn round the faces it sees"});
  }
  // A row in the open closes all the same: space is part of it.
  expect_holds("solve", path("floor.obj"), "closure=1e-12");
}

// Catches: worst patches out of order, or numbered by row.
TEST_F(RequireTest, TheReportNamesThoseThatLoseMost) {
  std::string scene = "mtllib room.mtl\n";
  for (int k = 0; k < 12; ++k) { // floors of growing ceilings, all of them in the open
    const std::string x = std::to_string(3 * k), x1 = std::to_string(3 * k + 1),
                      z = std::to_string(0.1 * (k + 1));
    scene += "v " + x + " 0 0\nv " + x1 + " 0 0\nv " + x1 + " 1 0\nv " + x + " 1 0\n";
    scene += "v " + x + " 0 " + z + "\nv " + x + " 1 " + z + "\nv " + x1 + " 1 " + z + "\nv " + x1 +
             " 0 " + z + "\n";
  }
  scene += "usemtl white\n";
  for (int k = 0; k < 12; ++k)
    scene += "f " + std::to_string(8 * k + 1) + " " + std::to_string(8 * k + 2) + " " +
             std::to_string(8 * k + 3) + " " + std::to_string(8 * k + 4) + "\nf " +
             std::to_string(8 * k + 5) + " " + std::to_string(8 * k + 6) + " " +
             std::to_string(8 * k + 7) + " " + std::to_string(8 * k + 8) + "\n";
  write_room();
  const std::string path = write("plates.obj", scene);
  const auto space = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"formfactors", path, "--rung", "analytic", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(run(0, arguments).out)["result"]["space"];
  };
  const nlohmann::json all = space({});
  EXPECT_EQ(all["count"], 24);
  ASSERT_EQ(all["worst"].size(), 10u);
  EXPECT_EQ(all["worst"][0]["fraction"], all["max"]);
  EXPECT_EQ(all["worst"][0]["patch"], all["worst_patch"]);
  for (std::size_t k = 1; k < 10; ++k) {
    const nlohmann::json &a = all["worst"][k - 1], &b = all["worst"][k];
    EXPECT_TRUE(a["fraction"] > b["fraction"] ||
                (a["fraction"] == b["fraction"] && a["patch"] < b["patch"]))
        << all;
    EXPECT_GE(b["patch"], 14) << "the highest ceilings let most out";
  }
  const nlohmann::json some = space({"--rows", "0,23"});
  EXPECT_EQ(some["count"], 2);
  EXPECT_EQ(some["worst"][0]["patch"], 23);
  EXPECT_EQ(some["worst"][1]["patch"], 0);

  std::string floors = "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl white\n";
  for (int k = 0; k < 12; ++k) // all see space alone: the lowest are named
    floors += "f 1 2 3 4\n";
  const nlohmann::json equal = nlohmann::json::parse(
      run(0, {"formfactors", write("floors.obj", floors), "--rung", "hemicube", "--json"})
          .out)["result"]["space"];
  EXPECT_EQ(equal["count"], 12);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_EQ(equal["worst"][k]["patch"], k);
}

// Catches: the value of another quantity in the message, or of another run than this one.
TEST_F(RequireTest, BoundsThatAreTooTightAreNamedWithTheValue) {
  const std::string scene = write_room(); // six patches: hemicubes at centres are not reciprocal
  const nlohmann::json report = nlohmann::json::parse(
      run(0, {"solve", scene, "--rung", "hemicube", "--json", "--max-edge", "0.5"}).out)["result"];
  const auto text = [](double value) { return nlohmann::json(value).dump(); };
  const std::vector<std::string> fine = {"--max-edge", "0.5"};
  expect_broken("solve", scene, "reciprocity=1e-9",
                {"--require reciprocity: reciprocity.rms is " + text(report["reciprocity"]["rms"]) +
                 ", must be at most 1e-09"},
                fine);
  expect_broken("solve", scene, "residual=0", {"residual: residual is ", "must be at most 0"},
                fine);
  expect_broken("solve", scene, "imbalance=1e-12", {"imbalance: ", "energy.imbalance is "}, fine);
  double worst = 0;
  for (const double band : report["energy"]["imbalance"])
    worst = std::max(worst, std::abs(band));
  EXPECT_GT(worst, 1e-12);
  expect_broken("solve", scene, "imbalance=1e-12", {"is " + text(worst)}, fine);
  expect_broken("formfactors", scene, "reciprocity=1e-9", {"reciprocity.rms is "}, fine);
  // Rounding: no row closes better than this, and some do not close exactly.
  expect_holds("formfactors", scene, "closure=1e-15", fine);
}

TEST_F(RequireTest, AllBrokenConditionsAreNamedInOneLine) {
  expect_broken("solve", write_room(), "residual=0,closed,reciprocity=0",
                {"residual is ", "; reciprocity: reciprocity.rms is "}, {"--max-edge", "0.5"});
}

// Catches: a run whose files are thrown away because it did not please.
TEST_F(RequireTest, TheFilesAreWrittenAllTheSame) {
  const std::string scene = write_room();
  run(1, {"solve", scene, "-o", path("out"), "--max-edge", "0.5", "--require", "residual=0"});
  EXPECT_EQ(new_files().count("out/patches.csv"), 1u);
  const ProgramResult result =
      run(1, {"formfactors", scene, "-o", path("f.mtx"), "--rung", "hemicube", "--max-edge", "0.5",
              "--require", "reciprocity=0", "--json"});
  EXPECT_EQ(new_files().count("f.mtx"), 1u);
  EXPECT_TRUE(nlohmann::json::parse(result.out).contains("result"));
}

// Catches: conditions that never fire in a run that stopped early.
TEST_F(RequireTest, ErrorsAreThoseOfTheCertificate) {
  const std::string scene = write_room();
  const std::vector<std::string> fine = {"--max-edge", "0.5"};
  expect_holds("solve", scene, "error=0.5", fine);
  expect_holds("formfactors", scene, "error=0.9", fine);
  expect_broken("solve", scene, "error=1e-9", {"--require error: ", "error.radiosity is "}, fine);
  expect_broken("formfactors", scene, "error=1e-9", {"error: ", "error.form_factor is "}, fine);
}

// Catches: a typing error that passes as a condition that holds.
TEST_F(RequireTest, WhatIsNoConditionIsAUsageError) {
  const std::string scene = write_room();
  for (const std::string list :
       {"open", "", "closed,", ",closed", "closed=1", "closure", "closure=", "closure=x",
        "closure=-1", "closure=nan", "closure=inf", "closure=1e-3x", "Closed", "closed closure=1"})
    expect_refused(2, {"solve", scene, "--require", list}, {"--require " + list, "--help"});
  expect_refused(2, {"solve", scene, "--require", "open"},
                 {"'open'", "closed, closure=X, reciprocity=X", "converged"});
  for (const std::string list : {"residual=1", "imbalance=1", "converged"})
    expect_refused(2, {"formfactors", scene, "--require", list}, {"--require " + list});
  expect_refused(2, {"info", scene, "--require", "closed"}, {"--require"});
}

// Catches: an hour's work before it turns out that the condition has no value.
TEST_F(RequireTest, ConditionsOnWhatIsLeftOutAreRefusedAtOnce) {
  const std::string scene = write_room();
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.5,0,0,1\n");
  for (const std::string list : {"reciprocity=1", "error=1"}) {
    expect_refused(2, {"formfactors", scene, "--rows", "1", "--require", list}, {"--rows"});
    expect_refused(2, {"formfactors", scene, "--points", points, "--require", list}, {"--points"});
  }
  expect_refused(2, {"solve", scene, "--no-black-irradiance", "--require", "imbalance=1"},
                 {"--no-black-irradiance"});
  expect_holds("formfactors", scene, "closed", {"--rows", "1"});
}

} // namespace
} // namespace hemicube::test
