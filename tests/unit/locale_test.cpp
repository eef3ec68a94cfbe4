// A program that embeds the library may have set a locale whose decimal point is a comma.

#include "radiosity/output/camera_view.h"
#include "radiosity/output/solution_files.h"
#include "radiosity/scene/read_scene.h"
#include "tests/unit/output_support.h"

#include <clocale>
#include <cstdlib>
#include <locale>

namespace hemicube::radiosity::test {
namespace {

class CommaPoint : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

struct LocaleTest : OutputFolder {
  void TearDown() override {
    std::locale::global(std::locale::classic()); // sets that of C as well
    ::unsetenv("LOCPATH");
    OutputFolder::TearDown();
  }

  /// That of German as the system has it, or as it is made here.
  bool enter_german() const {
    const auto enter = [] {
      return std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr &&
             std::string(std::localeconv()->decimal_point) == ",";
    };
    if (enter())
      return true;
    const std::string command =
        "localedef -i de_DE -f UTF-8 '" + path("de_DE.UTF-8") + "' >/dev/null 2>&1";
    ::setenv("LOCPATH", folder_.c_str(), 1);
    return std::system(command.c_str()) == 0 && enter();
  }

  /// Reads a scene and writes all files of a solution into a folder.
  void read_and_write(const std::string& folder) {
    Scene scene;
    ReadReport read;
    require(read_scene(HC_SOURCE_DIR "/scenes/table.json", &scene, &read));
    const PatchSet patches = patches_of(scene);
    const Solution solution =
        solution_with(scene, patches, [&](std::uint32_t patch, std::uint32_t) {
          return 1000.5 + patches.centre[patch].x;
        });
    const Options options;
    const Certificate certificate;
    const MeshReport mesh;
    const RunReport run;
    FileSet files;
    require(files.begin(path(folder)));
    std::string report, note;
    const ReportParts parts{scene, options, certificate, mesh, read.skipped, run, "1.0"};
    require(write_solution(
        &files, {patches, solution, parts, fit_camera(patches, 32, 32), 0, raster::best_kernels()},
        &report, &note));
    EXPECT_EQ(note, "");
  }

  void expect_the_same_files(const std::string& folder) {
    for (const char* name : {"patches.csv", "groups.csv", "solution.ply", "solution_float.ply",
                             "solution.glb", "view.png", "view.exr"})
      EXPECT_TRUE(read(path("plain") + "/" + name) == read(path(folder) + "/" + name)) << name;
    const std::string report = read(path(folder) + "/report.json");
    EXPECT_NE(report.find("\"write\": 0."), std::string::npos) << report;
  }
};

TEST_F(LocaleTest, StreamsWithACommaChangeNothing) {
  read_and_write("plain");
  std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  read_and_write("comma");
  expect_the_same_files("comma");
}

TEST_F(LocaleTest, GermanChangesNothing) {
  read_and_write("plain");
  if (!enter_german())
    GTEST_SKIP() << "no German locale, and no package 'locales' to make one of";
  std::locale::global(std::locale("de_DE.UTF-8"));
  read_and_write("german");
  expect_the_same_files("german");
}

} // namespace
} // namespace hemicube::radiosity::test
