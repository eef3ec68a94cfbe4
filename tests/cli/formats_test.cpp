// The same room in every format that scenes are read from.

#include "tests/cli/cli_case.h"
#include "tests/support/gltf_files.h"

namespace hemicube::test {
namespace {

using radiosity::test::bytes_of;
using radiosity::test::glb;
using Json = radiosity::test::Json;

/// The inside of a cube in triangles; the first two are the lamp, the others white. Coordinates are
/// floats.
constexpr float kCorners[8][3] = {{0, 0, 0}, {1.5f, 0, 0}, {1.5f, 1, 0}, {0, 1, 0},
                                  {0, 0, 2}, {1.5f, 0, 2}, {1.5f, 1, 2}, {0, 1, 2}};
constexpr int kTriangles[12][3] = {{4, 7, 6}, {4, 6, 5}, {0, 1, 2}, {0, 2, 3},
                                   {0, 3, 7}, {0, 7, 4}, {1, 5, 6}, {1, 6, 2},
                                   {0, 4, 5}, {0, 5, 1}, {3, 2, 6}, {3, 6, 7}};

class FormatsTest : public CliCase {
protected:
  std::string write_obj() {
    write("room.mtl", "newmtl lamp\nKd 0.25\nKe 10 5 2.5\nnewmtl white\nKd 0.5 0.75 0.5\n");
    std::string text = "mtllib room.mtl\n";
    for (const auto& v : kCorners)
      text += "v " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " +
              std::to_string(v[2]) + "\n";
    for (int i = 0; i < 12; ++i)
      text += std::string(i == 0   ? "usemtl lamp\n"
                          : i == 2 ? "usemtl white\n"
                                   : "") +
              "f " + std::to_string(kTriangles[i][0] + 1) + " " +
              std::to_string(kTriangles[i][1] + 1) + " " + std::to_string(kTriangles[i][2] + 1) +
              "\n";
    return write("room.obj", text);
  }

  /// Triangles first..last of the room as a file of one of the grey formats.
  void write_mesh(const std::string& name, int first, int last) {
    std::string bytes;
    if (name.ends_with(".stl")) {
      bytes = std::string(80, ' ') + bytes_of(static_cast<std::uint32_t>(last - first));
      for (int i = first; i < last; ++i) {
        bytes += std::string(12, '\0');
        for (const int corner : kTriangles[i])
          bytes += bytes_of({kCorners[corner][0], kCorners[corner][1], kCorners[corner][2]});
        bytes += "ab";
      }
    } else if (name.ends_with(".ply")) {
      bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\n"
              "property float y\nproperty float z\nelement face " +
              std::to_string(last - first) +
              "\nproperty list uchar int vertex_indices\nend_header\n";
      for (const auto& v : kCorners)
        bytes += bytes_of({v[0], v[1], v[2]});
      for (int i = first; i < last; ++i)
        bytes += "\3" + bytes_of({kTriangles[i][0], kTriangles[i][1], kTriangles[i][2]});
    } else {
      bytes = "OFF\n8 " + std::to_string(last - first) + " 0\n";
      for (const auto& v : kCorners)
        bytes +=
            std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
      for (int i = first; i < last; ++i)
        bytes += "3 " + std::to_string(kTriangles[i][0]) + " " + std::to_string(kTriangles[i][1]) +
                 " " + std::to_string(kTriangles[i][2]) + "\n";
    }
    write(name, bytes);
  }

  /// A scene file of two meshes.
  std::string write_scene(const std::string& extension) {
    write_mesh("lamp" + extension, 0, 2);
    write_mesh("walls" + extension, 2, 12);
    Json scene = {{"format", "hemicube-scene"}, {"version", 1}};
    scene["materials"]["lamp"] = {{"reflectance", 0.25}, {"exitance", {10, 5, 2.5}}};
    scene["materials"]["white"] = {{"reflectance", {0.5, 0.75, 0.5}}};
    scene["meshes"] = {{{"file", "lamp" + extension}, {"material", "lamp"}},
                       {{"file", "walls" + extension}, {"material", "white"}}};
    return write("room" + extension + ".json", scene.dump());
  }

