#include "radiosity/scene/json_reader.h"

#include "tests/support/scene_files.h"

#include <bit>
#include <clocale>

namespace hemicube::radiosity::test {
namespace {

/// A scene file of one mesh; the members of the top object and of the mesh go where they say.
std::string scene_with(const std::string& members, const std::string& mesh_members = "") {
  return "{\"format\": \"hemicube-scene\", \"version\": 1,\n" + // line 1
         (members.empty() ? "" : members + ",\n") +             // line 2 on
         "\"meshes\": [{\"file\": \"a.obj\"" + (mesh_members.empty() ? "" : ",\n" + mesh_members) +
         "}]}\n";
}

const std::string kRed = R"("materials": {"red": {"reflectance": 0.5}})";

class JsonReader : public SceneFiles {
protected:
  void SetUp() override {
    SceneFiles::SetUp();
    write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0.1 0.1 0.1\n"
                   "g one\nusemtl red\nf 1 2 3\ng two\nusemtl blue\nf 3 2 1 4\n");
    write("a.mtl", "newmtl blue\nKd 0.25\nnewmtl red\nKd 0.1 0.2 0.3\nKe 1 2 3\n");
  }

  void expect_scene(const std::string& json) {
    SCOPED_TRACE(json);
    write("s.json", json);
    expect_read("s.json");
    if (!HasFatalFailure())
      expect_scene_is_sound(scene_);
  }

  void expect_error(const std::string& json, int line, const std::string& why) {
    SCOPED_TRACE(json);
    write("s.json", json);
    expect_refused("s.json", "s.json:" + std::to_string(line) + ": ");
    EXPECT_NE(std::string(read("s.json").message()).find(why), std::string::npos)
        << read("s.json").message();
  }
};

TEST_F(JsonReader, MinimalSceneTakesAllFromTheObj) {
  expect_scene(scene_with(""));
  EXPECT_EQ(names_of(scene_.bands), (std::vector<std::string>{"r", "g", "b"}));
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.1, 0.2, 0.3, 0.25, 0.25, 0.25}));
  EXPECT_EQ(values_of(scene_.exitance), (std::vector<double>{1, 2, 3, 0, 0, 0}));
  EXPECT_EQ(scene_.vertices[3], Vec3(0.1, 0.1, 0.1));
  EXPECT_TRUE(scene_.face_max_edge.empty());
  EXPECT_FALSE(scene_.has_camera);
  EXPECT_EQ(report_.files,
            (std::vector<std::string>{path("s.json"), path("a.obj"), path("a.mtl")}));
}

TEST_F(JsonReader, MaterialsOfTheSceneGoBeforeThoseOfTheLibrary) {
  expect_scene(
      scene_with(R"("materials": {"red": {"reflectance": [0.5, 0.6, 0.7], "two_sided": true},
    "unused": {"exitance": 3}, "blue": {"radiance": [1, 2, 0]}})"));
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.5, 0.6, 0.7, 0, 0, 0}));
  EXPECT_EQ(values_of(scene_.exitance),
            (std::vector<double>{0, 0, 0, 3.141592653589793, 6.283185307179586, 0}));
  EXPECT_EQ(values_of(scene_.two_sided), (std::vector<std::uint8_t>{1, 0}));
  // No name needed the library, so it was not read: it may be missing.
  EXPECT_EQ(report_.files, (std::vector<std::string>{path("s.json"), path("a.obj")}));
  std::filesystem::remove(path("a.mtl"));
  expect_scene(scene_with(R"("materials": {"red": {"reflectance": 1}, "blue": {"exitance": 1}})"));
  write("s.json", scene_with(kRed));
  expect_refused("s.json", "a.obj:1: material library 'a.mtl' does not exist");
}

