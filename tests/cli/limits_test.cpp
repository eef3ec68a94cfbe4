// Little memory, few files, a disk that ends, and input that is large, deep or garbage: a clear
// error or the right result.

#include "tests/cli/cli_case.h"

#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kHasShadowMemory = true; // terabytes of addresses
#else
constexpr bool kHasShadowMemory = false;
#endif

class LimitsTest : public CliCase {
protected:
  /// Runs the program after commands of the shell, such as "ulimit -f 1".
  static ProgramResult run_under(const std::string& commands, const Words& words) {
    Words all = {"-c", commands + R"(; exec "$0" "$@")", hemicube_path()};
    all.insert(all.end(), words.begin(), words.end());
    return Program("/bin/sh", all).wait();
  }

  Words small(Words words) const {
    for (const char* word : {"--rung", "hemicube", "--resolution", "16", "--threads", "2"})
      words.push_back(word);
    return words;
  }

  /// Exit 1 and, last on stderr, a message of the program that holds `part`.
  static void expect_failed(const ProgramResult& result, const std::string& part) {
    EXPECT_EQ(result.exit_code, 1) << result.err;
    const Words lines = lines_of(result.err);
    ASSERT_FALSE(lines.empty());
    EXPECT_TRUE(lines.back().starts_with("hemicube: ")) << result.err;
    EXPECT_NE(lines.back().find(part), std::string::npos) << result.err;
  }

  /// A sheet of n x n quads; text(k) goes before the k-th.
  template <typename Text> std::string write_sheet(int n, const std::string& head, Text text) {
    std::string obj = head;
    const auto number = [&obj](int value) { obj.append(" ").append(std::to_string(value)); };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        obj += "v";
        number(i);
        number(j);
        obj += " 0\n";
      }
    for (int k = 0; k < n * n; ++k) {
      const int a = k / n * (n + 1) + k % n + 1;
      obj += text(k) + "f";
      for (const int corner : {a, a + 1, a + n + 2, a + n + 1})
        number(corner);
      obj += "\n";
    }
    return write("sheet.obj", obj);
  }

  /// Form factors of one of many patches, in no more memory than the program itself plans for
  /// (cli/memory_plan.cpp): 1,750 bytes a patch of three bands, and 16 MiB with two threads.
  void expect_one_row(const std::string& scene, int patches) const {
    const Json report =
        Json::parse(run(0, small({"formfactors", scene, "--rows", "0", "--json", "--quiet"})).out);
    EXPECT_EQ(report["result"]["patches"], patches);
    if (!kHasShadowMemory) {
      EXPECT_LT(report["run"]["peak_memory_bytes"].get<double>(), 1750.0 * patches + (16 << 20));
    }
  }
};

// Catches: a crash, or files half made, where memory ends in whatever is being done.
TEST_F(LimitsTest, WhereMemoryEndsSoDoesTheRunWithAMessage) {
  if (kHasShadowMemory)
    GTEST_SKIP() << "no limit of addresses is large enough for AddressSanitizer";
  const std::string scene = write_room();
  const std::string hashes = lines_of(run(0, small({"solve", scene})).out).at(1);
  int failed = 0, done = 0;
  for (int kib = 8000; done == 0; kib += 700) {
    SCOPED_TRACE(std::to_string(kib) + " KiB");
    const std::string limit = "ulimit -v " + std::to_string(kib);
    if (run_under(limit, {"--version"}).exit_code != 0)
      continue; // less than the system needs to begin
    const ProgramResult result = run_under(limit, small({"solve", scene}));
    done += result.exit_code == 0;
    failed += result.exit_code != 0;
    if (result.exit_code == 0)
      EXPECT_EQ(lines_of(result.out).at(1), hashes);
    else
      expect_failed(result, "");
    ASSERT_LT(kib, 400000);
  }
  EXPECT_GT(failed, 5);
}

