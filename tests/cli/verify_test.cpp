// `hemicube verify`: the exact cases.

#include "tests/cli/cli_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kRungs = {"hemicube", "analytic", "area", "adaptive", "exact"};

class VerifyTest : public CliCase {
protected:
  Json verify(std::vector<std::string> more) const {
    more.insert(more.begin(), {"verify", "--json"});
    return Json::parse(run(0, more).out);
  }

  /// The table without the times.
  static Json timeless(Json table) {
    for (Json& one : table["cases"])
      one.erase("seconds");
    return table;
  }
};

// Catches: a rung that loses what it promises, a case that a rung leaves out, a bound that no case
// has.
TEST_F(VerifyTest, EveryRungKeepsItsPromises) {
  std::set<std::string> names;
  for (const std::string& rung : kRungs) {
    const Json table = verify({"--all", "--rung", rung});
    EXPECT_EQ(table["failures"], 0);
    std::set<std::string> these;
    int promises = 0;
    for (const Json& one : table["cases"]) {
      EXPECT_EQ(one["rung"], rung);
      EXPECT_FALSE(one["failed"]) << one;
      EXPECT_GE(one["seconds"], 0.0);
      if (one.contains("bound")) {
        ++promises;
        EXPECT_LE(one["error"], one["bound"]) << one;
      }
      these.insert(one["case"]);
    }
    EXPECT_EQ(these.size(), table["cases"].size()) << "two cases of one name";
    EXPECT_GE(these.size(), 40u);
    EXPECT_GE(promises, 10) << rung;
    EXPECT_TRUE(names.empty() || names == these) << rung;
    names = these;
  }
}

// Catches: hard cases that are computed unasked, or that take the place of others.
TEST_F(VerifyTest, HardCasesAreAddedOnRequest) {
  const Json few = timeless(verify({"--rung", "area"}))["cases"];
  const Json all = timeless(verify({"--rung", "area", "--all"}))["cases"];
  ASSERT_GE(all.size(), few.size() + 20);
  for (std::size_t k = 0; k < few.size(); ++k)
    EXPECT_EQ(all[k], few[k]);
}

// Catches: a table that depends on who computes it.
TEST_F(VerifyTest, OnlyTimesDifferBetweenThreadsAndInstructionSets) {
  const Json table = timeless(verify({"--rung", "adaptive", "--threads", "1"}));
  EXPECT_EQ(table, timeless(verify({"--rung", "adaptive", "--threads", "3", "--isa", "scalar"})));
}

TEST_F(VerifyTest, TheTableHasALineForEachCase) {
  const ProgramResult result = run(0, {"verify", "--rung", "area"});
  const std::vector<std::string> lines = lines_of(result.out);
  EXPECT_EQ(lines.size(), verify({"--rung", "area"})["cases"].size() + 1);
  EXPECT_TRUE(lines[0].starts_with("case ")) << lines[0];
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("0.199824895698"), std::string::npos) << "plates at a gap of 1";
  EXPECT_EQ(new_files(), std::set<std::string>());
}

TEST_F(VerifyTest, QuietSaysNothingOfWhatHolds) {
  const ProgramResult result = run(0, {"verify", "--rung", "analytic", "--quiet"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

// The bounds are for the default resolution: pixels this large break them. Catches: a failure that
// is printed and not returned, a bound that grows with the error.
TEST_F(VerifyTest, AFailureIsShownAndEndsInOne) {
  const std::vector<std::string> coarse = {"verify", "--rung", "hemicube", "--resolution", "16"};
  const ProgramResult whole = run(1, coarse);
  EXPECT_NE(whole.out.find(" FAILED\n"), std::string::npos) << whole.out;
  EXPECT_NE(whole.err.find("farther from the exact ones"), std::string::npos) << whole.err;

  std::vector<std::string> more = coarse;
  more.push_back("--quiet");
  const std::vector<std::string> quiet = lines_of(run(1, more).out);
  EXPECT_FALSE(quiet.empty());
  for (const std::string& line : quiet)
    EXPECT_TRUE(line.ends_with(" FAILED")) << line;

  more.back() = "--json";
  const Json table = Json::parse(run(1, more).out);
  EXPECT_EQ(table["failures"], quiet.size());
  EXPECT_EQ(std::count_if(table["cases"].begin(), table["cases"].end(),
                          [](const Json& one) { return one["failed"].get<bool>(); }),
            static_cast<std::ptrdiff_t>(quiet.size()));
}

TEST_F(VerifyTest, TakesNoScene) {
  expect_refused(2, {"verify", write_room()}, {path("room.obj")});
  expect_refused(2, {"verify", "--rung", "perfect"}, {"--rung perfect", "hemicube"});
}

} // namespace
} // namespace hemicube::test
