// Form factors in files: made, read, refused; those of groups; the memory that rows may take.

#include "tests/cli/cli_case.h"

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class KeptFilesTest : public CliCase {
protected:
  /// The options of a mesh of 24 patches on a rung.
  static Words on_rung(Words words, const std::string& rung = "hemicube") {
    for (const char* word : {"--max-edge", "0.5", "--resolution", "64", "--rung"})
      words.push_back(word);
    words.push_back(rung);
    return words;
  }

  Json report(Words words) const {
    words.push_back("--json");
    return Json::parse(run(0, words).out);
  }

  /// Makes f.hcf and takes its bytes away again.
  std::string make_hcf(const std::string& scene, const std::string& rung = "hemicube") {
    run(0, on_rung({"formfactors", scene, "-o", path("f.hcf"), "--quiet"}, rung));
    const std::string bytes = read("f.hcf");
    std::filesystem::remove(path("f.hcf"));
    std::filesystem::remove(path("f.rows.csv"));
    return bytes;
  }
};

// Catches: files that hold other rows than were computed, or that are not read at all.
TEST_F(KeptFilesTest, FormFactorsOfAFileGiveTheSameLight) {
  const std::string scene = write_room();
  for (const std::string rung : {"hemicube", "analytic", "area", "adaptive", "exact"}) {
    SCOPED_TRACE(rung);
    const Json rows = report(on_rung({"formfactors", scene}, rung));
    const Json made = report(on_rung({"formfactors", scene, "-o", path("f.hcf")}, rung));
    EXPECT_EQ(made["result"], rows["result"]);
    EXPECT_EQ(made["run"]["rows_resumed"], 0);
    EXPECT_EQ(new_files(), (std::set<std::string>{"f.hcf", "f.rows.csv"}));
    const std::string bytes = read("f.hcf");
    const Json expected = report(on_rung({"solve", scene}, rung));
    const Json solved =
        report({"solve", scene, "--max-edge", "0.5", "--form-factors", path("f.hcf")});
    EXPECT_EQ(solved["result"]["hashes"]["radiosity"], expected["result"]["hashes"]["radiosity"]);
    EXPECT_EQ(solved["result"]["energy"], expected["result"]["energy"]);
    EXPECT_EQ(solved["result"]["hashes"]["form_factors"], rows["result"]["hashes"]["form_factors"]);
    EXPECT_EQ(solved["run"]["rows_resumed"], 24);
    run(0, on_rung({"formfactors", scene, "-o", path("a.mtx")}, rung));
    run(0, {"formfactors", scene, "--max-edge", "0.5", "-o", path("b.mtx"), "--form-factors",
            path("f.hcf")});
    EXPECT_EQ(read("a.mtx"), read("b.mtx"));
    EXPECT_EQ(read("a.rows.csv"), read("f.rows.csv"));
    EXPECT_EQ(read("f.hcf"), bytes) << "what is given is only read";
    for (const char* name : {"a.mtx", "a.rows.csv", "b.mtx", "b.rows.csv", "f.hcf", "f.rows.csv"})
      std::filesystem::remove(path(name));
  }
}

TEST_F(KeptFilesTest, ASolveMakesTheFileThatIsNotThereAndReadsItNext) {
  const std::string scene = write_room();
  const std::string expected = report(on_rung({"solve", scene}))["result"]["hashes"]["radiosity"];
  const Words words = on_rung({"solve", scene, "--form-factors", path("f.hcf"), "-o", path("out")});
  const Json first = report(words);
  EXPECT_EQ(first["result"]["hashes"]["radiosity"], expected);
  EXPECT_EQ(first["run"]["rows_resumed"], 0);
  const std::string bytes = read("f.hcf"), patches = read("out/patches.csv");
  const Json second = report(words);
  EXPECT_EQ(second["result"]["hashes"], first["result"]["hashes"]);
  EXPECT_EQ(second["run"]["rows_resumed"], 24);
  EXPECT_EQ(read("f.hcf"), bytes);
  EXPECT_EQ(read("out/patches.csv"), patches);
  for (const std::string& name : new_files())
    EXPECT_EQ(name.find(".part"), std::string::npos) << name;
}

