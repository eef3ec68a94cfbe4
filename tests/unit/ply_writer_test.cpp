#include "radiosity/output/ply_writer.h"

#include "radiosity/output/tone.h"
#include "tests/unit/output_support.h"

#include <cstring>
#include <sstream>

namespace hemicube::radiosity::test {
namespace {

/// Reads back what write_ply writes, by the header's own words where it can.
struct Ply {
  explicit Ply(const std::string& bytes) : bytes_(bytes) {
    const std::size_t end = bytes.find("end_header\n");
    EXPECT_NE(end, std::string::npos);
    header = bytes.substr(0, end);
    at_ = end + 11;
    std::istringstream lines(header);
    for (std::string line; std::getline(lines, line);) {
      std::sscanf(line.c_str(), "element vertex %zu", &vertex_count);
      std::sscanf(line.c_str(), "element face %zu", &face_count);
      floats += line.starts_with("property float");
    }
    has_large_faces = header.find("list uint int") != std::string::npos;
  }

  template <typename T> T take() {
    T value{};
    EXPECT_LE(at_ + sizeof value, bytes_.size());
    if (at_ + sizeof value <= bytes_.size())
      std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  bool at_end() const { return at_ == bytes_.size(); }

  std::string header;
  std::size_t vertex_count = 0, face_count = 0, floats = 0;
  bool has_large_faces = false;

private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

struct PlyWriterTest : OutputFolder {
  std::string write(const Scene& scene, const PatchSet& patches,
                    const std::vector<float>& corner_radiosity,
                    PlyColours colours = PlyColours::kDisplay) {
    FileSet files;
    require(files.begin(folder_.string()));
    const CornerVertices vertices =
        gather_corner_vertices(patches, corner_radiosity, scene.band_count());
    require(write_ply(&files, "s.ply", scene, patches, vertices, colours, 2.0));
    require(files.commit());
    return read(path("s.ply"));
  }
};

TEST_F(PlyWriterTest, CornersOfOneValueShareAVertex) {
  SceneBuilder builder(3);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{1, 0, 0}, {2, 0, 0.25}, {1, 1, 0}});
  builder.face(grey, {{2, 0, 0.25}, {2, 2, 0}, {1, 1, 0}});
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  // The first two faces share (1,0,0) with equal light and (1,1,0) with different light;
  // the third shares both of its corners on the second.
  const std::vector<float> light = {1, 2, 3, 1, 1, 1, 4, 4, 4, 0, 0, 0, 1, 1, 1,
                                    9, 9, 9, 5, 5, 5, 9, 9, 9, 2, 2, 2, 5, 5, 5};
  const std::string bytes = write(scene, patches, light);
  Ply ply(bytes);
  EXPECT_TRUE(ply.header.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(ply.header.find("property float radiosity_g\n"), std::string::npos);
  EXPECT_NE(ply.header.find("W/m^2"), std::string::npos);
  ASSERT_EQ(ply.vertex_count, 7u);
  ASSERT_EQ(ply.face_count, 3u);
  ASSERT_EQ(ply.floats, 6u);
  const SrgbEncoder encode;
  std::vector<std::array<float, 6>> vertices(7);
  for (auto& vertex : vertices) {
    for (float& value : vertex)
      value = ply.take<float>();
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(ply.take<std::uint8_t>(), encode(2.0 * vertex[3 + k] / 3.14159265358979323846));
  }
  std::size_t corner = 0;
  for (std::int32_t face = 0; face < 3; ++face) {
    const int count = ply.take<std::uint8_t>();
    ASSERT_EQ(count, face == 0 ? 4 : 3);
    for (int k = 0; k < count; ++k, ++corner) {
      const auto vertex = static_cast<std::size_t>(ply.take<std::int32_t>());
      ASSERT_LT(vertex, 7u);
      const Vec3& p = patches.vertices[patches.corners[corner]];
      EXPECT_EQ(vertices[vertex][0], static_cast<float>(p.x));
      EXPECT_EQ(vertices[vertex][2], static_cast<float>(p.z));
      for (std::size_t band = 0; band < 3; ++band)
        EXPECT_EQ(vertices[vertex][3 + band], light[3 * corner + band]) << "corner " << corner;
    }
    EXPECT_EQ(ply.take<std::int32_t>(), face);
  }
  EXPECT_TRUE(ply.at_end());
}

// Catches: a float variant with display values, or with radiosities for radiances.
TEST_F(PlyWriterTest, FloatColoursAreRadiances) {
  SceneBuilder builder(3);
  builder.face(builder.material("grey", 0.5, 0), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Scene scene = builder.finish();
  const std::vector<float> light = {1, 2, 3, 40, 50, 60, 0, 0, 0};
  const std::string bytes = write(scene, patches_of(scene), light, PlyColours::kRadiance);
  Ply ply(bytes);
  ASSERT_EQ(ply.floats, 9u);
  EXPECT_NE(ply.header.find("property float red\nproperty float green\nproperty float blue\n"),
            std::string::npos);
  EXPECT_NE(ply.header.find("W/(m^2 sr)"), std::string::npos);
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    for (int axis = 0; axis < 3; ++axis)
      ply.take<float>();
    for (std::size_t band = 0; band < 3; ++band)
      EXPECT_EQ(ply.take<float>(), light[3 * vertex + band]);
    for (std::size_t band = 0; band < 3; ++band)
      EXPECT_FLOAT_EQ(ply.take<float>(), light[3 * vertex + band] / 3.14159265f);
  }
  EXPECT_EQ(ply.take<std::uint8_t>(), 3);
}

TEST_F(PlyWriterTest, LargeFacesGetALargeCount) {
  SceneBuilder builder(1);
  std::vector<Vec3> corners; // a convex polygon of 300 corners, on a parabola
  for (int k = 0; k < 300; ++k)
    corners.push_back({k - 150.0, (k - 150.0) * (k - 150.0) / 100, 0});
  builder.face(builder.material("grey", 0.5, 0), corners);
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  ASSERT_EQ(patches.patch_count(), 1u);
  const std::string bytes = write(scene, patches, std::vector<float>(300, 1.f));
  Ply ply(bytes);
  EXPECT_TRUE(ply.has_large_faces);
  for (std::size_t v = 0; v < 300; ++v) {
    for (int k = 0; k < 4; ++k)
      ply.take<float>();
    for (int k = 0; k < 3; ++k)
      ply.take<std::uint8_t>();
  }
  EXPECT_EQ(ply.take<std::uint32_t>(), 300u);
}

TEST_F(PlyWriterTest, BandNamesThatAreNoWordsAreNumbered) {
  SceneBuilder builder(2);
  builder.face(builder.material("grey", 0.5, 0), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Scene scene = builder.finish();
  scene.bands = NameTable{};
  require(scene.bands.add("450 nm\nproperty"));
  require(scene.bands.add("red"));
  const std::string bytes = write(scene, patches_of(scene), std::vector<float>(6, 1.f));
  const Ply ply(bytes);
  EXPECT_NE(ply.header.find("property float radiosity_0\nproperty float radiosity_1\n"),
            std::string::npos)
      << ply.header;
}

} // namespace
} // namespace hemicube::radiosity::test