TEST_F(JsonReader, NamedBands) {
  const std::string bands = R"("bands": ["uv", "heat"])";
  expect_scene(scene_with(bands + R"(, "space_exitance": [1, 2],
    "materials": {"red": {"reflectance": [0.5, 1]}, "blue": {"exitance": 7}})"));
  EXPECT_EQ(names_of(scene_.bands), (std::vector<std::string>{"uv", "heat"}));
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.5, 1, 0, 0}));
  EXPECT_EQ(values_of(scene_.exitance), (std::vector<double>{0, 0, 7, 7}));
  EXPECT_EQ(values_of(scene_.space_exitance), (std::vector<double>{1, 2}));
  // The library speaks of r, g, b only.
  write("s.json", scene_with(bands + ", " + kRed));
  expect_refused("s.json", "a.obj:10: material 'blue' is used by a face, but is not among the mat");
  expect_scene(scene_with(R"("bands": ["r", "g", "b"])")); // the default, said aloud
  expect_error(scene_with("\"bands\":\n[]"), 2, "at least one band");
  expect_error(scene_with("\"bands\": [\"a\",\n\"b\",\n\"a\"]"), 4, "band 'a' is named twice");
  std::string many = "\"0\"";
  for (int i = 1; i <= 1024; ++i)
    many += ", \"" + std::to_string(i) + "\"";
  expect_error(scene_with("\"bands\": [" + many + "]"), 2, "more than 1024 bands");
  expect_error(scene_with("\"bands\": [\"\"]"), 2, "a band's name must not be empty");
  expect_error(scene_with("\"bands\": [1]"), 2, "a band's name must be a text, not a number");
  expect_error(scene_with("\"bands\": \"r\""), 2, "bands must be an array, not a text");
}

TEST_F(JsonReader, UnitsScaleCoordinatesAndTheCamera) {
  const std::string camera = R"(, "camera": {"position": [0, 0, 50], "target": [100, 0, 0],
    "up": [0, 0, 2], "vertical_field_of_view": 60.5, "width": 64, "height": 32})";
  const std::pair<std::string, double> cases[] = {
      {"\"m\"", 1}, {"\"cm\"", 0.01}, {"\"mm\"", 0.001}, {"0.3048", 0.3048}, {"2", 2}};
  for (const auto& [units, metres] : cases) {
    expect_scene(scene_with("\"units\": " + units + camera));
    EXPECT_EQ(scene_.vertices[2], Vec3(0, 2 * metres, 0));
    EXPECT_EQ(scene_.vertices[3].x, 0.1 * metres);
    EXPECT_EQ(scene_.camera.position, Vec3(0, 0, 50 * metres));
    EXPECT_EQ(scene_.camera.target, Vec3(100 * metres, 0, 0));
  }
  EXPECT_TRUE(scene_.has_camera);
  EXPECT_EQ(scene_.camera.up, Vec3(0, 0, 2));
  EXPECT_EQ(scene_.camera.vertical_field_of_view, 60.5);
  EXPECT_EQ(scene_.camera.width, 64u);
  EXPECT_EQ(scene_.camera.height, 32u);
  expect_error(scene_with("\n\"units\": \"ft\""), 3, "units 'ft' are not known");
  expect_error(scene_with("\"units\": 0"), 2, "must be greater than 0, not 0");
  expect_error(scene_with("\"units\": -1"), 2, "must be greater than 0, not -1");
  expect_error(scene_with("\"units\": null"), 2, "must be a number, not null");
}

