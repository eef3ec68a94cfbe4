// A second opinion on files that OpenMesh reads right: closed meshes, no comments, no colours.

#include "tests/support/file_bytes.h"
#include "tests/support/scene_files.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <random>

namespace hemicube::radiosity::test {
namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<>;

class OpenMeshReadsTheSame : public SceneFiles {
protected:
  /// A box of quads with one wall cut into triangles, its corners moved at random.
  Mesh box() {
    std::mt19937 random(7);
    Mesh mesh;
    std::vector<Mesh::VertexHandle> v;
    for (int k = 0; k < 8; ++k) {
      const auto moved = [&](int bit) {
        return static_cast<float>((k >> bit & 1) + 1e-4 * static_cast<double>(random() % 1000));
      };
      const float x = moved(0), y = moved(1), z = moved(2);
      v.push_back(mesh.add_vertex({x, y, z}));
    }
    for (const std::vector<int>& face : std::vector<std::vector<int>>{{0, 1, 3, 2},
                                                                      {4, 6, 7, 5},
                                                                      {0, 4, 5, 1},
                                                                      {2, 3, 7, 6},
                                                                      {0, 2, 6, 4},
                                                                      {1, 5, 7},
                                                                      {1, 7, 3}}) {
      std::vector<Mesh::VertexHandle> corners;
      for (const int corner : face)
        corners.push_back(v[static_cast<std::size_t>(corner)]);
      mesh.add_face(corners);
    }
    return mesh;
  }

  /// Writes the mesh, has both read it, and compares the places of all corners of all faces.
  void expect_the_same(Mesh mesh, const std::string& name, OpenMesh::IO::Options options) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path(name), options, 9));
    Mesh theirs;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(theirs, path(name)));
    expect_read(name);
    if (HasFatalFailure())
      return;
    ASSERT_EQ(scene_.face_count(), theirs.n_faces());
    std::size_t at = 0;
    for (const auto face : theirs.faces()) {
      ASSERT_EQ(scene_.corner_offsets[static_cast<std::size_t>(face.idx())], at);
      // Their first corner need not be that of the file.
      std::vector<Vec3> corners;
      for (const auto vertex : face.vertices()) {
        const auto p = theirs.point(vertex);
        corners.emplace_back(p[0], p[1], p[2]);
      }
      bool found = false;
      for (std::size_t turn = 0; turn < corners.size() && !found; ++turn) {
        found = true;
        for (std::size_t k = 0; k < corners.size(); ++k) {
          // Text has nine digits, which they round to float.
          const Vec3 ours = scene_.vertices[scene_.corners[at + k]];
          const Vec3 rounded(static_cast<float>(ours.x), static_cast<float>(ours.y),
                             static_cast<float>(ours.z));
          found = found && rounded == corners[(k + turn) % corners.size()];
        }
      }
      EXPECT_TRUE(found) << "face " << face.idx();
      at += corners.size();
    }
    EXPECT_EQ(scene_.corners.size(), at);
  }
};

TEST_F(OpenMeshReadsTheSame, AllFormats) {
  using OpenMesh::IO::Options;
  omlog().disable();
  const Mesh mesh = box();
  expect_the_same(mesh, "a.ply", Options::Default);
  expect_the_same(mesh, "b.ply", Options::Binary);
  expect_the_same(mesh, "c.ply", Options::Binary | Options::MSB);
  expect_the_same(mesh, "a.off", Options::Default);
  Mesh triangles = mesh;
  triangles.triangulate();
  expect_the_same(triangles, "a.stl", Options::Default);
  expect_the_same(triangles, "b.stl", Options::Binary);
}

} // namespace
} // namespace hemicube::radiosity::test
