#include "radiosity/output/solution_files.h"

#include "radiosity/output/camera_view.h"
#include "radiosity/output/image_writer.h"
#include "tests/unit/output_support.h"

#include <nlohmann/json.hpp>

namespace hemicube::radiosity::test {
namespace {

struct SolutionFilesTest : OutputFolder {
  SolutionFilesTest() : scene(hemicube::test::cornell_like(8)), patches(patches_of(scene)) {
    solution = solution_with(scene, patches, [&](std::uint32_t patch, std::uint32_t band) {
      return 1 + patches.centre[patch].y + 0.3 * band;
    });
    certificate.solved = true;
  }

  Status write(const std::string& folder, const Camera& camera) {
    FileSet files;
    HC_TRY(files.begin(folder));
    const SolutionParts parts{
        patches, solution, {scene, options, certificate, mesh, skipped, run, "1.0"},
        camera,  0,        raster::best_kernels()};
    return write_solution(&files, parts, &report, &picture_note);
  }

  Scene scene;
  PatchSet patches;
  Solution solution;
  Options options;
  Certificate certificate;
  MeshReport mesh;
  std::map<std::string, std::uint64_t> skipped;
  RunReport run;
  std::string report, picture_note;
};

TEST_F(SolutionFilesTest, WritesAllFilesAndTheSameBytesTwice) {
  const Camera camera = fit_camera(patches, 60, 40);
  require(write(path("one"), camera));
  require(write(path("two"), camera));
  EXPECT_EQ(picture_note, "") << "the plug-in stands beside the test program";
  for (const char* name : {"patches.csv", "groups.csv", "solution.ply", "solution_float.ply",
                           "solution.glb", "view.exr", "view.png"}) {
    const std::string bytes = read(path("one") + "/" + name);
    EXPECT_GT(bytes.size(), 50u) << name;
    EXPECT_EQ(bytes, read(path("two") + "/" + name)) << name;
  }
  EXPECT_EQ(read(path("two") + "/report.json"), report);
  EXPECT_GT(nlohmann::json::parse(report)["run"]["seconds"]["write"].get<double>(), 0);
}

TEST_F(SolutionFilesTest, ABadCameraLeavesNothing) {
  Camera camera;
  camera.target = camera.position;
  EXPECT_EQ(write(path("bad"), camera).code(), StatusCode::kInvalidArgument);
  EXPECT_FALSE(std::filesystem::exists(path("bad")));
}

TEST(ImageKinds, AreKnownByTheirExtension) {
  EXPECT_EQ(image_kind("a/b.EXR").value(), ImageKind::kLinear);
  EXPECT_EQ(image_kind("view.png").value(), ImageKind::kDisplay);
  for (const char* name : {"view.xyz", "view", "dir.png/view"}) {
    const auto kind = image_kind(name);
    EXPECT_EQ(kind.status().code(), StatusCode::kInvalidArgument) << name;
  }
  EXPECT_TRUE(image_kind("view.xyz").status().message().starts_with("view.xyz: '.xyz'"));
}

TEST(ImagePlugin, AMissingOneSaysWhereItWasSearched) {
  const Status status = load_image_plugin_from({"/nowhere/p.so", "/etc/passwd"});
  EXPECT_EQ(status.code(), StatusCode::kIo);
  EXPECT_NE(status.message().find("searched: /nowhere/p.so, /etc/passwd ("), std::string::npos)
      << status.message();
}

} // namespace
} // namespace hemicube::radiosity::test