TEST_F(JsonReader, SeveralMeshesShareNames) {
  write("b.obj", "v 9 9 9\nv 8 9 9\nv 9 8 9\nusemtl red\nf 1 2 3\ng two\nf 3 2 1\n");
  expect_scene(R"({"format": "hemicube-scene", "version": 1, "max_edge": 0.5,
    "materials": {"red": {"reflectance": 0.5}, "white": {"reflectance": 1}},
    "meshes": [{"file": "a.obj", "max_edge": 0.25}, {"file": "b.obj"},
               {"file": "b.obj", "material": "white"}]})");
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red", "blue", "white"}));
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"one", "two", ""}));
  EXPECT_EQ(values_of(scene_.face_material), (std::vector<std::uint32_t>{0, 1, 0, 0, 2, 2}));
  EXPECT_EQ(values_of(scene_.face_group), (std::vector<std::uint32_t>{0, 1, 2, 1, 2, 1}));
  EXPECT_EQ(values_of(scene_.corner_offsets),
            (std::vector<std::uint64_t>{0, 3, 7, 10, 13, 16, 19}));
  EXPECT_EQ(values_of(scene_.corners),
            (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0, 3, 4, 5, 6, 6, 5, 4, 7, 8, 9, 9, 8, 7}));
  EXPECT_EQ(values_of(scene_.face_max_edge), (std::vector<double>{0.25, 0.25, 0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(report_.files.size(), 4u);
  // Only a later mesh is subdivided.
  expect_scene(R"({"format": "hemicube-scene", "version": 1, "materials": {"red": {"exitance": 1}},
    "meshes": [{"file": "a.obj"}, {"file": "b.obj", "max_edge": 2}, {"file": "b.obj"}]})");
  EXPECT_EQ(values_of(scene_.face_max_edge), (std::vector<double>{0, 0, 2, 2, 0, 0}));
}

TEST_F(JsonReader, MaterialOfAMeshReplacesItsOwn) {
  std::filesystem::remove(path("a.mtl"));
  expect_scene(scene_with(kRed, R"("material": "red")"));
  EXPECT_EQ(names_of(scene_.materials), std::vector<std::string>{"red"});
  EXPECT_EQ(values_of(scene_.face_material), (std::vector<std::uint32_t>{0, 0}));
  expect_error(scene_with(kRed, "\n\"material\": \"blue\""), 5,
               "mesh 0: material 'blue' is not among the materials of this file");
}

TEST_F(JsonReader, FacesWithoutMaterialAreGrey) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_scene(scene_with(R"("bands": ["x", "y"])"));
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(report_.faces_without_material, 1u);
  expect_scene(scene_with(kRed, R"("material": "red")"));
  EXPECT_EQ(report_.faces_without_material, 0u);
}

TEST_F(JsonReader, LibrariesOfSeveralMeshesMustAgree) {
  std::filesystem::create_directory(path("sub"));
  write("sub/b.obj",
        "mtllib b.mtl\nmtllib ../a.mtl\nv 9 9 9\nv 8 9 9\nv 9 8 9\nusemtl red\nf 1 2 3\n");
  write("sub/b.mtl", "newmtl green\nKd 0.5\n");
  const std::string both = R"({"format": "hemicube-scene", "version": 1,
    "meshes": [{"file": "a.obj"}, {"file": "sub/b.obj"}]})";
  expect_scene(both); // the same definition twice is one material
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red", "blue"}));
  write("sub/b.obj", "mtllib b.mtl\nv 9 9 9\nv 8 9 9\nv 9 8 9\nusemtl red\nf 1 2 3\n");
  write("s.json", both);
  expect_refused("s.json", "sub/b.obj:5: material 'red' is used"); // not found in a.obj's library
  write("sub/b.mtl", "newmtl green\nKd 0.5\n\nnewmtl red\nKd 0.5\n");
  expect_refused("s.json",
                 "sub/b.mtl:4: material 'red' is defined twice, first at " + path("a.mtl") + ":3");
}

TEST_F(JsonReader, TransformIsRowMajor) {
  expect_scene(scene_with("\"units\": 2",
                          R"("transform": [0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 3, 30, 0, 0, 0, 1])"));
  EXPECT_EQ(scene_.vertices[1], Vec3(20, 42, 60)); // (1, 0, 0) -> (10, 21, 30), in units of 2 m
  EXPECT_EQ(scene_.vertices[2], Vec3(16, 40, 60));
  EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0, 3}));
}

TEST_F(JsonReader, MirroringKeepsFrontsInFront) {
  expect_scene(scene_with("", R"("transform": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])"));
  EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 2, 1, 2, 3, 0, 1}));
  const auto& v = scene_.vertices;
  const auto& c = scene_.corners;
  EXPECT_GT(glm::cross(v[c[1]] - v[c[0]], v[c[2]] - v[c[0]]).z, 0);
}