// Catches: the light of the materials that the file was made with.
TEST_F(KeptFilesTest, OtherMaterialsUseTheSameFile) {
  const std::string hcf = write("given.hcf", make_hcf(write_room()));
  std::string mtl(kRoomMtl);
  mtl.replace(mtl.find("0.5"), 3, "0.7");
  const std::string scene = write_room(kRoomObj, mtl);
  const Json given = report({"solve", scene, "--max-edge", "0.5", "--form-factors", hcf});
  EXPECT_EQ(given["result"]["hashes"]["radiosity"],
            report(on_rung({"solve", scene}))["result"]["hashes"]["radiosity"]);
}

TEST_F(KeptFilesTest, WhatIsNoSoundFileOfThisMeshIsABadScene) {
  const std::string scene = write_room(), sound = make_hcf(scene);
  const auto refused = [&](const std::string& bytes, const std::string& max_edge,
                           const std::string& why) {
    const std::string hcf = write("bad.hcf", bytes);
    const Words parts = {hcf, why};
    expect_refused(
        3, {"solve", scene, "--max-edge", max_edge, "--form-factors", hcf, "-o", path("out")},
        parts);
    expect_refused(
        3,
        {"formfactors", scene, "--max-edge", max_edge, "--form-factors", hcf, "-o", path("f.mtx")},
        parts);
    EXPECT_EQ(read("bad.hcf"), bytes);
  };
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{100}, sound.size() / 2, sound.size() - 30, sound.size() - 1}) {
    std::string bytes = sound;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    refused(bytes, "0.5", "");
  }
  for (const std::size_t size : {sound.size() - 1, sound.size() / 2, std::size_t{150}})
    refused(sound.substr(0, size), "0.5", "cut off");
  refused(sound.substr(0, 100), "0.5", "is not a file of form factors");
  refused("", "0.5", "is not a file of form factors");
  refused(std::string(kRoomObj), "0.5", "is not a file of form factors");
  refused(sound + "x", "0.5", "");
  refused(sound, "0.3", "24 patches of another mesh");
}

TEST_F(KeptFilesTest, OptionsThatContradictTheFileAreUsageErrors) {
  const std::string scene = write_room(), hcf = write("given.hcf", make_hcf(scene));
  const auto words = [&](const char* option, const char* value) {
    return Words{"solve", scene, "--max-edge", "0.5",  "--form-factors",
                 hcf,     "-o",  path("out"),  option, value};
  };
  expect_refused(2, words("--rung", "adaptive"), {hcf, "rung hemicube, resolution 64"});
  expect_refused(2, words("--resolution", "128"), {hcf, "rung hemicube, resolution 64"});
  run(0, words("--rung", "hemicube"));
}

TEST_F(KeptFilesTest, FilesThatHoldAllRowsHoldNothingElse) {
  const std::string scene = write_room(), hcf = path("f.hcf");
  expect_refused(2, {"formfactors", scene, "-o", hcf, "--rows", "1"}, {"--rows"});
  expect_refused(2, {"formfactors", scene, "-o", hcf, "--balance"}, {"--balance"});
  expect_refused(2, {"formfactors", scene, "-o", hcf, "--form-factors", path("g.hcf")},
                 {"--form-factors"});
  expect_refused(2, {"formfactors", scene, "--form-factors", hcf, "--rows", "1"}, {"--rows"});
}

