#pragma once

#include "radiosity/scene/read_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
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

inline void expect_unique(const NameTable& table) {
  const std::vector<std::string> names = names_of(table);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

/// All that the comment in scene.h promises.
inline void expect_scene_is_sound(const Scene& scene) {
  const std::size_t bands = scene.band_count(), materials = scene.materials.size();
  const std::size_t faces = scene.face_count();
  ASSERT_GE(bands, 1u);
  ASSERT_GE(faces, 1u);
  expect_unique(scene.bands);
  expect_unique(scene.materials);
  expect_unique(scene.groups);
  ASSERT_EQ(scene.reflectance.size(), materials * bands);
  ASSERT_EQ(scene.exitance.size(), materials * bands);
  ASSERT_EQ(scene.two_sided.size(), materials);
  ASSERT_EQ(scene.space_exitance.size(), bands);
  for (const double rho : scene.reflectance)
    EXPECT_TRUE(rho >= 0 && rho <= 1) << rho;
  for (const double e : scene.exitance)
    EXPECT_TRUE(e >= 0 && std::isfinite(e)) << e;
  for (const double e : scene.space_exitance)
    EXPECT_TRUE(e >= 0 && std::isfinite(e)) << e;
  for (const std::uint8_t two_sided : scene.two_sided)
    EXPECT_LE(two_sided, 1);
  for (const Vec3& v : scene.vertices)
    EXPECT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
  EXPECT_EQ(scene.corner_offsets[0], 0u);
  EXPECT_EQ(scene.corner_offsets[faces], scene.corners.size());
  for (std::size_t f = 0; f < faces; ++f)
    EXPECT_GE(scene.corner_offsets[f + 1], scene.corner_offsets[f] + 3);
  for (const std::uint32_t corner : scene.corners)
    EXPECT_LT(corner, scene.vertices.size());
  ASSERT_EQ(scene.face_material.size(), faces);
  ASSERT_EQ(scene.face_group.size(), faces);
  std::set<std::uint32_t> used;
  for (const std::uint32_t material : scene.face_material)
    used.insert(material);
  EXPECT_EQ(used.size(), materials) << "a material that no face uses";
  EXPECT_LT(*used.rbegin(), materials);
  for (const std::uint32_t group : scene.face_group)
    EXPECT_LT(group, scene.groups.size());
  ASSERT_TRUE(scene.face_max_edge.empty() || scene.face_max_edge.size() == faces);
  for (const double edge : scene.face_max_edge)
    EXPECT_TRUE(edge >= 0 && std::isfinite(edge));
}

} // namespace hemicube::radiosity::test
