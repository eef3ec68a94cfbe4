// Runs that are killed, interrupted, crowded out or left without disk: the same command goes on
// where they ended, and yields what an undisturbed run does.

#include "tests/cli/cli_case.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <sys/resource.h>
#include <thread>

namespace hemicube::test {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

constexpr int kUntilFirst = 3000; ///< milliseconds before a run writes anything

class KilledRunsTest : public CliCase {
protected:
  /// Finds the resolution at which a run takes about seven seconds of a processor, and so no less
  /// on a clock: what else the machine does may only make it longer.
  void SetUp() override {
    CliCase::SetUp();
    scene_ = write_room();
    const double before = seconds_of_children();
    report(slow({"formfactors", "--rows", "every:32"}));
    const double fitting = resolution_ * std::sqrt(7 / (32 * (seconds_of_children() - before)));
    resolution_ = std::clamp(static_cast<int>(fitting / 2) * 2, 64, 2048);
  }

  /// The options of a run that takes so long.
  Words slow(Words words, const std::string& threads = "1") const {
    words.insert(words.begin() + 1, scene_);
    words.insert(words.end(), {"--rung", "hemicube", "--resolution", std::to_string(resolution_),
                               "--max-edge", "0.0625", "--threads", threads, "--json"});
    return words;
  }

  Json report(const Words& words) const { return Json::parse(run(0, words).out); }

