#pragma once

#include "radiosity/radiosity.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

namespace hemicube::radiosity::test {

using hemicube::test::patches_of;
using hemicube::test::require;
using hemicube::test::SceneBuilder;

/// A folder that goes away with the test.
class OutputFolder : public ::testing::Test {
protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("hemicube_" + std::string(test->test_suite_name()) + "_" + test->name() + "_" +
               std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static std::string read(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream.good()) << file;
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Names in the folder, hidden ones too.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
  }

  std::filesystem::path folder_;
};

/// Light as if solved: reflectance and exitance of the materials, irradiance(patch, band), B = E +
/// rho H.
template <typename Irradiance>
Solution solution_with(const Scene& scene, const PatchSet& patches, Irradiance&& irradiance) {
  Solution solution;
  solution.band_count = scene.band_count();
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
      const std::size_t at = patches.material[patch] * std::size_t{scene.band_count()} + band;
      const double rho = scene.reflectance[at], e = scene.exitance[at];
      const double h = irradiance(patch, band);
      require(solution.reflectance.push_back(rho));
      require(solution.exitance.push_back(e));
      require(solution.irradiance.push_back(h));
      require(solution.radiosity.push_back(rho == 0 ? e : e + rho * h));
    }
  return solution;
}

} // namespace hemicube::radiosity::test
