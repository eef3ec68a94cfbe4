// Mesh files of all formats, cut anywhere: a clear error or a sound scene.

#include "tests/support/file_bytes.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

const std::string kPlyHeader = "element vertex 4\nproperty float x\nproperty float y\n"
                               "property float z\nproperty uchar red\nelement face 2\n"
                               "property list uchar int vertex_indices\nend_header\n";

struct MeshFile {
  std::string name;
  std::string bytes;
  /// Whether each shorter file must be refused, not just read soundly.
  bool all_is_needed;
};

std::string binary_ply(std::endian order) {
  std::string bytes = "ply\nformat binary_" +
                      std::string(order == std::endian::little ? "little" : "big") +
                      "_endian 1.0\n" + kPlyHeader;
  for (const float x : {0.f, 1.f, 0.5f, 2.f}) {
    bytes += bytes_of(x, order) + bytes_of(x * x, order) + bytes_of(1 - x, order) + "r";
  }
  for (const std::int32_t first : {0, 1}) {
    bytes += '\3';
    for (std::int32_t k = 0; k < 3; ++k)
      bytes += bytes_of(first + k, order);
  }
  return bytes;
}

std::vector<MeshFile> mesh_files() {
  std::string stl = std::string(80, 'x') + bytes_of(std::uint32_t{2});
  for (int k = 0; k < 2; ++k)
    stl += bytes_of({0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) + "ab";
  return {{"a.ply",
           "ply\nformat ascii 1.0\n" + kPlyHeader +
               "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1.5 1e-3 255\n3 0 1 2\n4 0 1 2 3\n",
           false},
          {"b.ply", binary_ply(std::endian::little), true},
          {"c.ply", binary_ply(std::endian::big), true},
          {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 0 # x\n1 1 0\n0 1.5 1e-3\n3 0 1 2 255 0 0\n4 0 1 2 3\n",
           false},
          {"a.stl",
           "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 0 1 1e-3\nendloop\nendfacet\nendsolid a b\n",
           false},
          {"b.stl", stl, true}};
}

class CutMeshFiles : public SceneFiles {
protected:
  /// Reads a file, which must be refused by its own name or give a sound scene.
  /// @return whether it was refused
  bool refused_or_sound(const std::string& name, const std::string& bytes) {
    SCOPED_TRACE(name + ": " + bytes);
    write(name, bytes);
    const Status status = read(name);
    if (status.ok()) {
      expect_scene_is_sound(scene_);
      return false;
    }
    EXPECT_EQ(status.code(), StatusCode::kBadScene);
    EXPECT_TRUE(status.message().starts_with(path(name) + ":")) << status.message();
    return true;
  }
};

TEST_F(CutMeshFiles, AreRefusedOrSound) {
  for (const MeshFile& file : mesh_files()) {
    EXPECT_FALSE(refused_or_sound(file.name, file.bytes));
    for (std::size_t size = 0; size < file.bytes.size() && !HasFailure(); ++size) {
      const bool refused = refused_or_sound(file.name, file.bytes.substr(0, size));
      EXPECT_TRUE(refused || !file.all_is_needed) << file.name << ", " << size << " bytes";
    }
  }
}

} // namespace
} // namespace hemicube::radiosity::test