TEST_F(JsonReader, RefusesBadTransforms) {
  const auto expect_bad = [&](const std::string& matrix, const std::string& why) {
    expect_error(scene_with("", "\n\"transform\": [" + matrix + "]"), 4, why);
  };
  expect_bad("1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1", "transform is singular");
  expect_bad("1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1", "transform is singular");
  expect_bad("0.1, 0.2, 0.3, 0, 0.4, 0.5, 0.6, 0, 0.7, 0.8, 0.9, 0, 0, 0, 0, 1", "singular");
  expect_bad("1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2", "must end in the row 0 0 0 1");
  expect_bad("1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1", "must end in the row 0 0 0 1");
  expect_bad("1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0", "must have 16 numbers, not 12");
  expect_bad("1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, true", "must be a number, not true");
  expect_error(scene_with("\"units\": 1e300", "\"transform\": [1e10, 0, 0, 0, 0, 1, 0, 0, 0, 0, "
                                              "1, 0, 0, 0, 0, 1]"),
               3, "mesh 0: transform and units make a coordinate too large");
  // Small, but not flat; squares of its elements underflow.
  expect_scene(scene_with("", "\"transform\": [1e-200, 0, 0, 0, 0, 1e-200, 0, 0, 0, 0, 1e-200, 0, "
                              "0, 0, 0, 1]"));
}

TEST_F(JsonReader, RefusesBadMaterials) {
  const auto expect_bad = [&](const std::string& red, int line, const std::string& why) {
    expect_error(scene_with("\"materials\":\n{\"red\": " + red + "}"), line, why);
  };
  expect_bad("{\"reflectance\": 1.2}", 3, "material 'red': reflectance 1.2 is outside [0, 1]");
  expect_bad("{\"reflectance\": -1}", 3, "material 'red': reflectance -1 is outside [0, 1]");
  expect_bad("{\n\"reflectance\": [0.5,\n0.5,\n1.5]}", 6, "reflectance 1.5 is outside [0, 1]");
  expect_bad("{\"reflectance\": [0.5, 0.5]}", 3, "reflectance must have 3 numbers, not 2");
  expect_bad("{\"reflectance\": [0.5, 0.5, \"x\"]}", 3, "reflectance must be a number, not a text");
  expect_bad("{\"reflectance\": \"x\"}", 3, "must be a number or an array of one per band");
  expect_bad("{\n\"exitance\": -0.5}", 4, "material 'red': exitance -0.5 is negative");
  expect_bad("{\"radiance\": [1, 2, -3]}", 3, "material 'red': radiance -3 is negative");
  expect_bad("{\"radiance\": 1e308}", 3, "radiance 1e+308 is too large");
  expect_bad("{\"exitance\": 1,\n\"radiance\": 1}", 3, "both exitance and radiance");
  expect_bad("{\"two_sided\": true}", 3, "neither reflectance nor exitance nor radiance");
  expect_bad("{\"exitance\": 1,\n\"two_sided\": 1}", 4,
             "two_sided must be true or false, not a num");
  expect_bad("{\"exitance\": 1,\n\"albedo\": 1}", 4,
             "material 'red': unknown key 'albedo'; known are reflectance, exitance");
  expect_bad("3", 3, "material 'red' must be an object, not a number");
  expect_error(scene_with("\"materials\": []"), 2, "materials must be an object, not an array");
  expect_error(scene_with("\"materials\": {\n\"\": {\"exitance\": 1}}"), 3,
               "a material's name must not be empty");
  expect_error(scene_with("\"materials\": {\"a\\nb\": {\"exitance\": 1}}"), 2,
               "a material's name must not hold control characters: 'a?b'");
  expect_error(scene_with("\"space_exitance\": -1"), 2, "space_exitance -1 is negative");
}