// Catches: an hour of work before it turns out that it cannot be kept.
TEST_F(KeptFilesTest, FilesThatCannotBeMadeAreFoundBeforeTheWork) {
  const std::string scene = write_room();
  const Words long_run = {"--resolution", "2048", "--rung", "hemicube", "--max-edge", "0.01"};
  const auto refused = [&](Words words, const std::string& part) {
    words.insert(words.end(), long_run.begin(), long_run.end());
    expect_refused(1, words, {part});
  };
  refused({"formfactors", scene, "-o", path("room.mtl") + "/f.hcf"}, path("room.mtl"));
  refused({"solve", scene, "--form-factors", path("room.mtl") + "/f.hcf"}, path("room.mtl"));
  // In the place of the file that an unfinished run leaves.
  write("other", "precious");
  write("f.hcf.part", "");
  std::filesystem::remove(path("f.hcf.part"));
  std::filesystem::create_symlink(path("other"), path("f.hcf.part"));
  refused({"formfactors", scene, "-o", path("f.hcf")}, path("f.hcf.part"));
  EXPECT_EQ(read("other"), "precious");
  std::filesystem::remove(path("f.hcf.part"));
  std::filesystem::create_directory(path("f.hcf.part"));
  const ProgramResult result = run(1, {"formfactors", scene, "-o", path("f.hcf")});
  EXPECT_NE(result.err.find(path("f.hcf.part")), std::string::npos) << result.err;
}

TEST_F(KeptFilesTest, TooLittleMemorySaysHowMuchIsNeeded) {
  const std::string scene = write_room();
  for (const char* size : {"10MB", "1", "1KiB"}) {
    expect_refused(1, {"solve", scene, "--memory", size, "-o", path("out")},
                   {"--memory", "6 patches need about", "MB besides"});
    expect_refused(1, {"formfactors", scene, "--memory", size, "-o", path("f.hcf")},
                   {"--memory", "6 patches need about", "MB besides"});
  }
  run(0, {"solve", scene, "--memory", "40MiB"});
}

TEST_F(KeptFilesTest, MemoryThatIsNoSizeIsAUsageError) {
  const std::string scene = write_room();
  for (const std::string size : {"", "lots", "-5MB", "0", "0GB", "4XB", "4 GiBs", "nan", "inf",
                                 "1e400", "0x10", "GiB", "1e30GB"})
    expect_refused(2, {"solve", scene, "--memory", size, "-o", path("out")}, {"--memory " + size});
}

