#include "radiosity/output/report_json.h"

#include "tests/unit/output_support.h"

#include <nlohmann/json.hpp>

namespace hemicube::radiosity::test {
namespace {

using Json = nlohmann::json;

struct ReportTest : ::testing::Test {
  ReportTest() {
    require(scene.bands.add("r"));
    require(scene.bands.add("caf\xe9")); // Latin-1: not UTF-8
    certificate.patches = 384;
    certificate.row_sum = {0.9, 0.95, 1};
    certificate.scene_hash = 0xabcu;
    certificate.radiosity_hash = 0xfedcba9876543210u;
    certificate.solved = certificate.has_residual = true;
    certificate.estimated_error = 0.1;
    require(certificate.energy.push_back({1, 2, 3, 4, 0, 0, 5}));
    require(certificate.energy.push_back({6, 7, 8, 9, 0, 0, 10}));
    mesh.dropped_zero_area = 2;
    run.isa = "avx2";
    run.threads = 3;
  }

  Json report() const {
    return Json::parse(report_json({scene, options, certificate, mesh, skipped, run, "1.2.3"}));
  }

  Scene scene;
  Options options;
  Certificate certificate;
  MeshReport mesh;
  std::map<std::string, std::uint64_t> skipped = {{"textures (map_Kd)", 5}, {"nothing", 0}};
  RunReport run;
};

TEST_F(ReportTest, ResultHoldsWhatWasComputed) {
  const Json result = report()["result"];
  EXPECT_EQ(result["patches"], 384);
  EXPECT_EQ(result["row_sum"], (Json{{"min", 0.9}, {"mean", 0.95}, {"max", 1.0}}));
  EXPECT_EQ(result["estimated_error"].get<double>(), 0.1) << "bit for bit";
  EXPECT_EQ(result["energy"]["emitted"], (Json{1.0, 6.0}));
  EXPECT_EQ(result["energy"]["imbalance"], (Json{5.0, 10.0}));
  EXPECT_EQ(result["bands"][0], "r");
  EXPECT_EQ(result["repaired"], (Json{{"dropped_zero_area", 2}}));
  EXPECT_EQ(result["skipped"], (Json{{"textures (map_Kd)", 5}}));
  EXPECT_EQ(result["hashes"]["scene"], "0000000000000abc");
  EXPECT_EQ(result["hashes"]["radiosity"], "fedcba9876543210");
  EXPECT_EQ(result["options"]["resolution"], 256);
}

// Catches: a list without end, or one that names patches that see nothing.
TEST_F(ReportTest, LossesNameTheWorstPatches) {
  certificate.space.max = certificate.space.worst[0].fraction = 0.5;
  certificate.space.worst_patch = certificate.space.worst[0].patch = 7;
  certificate.space.count = 1;
  certificate.back_side.count = 1000;
  const Json result = report()["result"];
  EXPECT_EQ(result["space"]["count"], 1);
  EXPECT_EQ(result["space"]["worst"], (Json{{{"patch", 7}, {"fraction", 0.5}}}));
  EXPECT_EQ(result["back_side"]["worst"].size(), 10u);
  certificate.space.count = 0;
  EXPECT_FALSE(report()["result"]["space"].contains("worst"));
}

TEST_F(ReportTest, WhatIsNotKnownIsAbsent) {
  certificate.estimated_error = std::numeric_limits<double>::infinity();
  certificate.residual = std::numeric_limits<double>::quiet_NaN();
  Json result = report()["result"];
  EXPECT_FALSE(result.contains("estimated_error"));
  EXPECT_FALSE(result.contains("residual"));
  EXPECT_FALSE(result["hashes"].contains("items"));
  EXPECT_FALSE(result["space"].contains("worst_patch")) << "nothing is lost";
  certificate.energy.clear();
  EXPECT_FALSE(report()["result"].contains("energy"));
  certificate.solved = false;
  const Json whole = report();
  result = whole["result"];
  for (const char* key : {"energy", "sweeps", "converged", "bands"})
    EXPECT_FALSE(result.contains(key)) << key;
  EXPECT_FALSE(result["hashes"].contains("radiosity"));
  EXPECT_FALSE(whole["run"]["seconds"].contains("solve"));
}

// Catches: figures of a balance that was not asked for, or none of one that was.
TEST_F(ReportTest, ABalanceIsReportedWhereThereWasOne) {
  const Json without = report();
  EXPECT_EQ(without["result"]["options"]["balance"], false);
  for (const char* key : {"balance", "reciprocity_raw"})
    EXPECT_FALSE(without["result"].contains(key)) << key;
  EXPECT_FALSE(without["run"]["seconds"].contains("balance"));
  options.balance = certificate.balanced = certificate.has_reciprocity = true;
  certificate.balance = {17, 0.25, 0.5, 1e-9};
  certificate.reciprocity_raw = {0.5, 0.125};
  run.balance_seconds = 3;
  const Json with = report();
  EXPECT_EQ(with["result"]["options"]["balance"], true);
  EXPECT_EQ(with["result"]["balance"], (Json{{"iterations", 17},
                                             {"max_change", 0.25},
                                             {"rms_change", 0.5},
                                             {"closure_residual", 1e-9}}));
  EXPECT_EQ(with["result"]["reciprocity_raw"], (Json{{"max", 0.5}, {"rms", 0.125}}));
  EXPECT_EQ(with["run"]["seconds"]["balance"], 3.0);
}

TEST_F(ReportTest, ResultDoesNotDependOnTheRun) {
  const Json before = report();
  run = {"scalar", 7, 1, 2, 3, 4, 9, 5, 6, 1000};
  const Json after = report();
  EXPECT_EQ(before["result"].dump(), after["result"].dump());
  EXPECT_NE(before["run"], after["run"]);
  EXPECT_EQ(after["run"]["threads"], 7);
  EXPECT_EQ(after["run"]["seconds"], (Json{{"read", 1.0},
                                           {"mesh", 2.0},
                                           {"build", 3.0},
                                           {"form_factors", 4.0},
                                           {"solve", 5.0},
                                           {"write", 6.0}}));
  EXPECT_EQ(after["run"]["version"], "1.2.3");
}

} // namespace
} // namespace hemicube::radiosity::test