TEST_F(JsonReader, RefusesBadCameras) {
  const auto expect_bad = [&](const std::string& members, const std::string& why) {
    expect_error(scene_with("\"camera\": {\"target\": [0, 0, 0],\n" + members + "}"), 3, why);
  };
  const std::string position = "\"position\": [0, 0, 5], ";
  expect_bad(position + "\"width\": 0", "camera: width must be a whole number from 1 to 16384");
  expect_bad(position + "\"width\": 1.5", "not 1.5");
  expect_bad(position + "\"height\": -1", "camera: height");
  expect_bad(position + "\"height\": 1e300", "camera: height");
  expect_bad(position + "\"vertical_field_of_view\": 180", "must be less than 180, not 180");
  expect_bad(position + "\"vertical_field_of_view\": 0", "must be greater than 0, not 0");
  expect_bad(position + "\"fov\": 40", "camera: unknown key 'fov'");
  expect_bad("\"position\": [0, 0]", "camera: position must have 3 numbers, not 2");
  const auto expect_bad_view = [&](const std::string& members, const std::string& why) {
    expect_error(scene_with("\"camera\":\n{" + members + "}"), 2, why);
  };
  expect_bad_view("\"target\": [0, 0, 0]", "camera lacks the key 'position'");
  expect_bad_view("\"position\": [0, 0, 0]", "camera lacks the key 'target'");
  expect_bad_view("\"position\": [1, 2, 3], \"target\": [1, 2, 3]", "target must not be the pos");
  expect_bad_view("\"position\": [1, 2, 3], \"target\": [1, 3, 3]", "up must not point along");
  expect_bad_view("\"position\": [1, 2, 3], \"target\": [1.0000001, 3, 3]",
                  "up must not point along");
  expect_bad_view("\"position\": [1, 2, 3], \"target\": [2, 2, 3], \"up\": [0, 0, 0]", "0 0 0");
  expect_bad_view("\"position\": [1e308, 0, 0], \"target\": [-1e308, 0, 0]", "too far apart");
}

TEST_F(JsonReader, RefusesBadHeadersAndMeshes) {
  const std::string head = "{\"format\": \"hemicube-scene\",\n";
  expect_error("\n{\"version\": 1}", 2, "lacks the key 'format'");
  expect_error(head + "\"meshes\": []}", 1, "lacks the key 'version'");
  expect_error(head + "\"version\": 2}", 2, "version 2 is not known; this program reads 1");
  expect_error(head + "\"version\": \"1\"}", 2, "version must be a number, not a text");
  expect_error("{\n\"format\": \"obj\", \"version\": 1}", 2,
               "format 'obj' is not 'hemicube-scene'");
  expect_error(head + "\"version\": 1,\n\"mesh\": []}", 3,
               "the scene: unknown key 'mesh'; known are");
  expect_error("[]", 1, "the scene must be an object, not an array");
  for (const std::string rest : {"}", ", \"meshes\": []}"}) {
    write("s.json", head + "\"version\": 1" + rest);
    expect_refused("s.json", "s.json: the scene has no faces");
  }
  expect_error(head + "\"version\": 1, \"meshes\": {}}", 2, "meshes must be an array, not an obj");
  expect_error(head + "\"version\": 1, \"meshes\": [{}]}", 2, "mesh 0 lacks the key 'file'");
  expect_error(scene_with("", "\"matrial\": \"x\""), 3, "mesh 0: unknown key 'matrial'");
  expect_error(scene_with("", "\"max_edge\": 0"), 3, "mesh 0: max_edge must be greater than 0");
  expect_error(scene_with("\"max_edge\": -1"), 2, "max_edge must be greater than 0, not -1");
  const auto with_file = [&](const std::string& file) {
    return head + "\"version\": 1, \"meshes\": [\n{\"file\": \"" + file + "\"}]}";
  };
  expect_error(with_file("none.obj"), 3, "mesh 0: file 'none.obj' does not exist (looked for ");
  std::filesystem::create_directory(path("folder.obj"));
  expect_error(with_file("folder.obj"), 3, "mesh 0: file 'folder.obj' is a directory, not a file");
  expect_error(with_file("a.mtl"), 3, "mesh 0: file 'a.mtl' is not named .obj, .ply, .off or .stl");
  expect_error(with_file("a.obj\\u0000.obj"), 3, "must not hold control characters");
}