  std::string write_glb() {
    std::string bytes;
    for (const auto& v : kCorners)
      bytes += bytes_of({v[0], v[1], v[2]});
    for (const auto& triangle : kTriangles)
      for (const int corner : triangle)
        bytes += static_cast<char>(corner);
    Json scene = Json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}],
      "materials": [
        {"name": "lamp", "emissiveFactor": [1, 0.5, 0.25],
         "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.25, 0.25, 1]},
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10}}},
        {"name": "white", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.75, 0.5, 1]}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
                                 {"attributes": {"POSITION": 0}, "indices": 2, "material": 1}]}],
      "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"},
        {"bufferView": 1, "byteOffset": 6, "componentType": 5121, "count": 30, "type": "SCALAR"}],
      "bufferViews": [{"buffer": 0, "byteLength": 96},
                      {"buffer": 0, "byteOffset": 96, "byteLength": 36}],
      "buffers": [{"byteLength": 132}]})");
    return write("room.glb", glb(scene, bytes));
  }

  /// What the report says of the light.
  Json solved(const std::string& scene) {
    const std::string report =
        run(0, {"solve", scene, "--json", "--rung", "hemicube", "--resolution", "32"}).out;
    const Json result = Json::parse(report)["result"];
    return {result["patches"], result["hashes"]["form_factors"], result["hashes"]["radiosity"],
            result["bands"], result["energy"]};
  }
};

// Catches: a reader that moves a corner, turns a face round, or loses a material on the way.
TEST_F(FormatsTest, TheSameRoomHasTheSameLightInEveryFormat) {
  const Json expected = solved(write_obj());
  EXPECT_EQ(expected[0], 12);
  EXPECT_EQ(expected[4]["emitted"], (Json{15, 7.5, 3.75}));
  EXPECT_EQ(solved(write_glb()), expected);
  for (const char* extension : {".ply", ".off", ".stl"})
    EXPECT_EQ(solved(write_scene(extension)), expected) << extension;
}

TEST_F(FormatsTest, GreyMeshesAreSolvedAsTheyAre) {
  for (const std::string name : {"grey.ply", "grey.off", "grey.STL"}) {
    write_mesh(name == "grey.STL" ? "grey.stl" : name, 0, 12);
    if (name == "grey.STL")
      write("grey.STL", read("grey.stl"));
    const ProgramResult info = run(0, {"info", path(name)});
    EXPECT_NE(info.out.find("12 faces without a material: grey, reflectance 0.5"),
              std::string::npos)
        << info.out;
  }
}

TEST_F(FormatsTest, DamagedFilesEndInExit3) {
  write_mesh("cut.ply", 0, 12);
  write("cut.ply", read("cut.ply").substr(0, 300));
  expect_refused(3, {"solve", path("cut.ply"), "-o", path("out")},
                 {path("cut.ply") + ": the header says 12 x 'face', but the file ends after "});
  write_glb();
  write("cut.glb", read("room.glb").substr(0, 700));
  expect_refused(3, {"solve", path("cut.glb"), "-o", path("out")},
                 {path("cut.glb") + ": the header says ", " bytes, but the file has 700"});
}

TEST_F(FormatsTest, HelpAndMessagesListAllFormats) {
  const std::string help = run(0, {"solve", "--help"}).out;
  const ProgramResult refused = run(3, {"solve", write("room.xyz", "")});
  for (const char* extension : {".json", ".gltf", ".glb", ".obj", ".ply", ".off", ".stl"}) {
    EXPECT_NE(help.find(extension), std::string::npos) << extension;
    EXPECT_NE(refused.err.find(extension), std::string::npos) << extension;
  }
}

} // namespace
} // namespace hemicube::test