// 1,536 patches; rows of 15 MB.
TEST_F(KeptFilesTest, FormFactorsBeyondMemoryAreTheSame) {
  const std::string scene = write_room();
  const auto words = [&](Words more) {
    Words all = {"formfactors", scene,          "--max-edge", "0.0625",    "--rung",
                 "hemicube",    "--resolution", "32",         "--threads", "2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const Json expected = report(words({"--by-group", "-o", path("all.csv")}));
  const Json little = report(words({"--by-group", "-o", path("little.csv"), "--memory", "24MiB"}));
  EXPECT_EQ(little["result"], expected["result"]);
#ifndef __SANITIZE_ADDRESS__ // which keeps what was given back for a while
  EXPECT_LT(little["run"]["peak_memory_bytes"], expected["run"]["peak_memory_bytes"]);
#endif
  EXPECT_EQ(read("little.csv"), read("all.csv"));
  EXPECT_EQ(report(words({"-o", path("f.hcf"), "--memory", "24MiB"}))["result"],
            expected["result"]);
  const Json given = report(words({"--form-factors", path("f.hcf"), "--memory", "24MiB"}));
  EXPECT_EQ(given["result"]["hashes"], expected["result"]["hashes"]);
  EXPECT_EQ(given["result"]["reciprocity"], expected["result"]["reciprocity"]);
  EXPECT_EQ(new_files(), (std::set<std::string>{"all.csv", "f.hcf", "f.rows.csv", "little.csv"}));
}

TEST_F(KeptFilesTest, LightBeyondMemoryIsTheSame) {
  const std::string scene = write_room();
  const Words words = {"solve",    scene,          "--max-edge", "0.0625",    "--rung",
                       "hemicube", "--resolution", "32",         "--threads", "2"};
  Words little = words;
  little.insert(little.end(), {"--memory", "24MiB"});
  EXPECT_EQ(report(little)["result"], report(words)["result"]);
  EXPECT_EQ(new_files(), std::set<std::string>());
}

/// The cube with a group per side, and one whose only face has no area.
constexpr std::string_view kGroups = "mtllib room.mtl\n"
                                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                     "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                     "g floor\nusemtl white\nf 1 2 3 4\n"
                                     "g ghost\nf 1 2 2\n"
                                     "g ceiling\nusemtl light\nf 5 8 7 6\n"
                                     "g sides\nusemtl red\nf 1 4 8 5\n"
                                     "usemtl white\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n";

double number(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

TEST_F(KeptFilesTest, FormFactorsOfGroups) {
  const std::string scene = write_room(kGroups);
  const Json made =
      report(on_rung({"formfactors", scene, "--by-group", "-o", path("g.csv")}, "area"));
  EXPECT_EQ(new_files(), std::set<std::string>{"g.csv"});
  const std::string csv = read("g.csv");
  const Words names = {"floor", "ceiling", "sides"};
  ASSERT_EQ(lines_of(csv).front(), "group,area,floor,ceiling,sides,space,back_side");
  ASSERT_EQ(column_of(csv, "group"), names);
  const auto value = [&](std::size_t row, const std::string& column) {
    return number(column_of(csv, column).at(row));
  };
  // Pairs of patches are reciprocal to within this times their area; 16 x 4 of them between two
  // groups at most.
  const double reciprocal = made["result"]["reciprocity"]["max"].get<double>() * 0.25 * 64 + 1e-14;
  EXPECT_LT(reciprocal, 1e-4);
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_NEAR(value(g, "area"), g == 2 ? 4 : 1, 1e-12);
    double sum = value(g, "space") + value(g, "back_side");
    for (std::size_t h = 0; h < 3; ++h) {
      sum += value(g, names[h]);
      EXPECT_NEAR(value(g, "area") * value(g, names[h]), value(h, "area") * value(h, names[g]),
                  reciprocal);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  EXPECT_NEAR(value(0, "ceiling"), 0.19982489569838738, 1e-6); // Howell C-11
  EXPECT_EQ(value(0, "floor"), 0);
}

// Catches: losses that are left out of the groups.
TEST_F(KeptFilesTest, GroupsOfAnOpenSceneLoseLight) {
  const std::string scene =
      write("open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                        "g low\nf 1 2 3 4\ng \"high, up\"\nf 5 6 7 8\n");
  run(0, {"formfactors", scene, "--by-group", "-o", path("g.csv"), "--quiet"});
  const Words lines = lines_of(read("g.csv"));
  ASSERT_EQ(lines.size(), 3u);
  // Both have the area 1; a line ends in the form factors of both, space and back sides.
  std::vector<std::vector<double>> shares;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    std::string line = lines[k];
    double sum = 0;
    for (shares.emplace_back(); shares.back().size() < 4; line.resize(line.rfind(',')))
      sum += shares.back().emplace_back(number(line.substr(line.rfind(',') + 1)));
    EXPECT_NEAR(sum, 1, 1e-12) << lines[k];
  }
  constexpr double kOpposite = 0.19982489569838738; // Howell C-11
  EXPECT_NEAR(shares[0][0], kOpposite, 1e-2) << "the floor sees the other one's back";
  EXPECT_NEAR(shares[0][1], 1 - kOpposite, 1e-2);
  EXPECT_EQ(shares[1][1], 1) << "the other one sees space alone";
}

TEST_F(KeptFilesTest, GroupsAreWrittenAsCsvOnly) {
  const std::string scene = write_room(kGroups);
  for (const char* name : {"g.mtx", "g.hcf", "g"})
    expect_refused(2, {"formfactors", scene, "--by-group", "-o", path(name)}, {".csv"});
  expect_refused(2, {"formfactors", scene, "-o", path("g.csv")}, {".mtx"});
  expect_refused(2, {"formfactors", scene, "--by-group", "--rows", "1", "-o", path("g.csv")},
                 {"--rows"});
}

} // namespace
} // namespace hemicube::test
