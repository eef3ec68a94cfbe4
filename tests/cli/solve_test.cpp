// `hemicube solve`: its files, its report, and how it ends.

#include "tests/cli/cli_case.h"

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;

class SolveTest : public CliCase {
protected:
  /// Starts a long run into the folder "out" and returns once it computes.
  void start_and_interrupt(int signal) {
    const std::string scene = write_room();
    Program program(hemicube_path(), {"solve", scene, "-o", path("out"), "--resolution", "2048",
                                      "--max-edge", "0.02", "--threads", "2"});
    // The folder is made when the scene is read and before the form factors are computed.
    while (!std::filesystem::exists(path("out")) && !program.has_ended())
      std::this_thread::yield();
    program.send(signal);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(new_files(), std::set<std::string>{});
  }

  std::vector<double> numbers(const std::string& csv, const std::string& column) const {
    std::vector<double> values;
    for (const std::string& text : column_of(csv, column))
      values.push_back(std::strtod(text.c_str(), nullptr));
    return values;
  }
};

TEST_F(SolveTest, WritesAllFilesAndNoOthers) {
  const ProgramResult result = run(0, {"solve", write_room(), "-o", path("a/b")});
  EXPECT_EQ(new_files(),
            (std::set<std::string>{"a/", "a/b/", "a/b/groups.csv", "a/b/patches.csv",
                                   "a/b/report.json", "a/b/solution.glb", "a/b/solution.ply",
                                   "a/b/solution_float.ply", "a/b/view.exr", "a/b/view.png"}));
  EXPECT_EQ(lines_of(read("a/b/patches.csv")).size(), 7u);
  EXPECT_EQ(read("a/b/solution.ply").substr(0, 4), "ply\n");
  EXPECT_EQ(read("a/b/view.png").substr(1, 3), "PNG");
  EXPECT_EQ(Json::parse(read("a/b/report.json"))["result"]["patches"], 6);
  const std::vector<std::string> summary = lines_of(result.out);
  ASSERT_EQ(summary.size(), 2u) << result.out;
  EXPECT_TRUE(summary[0].starts_with("6 patches, rung adaptive")) << summary[0];
  EXPECT_NE(summary[1].find(path("a/b")), std::string::npos) << summary[1];
}

TEST_F(SolveTest, WithoutAFolderNothingIsWritten) {
  const ProgramResult result = run(0, {"solve", write_room()});
  EXPECT_EQ(new_files(), std::set<std::string>());
  EXPECT_EQ(lines_of(result.out).size(), 2u) << result.out;
}

TEST_F(SolveTest, TheReportHasTheKeysOfTheCertificate) {
  const ProgramResult result = run(0, {"solve", write_room(), "--json"});
  const Json report = Json::parse(result.out);
  for (const char* key :
       {"patches", "hemicubes", "nonzeros", "row_sum", "row_sum_raw", "space", "back_side",
        "residual", "sweeps", "converged", "energy", "repaired", "skipped", "hashes"})
    EXPECT_TRUE(report["result"].contains(key)) << key;
  for (const char* key : {"scene", "form_factors", "radiosity"})
    EXPECT_EQ(report["result"]["hashes"].value(key, "").size(), 16u) << key;
  EXPECT_FALSE(report["result"]["hashes"].contains("items"));
  for (const char* key : {"version", "isa", "threads", "seconds", "peak_memory_bytes"})
    EXPECT_TRUE(report["run"].contains(key)) << key;
  for (const char* key : {"read", "mesh", "build", "form_factors", "solve"})
    EXPECT_GE(report["run"]["seconds"].value(key, -1.0), 0) << key;
  EXPECT_TRUE(report["result"]["converged"]);
  EXPECT_GT(report["run"]["peak_memory_bytes"], 1000000);
}

TEST_F(SolveTest, ItemHashesOnRequest) {
  const Json report = Json::parse(run(0, {"solve", write_room(), "--json", "--hash-items"}).out);
  EXPECT_EQ(report["result"]["hashes"].value("items", "").size(), 16u);
}