// Catches: a format that scenes are read from, but scene files do not take as a mesh.
TEST_F(JsonReader, MeshesOfOtherFormats) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n2 0 0\n0 3 0\n3 0 1 2\n";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n2 0 0\n0 3 0\n3 0 1 2\n";
  const std::string stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\n"
                          "vertex 0 3 0\nendloop\nendfacet\nendsolid s\n";
  for (const auto& [name, bytes] : {std::pair("m.ply", ply), {"m.off", off}, {"m.STL", stl}}) {
    write(name, bytes);
    expect_scene("{\"format\": \"hemicube-scene\", \"version\": 1, " + kRed +
                 ", \"units\": \"cm\", \"meshes\": [{\"file\": \"" + name +
                 "\", \"max_edge\": 0.5, \"transform\": [-1,0,0,0, 0,1,0,0, 0,0,1,7, 0,0,0,1], "
                 "\"material\": \"red\"}, {\"file\": \"" +
                 name + "\"}]}");
    EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red", ""}));
    EXPECT_EQ(values_of(scene_.face_material), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(values_of(scene_.face_max_edge), (std::vector<double>{0.5, 0}));
    EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 2, 1, 3, 4, 5}));
    EXPECT_EQ(scene_.vertices[1], Vec3(-0.02, 0, 0.07));
    EXPECT_EQ(scene_.vertices[4], Vec3(0.02, 0, 0));
    EXPECT_EQ(report_.faces_without_material, 1u);
  }
  write("m.off", off.substr(0, 30));
  write("s.json", "{\"format\": \"hemicube-scene\", \"version\": 1, \"meshes\": "
                  "[{\"file\": \"m.off\"}]}");
  expect_refused("s.json", "m.off:6: ");
}

TEST_F(JsonReader, ErrorsInAMeshNameTheObj) {
  write("a.obj", "v 0 0 0\nv 0 nan 0\n");
  write("s.json", scene_with(""));
  expect_refused("s.json", "a.obj:2: vertex coordinate 'nan' is not a finite number");
  write("a.obj", "v 0 0 0\n");
  expect_refused("s.json", "a.obj: the scene has no faces");
  expect_refused("none.json", "none.json: does not exist");
}

TEST_F(JsonReader, RefusesWhatIsNotJson) {
  const std::string head = "{\"format\": \"hemicube-scene\",\n";
  expect_error("", 1, "not valid JSON: ");
  expect_error("{", 1, "not valid JSON: ");
  expect_error(head + "\"version\": 1,\n// comment\n\"meshes\": []}", 3, "not valid JSON: ");
  expect_error(head + "\"version\": nan}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": NaN}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": Infinity}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": -\n}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": +1}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": 1e999\n}", 2, "number overflow parsing '1e999'");
  expect_error(head + "\"version\": 1,}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": 1}\n\n{}", 4, "not valid JSON: ");
  expect_error(head + "\"version\": \"\xff\"}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": \"a\nb\"}", 2, "not valid JSON: ");
  expect_error(head + "\"version\": 1,\n\"format\": \"x\"}", 3,
               "the key 'format' is given twice, first on line 1");
  const std::string deep(1000000, '[');
  expect_error(head + "\"meshes\":\n" + deep, 3, "nested deeper than 64 levels");
  expect_error(head + "\"meshes\":\n" + std::string(70, '[') + std::string(70, ']') + "}", 3,
               "deep");
}

TEST_F(JsonReader, NumbersAreTheNearestDoublesInAnyLocale) {
  const std::string json =
      scene_with("\"space_exitance\": [0.1, 1e-310, 123456789.123456789], \"units\": 1e-2");
  const auto expect_exact = [&] {
    expect_scene(json);
    EXPECT_EQ(scene_.space_exitance[0], 0.1);
    EXPECT_EQ(scene_.space_exitance[1], 1e-310);
    EXPECT_EQ(scene_.space_exitance[2], 123456789.123456789);
    EXPECT_EQ(scene_.vertices[3].x, 0.1 * 0.01);
  };
  expect_exact();
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* comma : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"}) // where they are installed
    if (std::setlocale(LC_NUMERIC, comma) != nullptr)
      expect_exact();
  std::setlocale(LC_NUMERIC, before.c_str());
}

} // namespace
} // namespace hemicube::radiosity::test