  /// Processor time of all programs that were run and have ended.
  static double seconds_of_children() {
    rusage usage = {};
    EXPECT_EQ(::getrusage(RUSAGE_CHILDREN, &usage), 0);
    return static_cast<double>(usage.ru_utime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  }

  /// Sends a signal to a run after some milliseconds. @return false if it had ended by itself
  static bool stop_after(Program* program, int milliseconds, int signal) {
    const auto end = Clock::now() + std::chrono::milliseconds(milliseconds);
    while (Clock::now() < end) {
      if (program->has_ended())
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    program->send(signal);
    return true;
  }

  template <typename IsTrue> static void wait_until(IsTrue is_true, Program* program) {
    while (!is_true() && !program->has_ended())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  void wait_for(const std::string& name, Program* program) const {
    wait_until([&] { return std::filesystem::exists(path(name)); }, program);
  }

  /// Bytes of a file; 0 if there is none.
  std::uintmax_t size_of(const std::string& name) const {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path(name), error);
    return error ? 0 : size;
  }

  /// Bytes of the files that unfinished runs have left.
  std::uintmax_t kept_bytes(const std::string& name) const {
    return size_of(name + ".part") + size_of(name + ".pairs.part") + size_of(name + ".black.part");
  }

  /// Starts a command until it ends well; kills or interrupts it at random moments before, most
  /// of them after it has added to what the runs before left: so it comes to an end, however slow.
  /// @param kept  what names of files begin with that an interrupted run goes on from
  /// @return the report of the last run
  Json run_through_signals(const Words& words, const std::string& kept, std::uint32_t seed) {
    std::mt19937 random(seed);
    constexpr int kSignals[] = {SIGKILL, SIGKILL, SIGTERM, SIGKILL, SIGINT};
    for (int runs = 0; runs < 100; ++runs) {
      const std::uintmax_t left = kept_bytes(kept);
      Program program(hemicube_path(), words);
      if (runs != 1) // which is likely to be stopped too early to leave anything
        wait_until([&] { return kept_bytes(kept) > left; }, &program);
      const int signal = kSignals[runs % 5];
      const bool is_stopped = stop_after(&program, static_cast<int>(random() % 500), signal);
      const ProgramResult result = program.wait();
      if (!is_stopped || result.exit_code == 0) { // the signal may have come too late
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_GE(runs, 2) << "the run is too short for this test";
        return Json::parse(result.out);
      }
      EXPECT_EQ(result.exit_code, signal == SIGKILL ? 128 + SIGKILL : 130) << result.err;
      if (signal != SIGKILL) {
        expect_said(result.err, {"interrupted"});
        // A run that has solved keeps no rows while it writes what it found.
        if (kept_bytes(kept) > 0)
          expect_said(result.err, {path(kept) + ".part", "the same command goes on from there"});
      }
      EXPECT_EQ(result.out, "");
    }
    ADD_FAILURE() << "the run never ends";
    return {};
  }

  /// Files there are, but for those that a run was writing aside when it was killed.
  std::set<std::string> finished_files() const {
    std::set<std::string> files = new_files();
    std::erase_if(files, [](const std::string& name) {
      return name.find(".hemicube-") != std::string::npos;
    });
    return files;
  }

  static void expect_said(const std::string& text, const Words& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << "expected '" << part << "' in: " << text;
  }

  std::string scene_;
  int resolution_ = 1024;
};

// Catches: rows of a killed run that are lost, taken although they are not whole, or mixed up; an
// interruption that loses what a kill would not, or does not say how to go on.
TEST_F(KilledRunsTest, KilledFormFactorsGoOnUntilTheyEnd) {
  const Json expected = report(slow({"formfactors"}, "2"));
  const Json last = run_through_signals(slow({"formfactors", "-o", path("f.hcf")}), "f.hcf", 1);
  EXPECT_EQ(last["result"], expected["result"]);
  EXPECT_GT(last["run"]["rows_resumed"], 0);
  EXPECT_EQ(finished_files(), (std::set<std::string>{"f.hcf", "f.rows.csv"}));
  const Json solved = report({"solve", scene_, "--max-edge", "0.0625", "--form-factors",
                              path("f.hcf"), "--json", "--no-black-irradiance"});
  EXPECT_EQ(solved["result"]["hashes"]["form_factors"],
            expected["result"]["hashes"]["form_factors"]);
}

TEST_F(KilledRunsTest, AKilledSolveGoesOnUntilItEnds) {
  const Json expected = report(slow({"solve"}, "2"));
  const Json last =
      run_through_signals(slow({"solve", "-o", path("out")}), "out/form_factors.hcf", 2);
  EXPECT_EQ(last["result"], expected["result"]);
  EXPECT_GT(last["run"]["rows_resumed"], 0);
  EXPECT_EQ(finished_files(),
            (std::set<std::string>{"out/", "out/groups.csv", "out/patches.csv", "out/report.json",
                                   "out/solution.glb", "out/solution.ply", "out/solution_float.ply",
                                   "out/view.exr", "out/view.png"}));
  EXPECT_EQ(Json::parse(read("out/report.json"))["result"], expected["result"]);
}

TEST_F(KilledRunsTest, ShortRunsThatAreInterruptedLeaveNothing) {
  for (const Words& words :
       {slow({"formfactors", "-o", path("f.hcf")}), slow({"formfactors", "-o", path("f.mtx")}),
        slow({"solve", "-o", path("out")}), slow({"solve", "--form-factors", path("f.hcf")})}) {
    const std::set<std::string> before = new_files();
    const auto start = Clock::now();
    Program program(hemicube_path(), words);
    ASSERT_TRUE(stop_after(&program, 400, SIGINT));
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exit_code, 130);
    if (Clock::now() - start < std::chrono::milliseconds(kUntilFirst)) { // on a machine that stalls
      EXPECT_EQ(result.err.find("goes on"), std::string::npos) << result.err;
      EXPECT_EQ(new_files(), before);
    }
  }
}

// Catches: runs that write into each other's files, or into a file that was put in place.
TEST_F(KilledRunsTest, OfTwoRunsOnOneOutputOneEndsWell) {
  const Json expected = report(slow({"formfactors"}, "2"));
  const Words words = slow({"formfactors", "-o", path("f.hcf")});
  Program first(hemicube_path(), words), second(hemicube_path(), words);
  // Whoever writes owns the file; one that is merely there may not be owned yet.
  wait_until([&] { return size_of("f.hcf.part") > 0; }, &first);
  // Who comes later learns it at once.
  const ProgramResult late = run(1, words);
  EXPECT_NE(late.err.find(path("f.hcf.part") + ": is in use"), std::string::npos) << late.err;
  ProgramResult results[] = {first.wait(), second.wait()};
  if (results[0].exit_code != 0)
    std::swap(results[0], results[1]);
  EXPECT_EQ(results[0].exit_code, 0) << results[0].err;
  EXPECT_EQ(results[1].exit_code, 1);
  EXPECT_NE(results[1].err.find(path("f.hcf.part") + ": is in use"), std::string::npos)
      << results[1].err;
  EXPECT_EQ(Json::parse(results[0].out)["result"], expected["result"]);
  EXPECT_EQ(new_files(), (std::set<std::string>{"f.hcf", "f.rows.csv"}));
  const Json given = report(
      {"formfactors", scene_, "--max-edge", "0.0625", "--form-factors", path("f.hcf"), "--json"});
  EXPECT_EQ(given["result"]["hashes"]["form_factors"],
            expected["result"]["hashes"]["form_factors"]);
}

// A limit on the size of files is as good as a full disk. Catches: rows that are lost with the
// disk.
TEST_F(KilledRunsTest, AFullDiskSaysWhatToDo) {
  const Json expected = report(slow({"formfactors"}, "2"));
  const Words words = slow({"formfactors", "-o", path("f.hcf")});
  Words arguments = {"-c", "ulimit -f 2000; exec \"$0\" \"$@\"", hemicube_path()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  Program program("/bin/sh", arguments);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 1);
  expect_said(result.err, {path("f.hcf.part"), "File too large", "make room and run again"});
  EXPECT_EQ(new_files(), std::set<std::string>{"f.hcf.part"});
  const Json last = report(slow({"formfactors", "-o", path("f.hcf")}, "2"));
  EXPECT_EQ(last["result"], expected["result"]);
  EXPECT_GT(last["run"]["rows_resumed"], 0);
  EXPECT_EQ(new_files(), (std::set<std::string>{"f.hcf", "f.rows.csv"}));
}

// The dial may find rows too coarse once light is solved with them; an error is estimated last.
// Catches: rows of a run that did not end given to the next one as if they were its result.
TEST_F(KilledRunsTest, RowsOfASolveThatDidNotEndAreNotItsResult) {
  const auto words = [&](const std::string& name) {
    return Words{"solve",      scene_, "--rung",         "hemicube", "--resolution", "32",
                 "--max-edge", "0.05", "--form-factors", path(name), "--json"};
  };
  const Json expected = report(words("g.hcf"));
  ASSERT_TRUE(expected["result"].contains("error"));
  ProgramResult result;
  do { // until a signal does not come too late
    std::filesystem::remove(path("f.hcf"));
    Program program(hemicube_path(), words("f.hcf"));
    wait_until([&] { return size_of("f.hcf.part") >= size_of("g.hcf"); }, &program);
    program.send(SIGINT);
    result = program.wait();
  } while (result.exit_code == 0);
  ASSERT_EQ(result.exit_code, 130) << result.err;
  expect_said(result.err, {path("f.hcf.part"), "the same command goes on from there"});
  EXPECT_FALSE(std::filesystem::exists(path("f.hcf")));
  const Json last = report(words("f.hcf"));
  EXPECT_EQ(last["result"], expected["result"]);
  EXPECT_EQ(last["run"]["rows_resumed"], expected["result"]["patches"]);
  EXPECT_EQ(new_files(), (std::set<std::string>{"f.hcf", "g.hcf"}));
}

// Catches: what another request left mixed into this one's rows, or kept for ever.
TEST_F(KilledRunsTest, AnotherRequestBeginsAnew) {
  Program program(hemicube_path(), slow({"formfactors", "-o", path("f.hcf")}));
  wait_for("f.hcf.part", &program);
  ASSERT_TRUE(stop_after(&program, 0, SIGKILL));
  program.wait();
  ASSERT_TRUE(std::filesystem::exists(path("f.hcf.part")));
  const Words quick = {"formfactors", scene_,     "--max-edge", "0.0625",
                       "--rung",      "hemicube", "--json",     "--resolution",
                       "16",          "-o",       path("f.hcf")};
  const Json other = report(quick);
  EXPECT_EQ(other["run"]["rows_resumed"], 0);
  EXPECT_EQ(new_files(), (std::set<std::string>{"f.hcf", "f.rows.csv"}));
  EXPECT_EQ(other["result"], report({quick.begin(), quick.end() - 2})["result"]);
}

} // namespace
} // namespace hemicube::test