// Every request of the process fails from some one on, also those of destructors and of messages.
TEST_F(LimitsTest, WithoutAnyMemoryLeftTheRunStillSaysWhy) {
  if (kHasShadowMemory)
    GTEST_SKIP() << "AddressSanitizer must come first among what is preloaded";
  const std::string scene = write_room();
  const std::string hashes = lines_of(run(0, small({"solve", scene})).out).at(1);
  int failed = 0;
  for (int from = 0;; from += from < 40 ? 1 : 29) {
    SCOPED_TRACE("from the request " + std::to_string(from));
    const ProgramResult result =
        run_hemicube(small({"solve", scene}),
                     {.environment = {{"LD_PRELOAD", HC_BINARY_DIR "/tests/failing_malloc.so"},
                                      {"FAIL_FROM", std::to_string(from)}},
                      .out_path = ""});
    if (result.exit_code == 0) {
      EXPECT_EQ(lines_of(result.out).at(1), hashes);
      break;
    }
    expect_failed(result, "");
    ASSERT_LT(++failed, 1000);
  }
  EXPECT_GT(failed, 60);
}

/// Beside the three that every program has.
constexpr const char* kOneFile = "exec 3>&-; ulimit -n 4";

TEST_F(LimitsTest, ASolveNeedsOneFileAtATime) {
  const std::string scene = write_room();
  const ProgramResult solved = run_under(kOneFile, small({"solve", scene, "-o", path("out")}));
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_TRUE(std::filesystem::exists(path("out/patches.csv")));
}

// The file of rows stays open while the others are written. Catches: a finished run without a
// file and without a word.
TEST_F(LimitsTest, TooFewFilesAreNamed) {
  const std::string scene = write_room();
  for (const Words& words :
       std::vector<Words>{{"formfactors", scene, "-o", path("f.hcf")},
                          {"solve", scene, "--form-factors", path("f.hcf"), "-o", path("out")}})
    expect_failed(run_under(kOneFile, small(words)), "Too many open files");
}

// A limit on the size of files is as good as a full disk. Catches: files left behind by a signal,
// and the first part of a solution in the place of the one before.
TEST_F(LimitsTest, AFullDiskLeavesNothingHalfDone) {
  const std::string scene = write_room();
  const std::vector<Words> commands = {
      {"solve", scene, "-o", path("out")},
      {"formfactors", scene, "--max-edge", "0.2", "-o", path("f.mtx")},
      {"look", scene, "--patch", "0", "-o", path("look.png")},
      {"render", scene, "-o", path("view.exr")}};
  for (const Words& words : commands)
    for (const int blocks : {0, 3}) {
      SCOPED_TRACE(words[0] + " within " + std::to_string(blocks) + " blocks");
      const std::string limit = "ulimit -f " + std::to_string(blocks);
      Words all = words;
      if (words[0] != "look")
        all = small(words);
      expect_failed(run_under(limit, all), "File too large");
      EXPECT_EQ(new_files(), std::set<std::string>());
    }
  run(0, small(commands[0]));
  const std::string before = read("out/patches.csv");
  expect_failed(
      run_under("ulimit -f 3", small({"solve", scene, "--max-edge", "0.5", "-o", path("out")})),
      "File too large");
  EXPECT_EQ(read("out/patches.csv"), before);
}

TEST_F(LimitsTest, ADeviceThatIsFullIsAFailure) {
  const std::string scene = write_room();
  for (const Words& words : std::vector<Words>{{"--help"}, {"solve", scene, "--json"}}) {
    const ProgramResult result = run(1, words, {.environment = {}, .out_path = "/dev/full"});
    EXPECT_NE(result.err.find("stdout cannot be written"), std::string::npos) << result.err;
  }
  expect_refused(1, {"solve", scene, "-o", "/dev/full"}, {"/dev/full", "-o"});
}

