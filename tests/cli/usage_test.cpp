// What the program accepts: help, version, and usage errors (exit 2).

#include "tests/cli/cli_case.h"

#include <fstream>

namespace hemicube::test {
namespace {

using UsageTest = CliCase;

const std::vector<std::string> kCommands = {"solve", "formfactors", "render", "info",
                                            "look",  "probe",       "verify"};

TEST_F(UsageTest, HelpNamesEveryCommandAndExitStatus) {
  const ProgramResult result = run(0, {"--help"});
  for (const std::string& command : kCommands)
    EXPECT_NE(result.out.find("\n  " + command + " "), std::string::npos) << command;
  EXPECT_NE(result.out.find("130 interrupted"), std::string::npos);
  EXPECT_EQ(result.err, "");
}

TEST_F(UsageTest, HelpOfACommandShowsItsOwnAndTheCommonOptions) {
  const std::vector<std::pair<std::string, std::string>> own = {{"solve", "--no-black-irradiance"},
                                                                {"formfactors", "--points"},
                                                                {"render", "--camera-position"},
                                                                {"info", "SCENE"},
                                                                {"look", "--patch"},
                                                                {"probe", "--points"},
                                                                {"verify", "--rung"}};
  for (const auto& [command, option] : own) {
    const ProgramResult result = run(0, {command, "--help"});
    EXPECT_NE(result.out.find("hemicube " + command), std::string::npos) << result.out;
    for (const std::string& expected :
         {option, std::string("--resolution"), std::string("--tolerance"), std::string("--balance"),
          std::string("--max-edge"), std::string("--threads"), std::string("--isa"),
          std::string("--json"), std::string("--quiet"), std::string("--hash-items")})
      EXPECT_NE(result.out.find(expected), std::string::npos) << command << " " << expected;
  }
}

// Catches: a command that came or went without a word in the README.
TEST_F(UsageTest, TheReadmeListsTheCommandsOfHelp) {
  std::set<std::string> of_help, of_readme;
  bool is_command = false;
  for (const std::string& line : lines_of(run(0, {"--help"}).out)) {
    if (is_command && line.starts_with("  ") && line[2] != ' ')
      of_help.insert(line.substr(2, line.find(' ', 2) - 2));
    is_command = line.starts_with("  ") ? is_command : line.starts_with("Commands");
  }
  std::ifstream readme(HC_SOURCE_DIR "/README.md");
  const std::string start = "    hemicube ";
  for (std::string line; std::getline(readme, line);)
    if (line.starts_with(start))
      of_readme.insert(line.substr(start.size(), line.find(' ', start.size()) - start.size()));
  EXPECT_EQ(of_help, std::set<std::string>(kCommands.begin(), kCommands.end()));
  EXPECT_EQ(of_readme, of_help);
}

TEST_F(UsageTest, VersionIsOneLineOnStdout) {
  const ProgramResult result = run(0, {"--version"});
  EXPECT_TRUE(result.out.starts_with("hemicube ")) << result.out;
  EXPECT_EQ(lines_of(result.out).size(), 1u);
}

TEST_F(UsageTest, WithoutACommandItListsThem) {
  expect_refused(2, {}, kCommands);
}

TEST_F(UsageTest, UnknownCommandsAndOptionsAreNamed) {
  const std::string scene = write_room();
  expect_refused(2, {"paint", scene}, {"'paint'", "solve", "look"});
  expect_refused(2, {"--colour"}, {"--colour"});
  expect_refused(2, {"solve", scene, "--colour"}, {"--colour", "hemicube solve --help"});
  expect_refused(2, {"solve", scene, "left.obj"}, {"left.obj"});
  expect_refused(2, {"solve"}, {"SCENE"});
  expect_refused(2, {"solve", ""}, {"SCENE"});
  expect_refused(2, {"render", scene}, {"-o"});
  expect_refused(2, {"look", scene}, {"--patch", "--face"});
}

TEST_F(UsageTest, ValuesOutOfRangeAreNamedWithTheRange) {
  const std::string scene = write_room();
  for (const std::string value :
       {"0", "3", "14", "2050", "17", "-16", "1e2", "0x100", "256 ", "", "99999999999999999999"})
    expect_refused(2, {"solve", scene, "--resolution", value},
                   {"--resolution " + value, "even", "16..2048"});
  for (const std::string value : {"0", "-1", "1.5", "many", "5000000000"})
    expect_refused(2, {"solve", scene, "--threads", value}, {"--threads " + value});
  for (const std::string value : {"0", "-1e-6", "1", "nan", "inf", "1e-6x", "1,5"})
    expect_refused(2, {"solve", scene, "--tolerance", value}, {"--tolerance " + value});
  for (const std::string value : {"0", "-0.1", "1", "nan", "inf"})
    expect_refused(2, {"solve", scene, "--solver", "progressive", "--stop-unshot", value},
                   {"--stop-unshot " + value});
  for (const std::string value : {"-1", "1.5", "nan", "many"})
    expect_refused(2, {"solve", scene, "--solver", "progressive", "--max-shots", value},
                   {"--max-shots " + value});
  expect_refused(2, {"solve", scene, "--solver", "progressive", "--snapshot-every", "0"},
                 {"--snapshot-every 0"});
  expect_refused(2, {"solve", scene, "--solver", "progressive", "--snapshot-every", "5"},
                 {"--snapshot-every", "-o"});
  expect_refused(2, {"solve", scene, "--solver", "guess"}, {"--solver guess", "jacobi"});
  expect_refused(2, {"solve", scene, "--max-shots", "5"}, {"--max-shots", "progressive"});
  for (const std::string value : {"0", "-1", "nan", "inf", "1m"})
    expect_refused(2, {"solve", scene, "--max-edge", value}, {"--max-edge " + value});
  for (const std::string value : {"0x5", "100", "10x", "16385x1", "-1x4"})
    expect_refused(2, {"render", scene, "-o", path("a.png"), "--size", value}, {"--size " + value});
  for (const std::string value : {"1,2", "1,2,3,4", "1,2,", "a,b,c", "nan,0,0", "1, 2,3"})
    expect_refused(2, {"render", scene, "-o", path("a.png"), "--camera-target", value},
                   {"--camera-target " + value, "x,y,z"});
  expect_refused(2, {"render", scene, "-o", path("a.png"), "--fov", "180"}, {"--fov 180"});
  expect_refused(2, {"solve", scene, "--exposure", "0"}, {"--exposure 0"});
}

TEST_F(UsageTest, AnOptionGivenTwiceOrWithoutItsValueIsRefused) {
  const std::string scene = write_room();
  expect_refused(2, {"solve", scene, "--resolution", "64", "--resolution", "32"}, {"--resolution"});
  expect_refused(2, {"solve", scene, "--resolution"}, {"--resolution"});
  expect_refused(2, {"look", scene, "--patch", "1", "--face", "1"}, {"--patch", "--face"});
}

TEST_F(UsageTest, CommonOptionsWorkBeforeAndAfterTheCommand) {
  const std::string scene = write_room();
  const ProgramResult before =
      run(0, {"--rung", "area", "--resolution", "64", "--json", "solve", scene});
  const ProgramResult after =
      run(0, {"solve", scene, "--json", "--resolution", "64", "--rung", "area"});
  EXPECT_NE(before.out.find("\"resolution\": 64"), std::string::npos) << before.out;
  EXPECT_EQ(before.out.substr(0, before.out.find("\"run\"")),
            after.out.substr(0, after.out.find("\"run\"")));
}

TEST_F(UsageTest, UnknownInstructionSetsNameThoseThereAre) {
  const std::string scene = write_room();
  expect_refused(2, {"solve", scene, "--isa", "mmx"}, {"--isa mmx", "scalar"});
  expect_refused(2, {"solve", scene}, {"HEMICUBE_ISA=mmx", "scalar"},
                 {.environment = {{"HEMICUBE_ISA", "mmx"}}, .out_path = ""});
}

TEST_F(UsageTest, TheOptionForcesAnInstructionSetOverTheEnvironment) {
  const std::string scene = write_room();
  const std::string forced = "\"isa\": \"scalar\"";
  EXPECT_NE(run(0, {"solve", scene, "--json", "--isa", "scalar"}).out.find(forced),
            std::string::npos);
  EXPECT_NE(run(0, {"solve", scene, "--json"},
                {.environment = {{"HEMICUBE_ISA", "scalar"}}, .out_path = ""})
                .out.find(forced),
            std::string::npos);
}

TEST_F(UsageTest, AFullStdoutIsAFailure) {
  const std::string scene = write_room();
  const ProgramResult result =
      run(1, {"info", scene}, {.environment = {}, .out_path = "/dev/full"});
  EXPECT_NE(result.err.find("stdout"), std::string::npos) << result.err;
}

// Linking OpenImageIO would cost a second at every start.
TEST_F(UsageTest, OnlyPicturesLoadOpenImageIo) {
  const std::string scene = write_room();
  const ProgramSetting trace = {.environment = {{"LD_DEBUG", "files"}}, .out_path = ""};
  const std::string library = "libOpenImageIO.so";
  EXPECT_EQ(run(0, {"--help"}, trace).err.find(library), std::string::npos);
  EXPECT_EQ(run(0, {"solve", scene}, trace).err.find(library), std::string::npos);
  EXPECT_EQ(run(0, {"formfactors", scene, "-o", path("f.mtx")}, trace).err.find(library),
            std::string::npos);
  // The control: without it the lines above could never fail.
  EXPECT_NE(run(0, {"look", scene, "--patch", "0", "-o", path("l.png")}, trace).err.find(library),
            std::string::npos);
}

} // namespace
} // namespace hemicube::test
