#pragma once

#include "radiosity/scene/read_scene.h"
#include "tests/support/scene_checks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace hemicube::radiosity::test {

/// A folder of small scene files that goes away with the test.
class SceneFiles : public ::testing::Test {
protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("hemicube_" + std::string(test->name()) + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }

  Status read(const std::string& name) { return read_scene(path(name), &scene_, &report_); }

  void expect_read(const std::string& name) {
    const Status status = read(name);
    ASSERT_TRUE(status.ok()) << status.message();
  }

  /// The file must be refused with a message that starts with "FOLDER/START".
  void expect_refused(const std::string& name, const std::string& start) {
    const Status status = read(name);
    EXPECT_EQ(status.code(), StatusCode::kBadScene) << status.message();
    EXPECT_TRUE(status.message().starts_with(path(start)))
        << "expected " << path(start) << "\nactual   " << status.message();
  }

  std::filesystem::path folder_;
  Scene scene_;
  ReadReport report_;
};

inline std::vector<std::string> names_of(const NameTable& table) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < table.size(); ++i)
    names.emplace_back(table[i]);
  return names;
}

template <typename T> std::vector<T> values_of(const Buffer<T>& buffer) {
  return {buffer.begin(), buffer.end()};
}

/// All that the comment in scene.h promises.
inline void expect_scene_is_sound(const Scene& scene) {
  EXPECT_EQ(hemicube::test::scene_problem(scene), "");
}

} // namespace hemicube::radiosity::test