// Catches: time or memory that grows faster than the file.
TEST_F(LimitsTest, AHundredThousandFaces) {
  const std::string scene = write_sheet(317, "", [](int) { return std::string(); });
  expect_one_row(scene, 317 * 317);
}

TEST_F(LimitsTest, AHundredThousandMaterialsAndGroups) {
  const auto name = [](int k) { return "material_" + std::to_string(k); };
  std::string mtl;
  for (int k = 0; k < 317 * 317; ++k)
    mtl += "newmtl " + name(k) + "\nKd 0.5 0.5 0.5\n";
  write("many.mtl", mtl);
  const std::string scene = write_sheet(317, "mtllib many.mtl\n", [&](int k) {
    return "g group_" + std::to_string(k) + "\nusemtl " + name(k) + "\n";
  });
  expect_one_row(scene, 317 * 317);
}

// Catches: a parser that keeps more of a file than it can use, or reads what is there twice.
TEST_F(LimitsTest, MegabytesOfGarbageAreRefused) {
  constexpr std::size_t kBytes = std::size_t{1} << 20;
  const auto repeated = [](const std::string& part) {
    std::string text;
    while (text.size() < kBytes)
      text += part;
    return text;
  };
  const struct {
    const char *file, *head, *part, *message;
  } cases[] = {
      {"zeros.obj", "", " ", "has no faces"},
      {"one_line.obj", "v 0 0 0\nf", " 1", "no face of the scene has an area"},
      {"one_word.obj", "v ", "7", "one_word.obj:1: "},
      {"joined.obj", "v 0 0 0\n", "f 1 1 1 \\\n", "joined.obj:2: "},
      {"groups.obj", "", "g a\n", "has no faces"},
      {"ahead.obj", "", "f 1 2 3\n", "ahead.obj:1: "},
      {"unknown.obj", "", "?\n", "has no faces"},
      {"deep.json", "", "[", "nested deeper than 64 levels"},
      {"deep_objects.json", "", "{\"a\":", "nested deeper than 64 levels"},
      {"wide.json", "[", "1,", "not valid JSON"},
      {"text.ply", "ply\nformat ascii 1.0\n", "comment\n", "text.ply"},
      {"text.off", "OFF\n", "1 ", "text.off"},
      {"text.stl", "solid\n", "facet\n", "text.stl"},
      {"text.gltf", "", "{\"asset\":", "nested deeper than 64 levels"},
  };
  for (const auto& garbage : cases) {
    SCOPED_TRACE(garbage.file);
    const std::string scene = write(garbage.file, garbage.head + repeated(garbage.part));
    const Words words = {"info", scene};
    const ProgramResult result =
        kHasShadowMemory ? run(3, words) : run_under("ulimit -v 250000", words);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_LT(result.err.size(), 1000u);
    EXPECT_NE(result.err.find(garbage.message), std::string::npos) << result.err;
  }
}

// Catches: names that a shell, a library or the writer of JSON takes apart.
TEST_F(LimitsTest, PathsOfEveryKind) {
  const std::string odd = "it's \"odd\" \\ $HOME %s \xc3\xbc\xe6\x97\xa5";
  std::string obj(kRoomObj);
  obj.replace(obj.find("room.mtl"), 8, odd + ".mtl");
  write(odd + ".mtl", kRoomMtl);
  const std::string scene = write(odd + ".obj", obj), out = path("out " + odd);
  const std::string hashes = lines_of(run(0, small({"solve", write_room()})).out).at(1);
  const ProgramResult solved = run(0, small({"solve", scene, "-o", out}));
  EXPECT_EQ(lines_of(solved.out).at(1), hashes + "; files in " + out);
  write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.5,0,0,1\n");
  run(0, {"probe", out, "--points", path("points.csv")});
  run(0, {"render", out, "-o", path(odd + ".png")});
  EXPECT_TRUE(std::filesystem::exists(path(odd + ".png")));
}

} // namespace
} // namespace hemicube::test