TEST_F(SolveTest, QuietPrintsNothing) {
  const std::string scene = write_room(std::string(kRoomObj) + "f 1 2 2\n");
  const ProgramResult result = run(0, {"solve", scene, "--quiet"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST_F(SolveTest, ThreadsAndInstructionSetsGiveTheSameFiles) {
  const std::string scene = write_room();
  const std::vector<std::vector<std::string>> variants = {{"--threads", "1"},
                                                          {"--threads", "2"},
                                                          {"--threads", "3"},
                                                          {"--isa", "scalar"},
                                                          {"--isa", "avx2"}};
  std::string patches, result;
  for (std::size_t k = 0; k < variants.size(); ++k) {
    std::vector<std::string> arguments = {"solve",        scene, "--max-edge", "0.2",
                                          "--resolution", "64",  "-o",         path("out")};
    arguments.insert(arguments.end(), variants[k].begin(), variants[k].end());
    const ProgramResult ended = run_hemicube(arguments);
    if (variants[k].back() == "avx2" && ended.exit_code == 2)
      continue; // not on this machine
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const std::string these = read("out/patches.csv");
    const std::string report = Json::parse(read("out/report.json"))["result"].dump();
    EXPECT_GT(lines_of(these).size(), 100u);
    if (k != 0) {
      EXPECT_EQ(these, patches) << ::testing::PrintToString(variants[k]);
      EXPECT_EQ(report, result) << ::testing::PrintToString(variants[k]);
    }
    patches = these;
    result = report;
  }
}

TEST_F(SolveTest, ProgressiveRefinementShootsAndTakesSnapshots) {
  const std::string scene = write_room();
  const ProgramResult stopped =
      run_hemicube({"solve", scene, "--solver", "progressive", "--max-shots", "2",
                    "--snapshot-every", "1", "--quiet", "--json", "-o", path("out")});
  EXPECT_EQ(stopped.exit_code, 1) << stopped.err;
  const Json result = Json::parse(stopped.out)["result"];
  EXPECT_EQ(result["solver"], "progressive");
  EXPECT_EQ(result["shots"], 2);
  EXPECT_FALSE(result["converged"]);
  EXPECT_GT(result["unshot"], 0.001);
  EXPECT_FALSE(result.contains("residual"));
  EXPECT_TRUE(std::filesystem::exists(path("out/snapshots/000002.png")));
  const Json done =
      Json::parse(run(0, {"solve", scene, "--solver", "progressive", "--json"}).out)["result"];
  EXPECT_LE(done["unshot"], 0.001);
  EXPECT_LE(std::abs(done["energy"]["imbalance"][0].get<double>()), 1e-12);
}

TEST_F(SolveTest, SolversAgree) {
  const std::string scene = write_room();
  run(0, {"solve", scene, "--tolerance", "1e-10", "--balance", "-o", path("gs")});
  const std::vector<double> want = numbers(read("gs/patches.csv"), "radiosity_r");
  for (const std::string solver : {"jacobi", "progressive"}) {
    run(0, {"solve", scene, "--tolerance", "1e-10", "--balance", "--solver", solver, "-o",
            path("out")});
    const std::vector<double> got = numbers(read("out/patches.csv"), "radiosity_r");
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_NEAR(got[i], want[i], 1e-8 * (1 + want[i])) << solver;
  }
}

TEST_F(SolveTest, MaxEdgeSubdivides) {
  const Json coarse = Json::parse(run(0, {"solve", write_room(), "--json"}).out);
  const Json fine =
      Json::parse(run(0, {"solve", path("room.obj"), "--json", "--max-edge", "0.5"}).out);
  EXPECT_EQ(coarse["result"]["patches"], 6);
  EXPECT_EQ(fine["result"]["patches"], 24);
}

TEST_F(SolveTest, ScenesOfOnePatch) {
  const std::string scene =
      write_room("mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl light\nf 1 2 3\n");
  const Json report = Json::parse(run(0, {"solve", scene, "--json"}).out);
  EXPECT_EQ(report["result"]["patches"], 1);
  EXPECT_EQ(report["result"]["nonzeros"], 0);
  EXPECT_EQ(report["result"]["space"]["max"], 1.0);
}

TEST_F(SolveTest, WithoutAnEmitterThereIsNoLight) {
  const std::string mtl =
      "newmtl white\nKd 0.5 0.5 0.5\nnewmtl light\nKd 0.2 0.2 0.2\nnewmtl red\nKd 0.6 0.1 0.1\n";
  run(0, {"solve", write_room(kRoomObj, mtl), "-o", path("out")});
  EXPECT_EQ(numbers(read("out/patches.csv"), "radiosity_r"), std::vector<double>(6, 0.0));
}

TEST_F(SolveTest, BlackSurfacesRadiateWhatTheyEmit) {
  const std::string mtl = "newmtl white\nKd 0 0 0\nKe 1 2 3\nnewmtl light\nKd 0 0 0\nKe 10 10 10\n"
                          "newmtl red\nKd 0 0 0\n";
  run(0, {"solve", write_room(kRoomObj, mtl), "-o", path("out")});
  const std::string csv = read("out/patches.csv");
  for (const std::string band : {"r", "g", "b"})
    EXPECT_EQ(column_of(csv, "radiosity_" + band), column_of(csv, "exitance_" + band)) << band;
  EXPECT_EQ(numbers(csv, "radiosity_g"), (std::vector<double>{2, 10, 0, 2, 2, 2}));
  EXPECT_GT(numbers(csv, "irradiance_r")[2], 0);
}

TEST_F(SolveTest, TheIrradianceOfBlackPatchesCanBeLeftOut) {
  run(0, {"solve", write_room(), "-o", path("out"), "--no-black-irradiance"});
  const std::vector<std::string> irradiance = column_of(read("out/patches.csv"), "irradiance_r");
  ASSERT_EQ(irradiance.size(), 6u);
  EXPECT_EQ(irradiance[1], "");
  EXPECT_NE(irradiance[0], "");
}

TEST_F(SolveTest, AFolderThatCannotBeWrittenIsFoundBeforeTheWork) {
  const std::string scene = write_room();
  // Below a regular file nobody can make a folder, root included. The run would take minutes.
  const std::vector<std::string> work = {"--resolution", "2048", "--max-edge", "0.01"};
  for (const std::string& folder : {path("room.mtl") + "/out", std::string("/proc/out")}) {
    std::vector<std::string> arguments = {"solve", scene, "-o", folder};
    arguments.insert(arguments.end(), work.begin(), work.end());
    expect_refused(1, arguments, {folder});
  }
}

TEST_F(SolveTest, APreviousSolutionSurvivesAFailure) {
  run(0, {"solve", write_room(), "-o", path("out"), "--quiet"});
  const std::string before = read("out/patches.csv");
  write("room.mtl", "newmtl white\nKd 2 0 0\n");
  run(3, {"solve", path("room.obj"), "-o", path("out")});
  EXPECT_EQ(read("out/patches.csv"), before);
}

TEST_F(SolveTest, AFileThatCannotBeReplacedIsFoundBeforeTheWork) {
  const std::string scene = write_room();
  std::filesystem::create_directories(path("out/report.json"));
  const ProgramResult result =
      run(1, {"solve", scene, "-o", path("out"), "--resolution", "2048", "--max-edge", "0.02"});
  EXPECT_NE(result.err.find("report.json: is a folder"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("hemicubes"), std::string::npos) << "rows were computed first";
}

TEST_F(SolveTest, InterruptLeavesNoFiles) {
  start_and_interrupt(SIGINT);
}

TEST_F(SolveTest, TerminationLeavesNoFiles) {
  start_and_interrupt(SIGTERM);
}

} // namespace
} // namespace hemicube::test
