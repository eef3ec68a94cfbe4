#include "radiosity/scene/gltf_reader.h"

#include "tests/support/gltf_files.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

using Corners = std::vector<std::uint32_t>;
using Skipped = std::map<std::string, std::uint64_t>;

class GltfReader : public SceneFiles {
protected:
  void expect_gltf(const Json& json, const std::string& bytes = square_bytes()) {
    SCOPED_TRACE(json.dump(2));
    write("a.gltf", gltf_text(json, bytes));
    expect_read("a.gltf");
    if (!HasFatalFailure())
      expect_scene_is_sound(scene_);
  }

  void expect_vertices(const std::vector<Vec3>& expected) {
    ASSERT_EQ(scene_.vertices.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_LT(glm::length(scene_.vertices[i] - expected[i]), 1e-14)
          << i << ": " << scene_.vertices[i].x << " " << scene_.vertices[i].y << " "
          << scene_.vertices[i].z;
  }
};

TEST_F(GltfReader, ReadsTrianglesWithTheirMaterialAndGroup) {
  expect_gltf(square_gltf());
  EXPECT_EQ(values_of(scene_.corner_offsets), (std::vector<std::uint64_t>{0, 3, 6}));
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(values_of(scene_.vertices),
            (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}));
  EXPECT_EQ(names_of(scene_.bands), (std::vector<std::string>{"r", "g", "b"}));
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red"}));
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"square"}));
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.5, 0.25, 0}));
  EXPECT_EQ(values_of(scene_.exitance), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(values_of(scene_.two_sided), (std::vector<std::uint8_t>{0}));
  EXPECT_FALSE(scene_.has_camera);
  EXPECT_TRUE(report_.skipped.empty());
  EXPECT_EQ(report_.files, (std::vector<std::string>{path("a.gltf")}));
}

// Catches: a buffer taken from the wrong place.
TEST_F(GltfReader, BuffersAreFilesDataOrAChunk) {
  Json json = square_gltf();
  json["buffers"][0]["uri"] = "my%20square.bin";
  write("my square.bin", square_bytes() + "more");
  write("b.gltf", json.dump());
  expect_read("b.gltf");
  EXPECT_EQ(scene_.vertices[2], Vec3(1, 2, 0));
  EXPECT_EQ(report_.files, (std::vector<std::string>{path("b.gltf"), path("my square.bin")}));

  write("c.glb", glb(square_gltf(), square_bytes()));
  expect_read("c.glb");
  EXPECT_EQ(scene_.vertices[2], Vec3(1, 2, 0));
  write("c.glb", glb(json, "this is not the buffer"));
  expect_read("c.glb");
  EXPECT_EQ(scene_.vertices[2], Vec3(1, 2, 0));

  write("my square.bin", square_bytes().substr(0, 59));
  expect_refused("b.gltf", "b.gltf:1: buffers[0].byteLength: 60 bytes are more than the 59 that");
  std::filesystem::remove(path("my square.bin"));
  expect_refused("b.gltf",
                 "b.gltf:1: buffers[0].uri: 'my%20square.bin' does not exist (looked for ");
  std::filesystem::create_directory(path("my square.bin"));
  expect_refused("b.gltf",
                 "b.gltf:1: buffers[0].uri: 'my%20square.bin' is a directory, not a file");
  json["buffers"][0]["uri"] = "https://example.org/a.bin";
  write("b.gltf", json.dump());
  expect_refused("b.gltf", "b.gltf:1: buffers[0].uri: 'https://example.org/a.bin' is not the name");
  json["buffers"][0]["uri"] = "data:;base64,AAA*";
  write("b.gltf", json.dump());
  expect_refused("b.gltf", "b.gltf:1: buffers[0].uri: the data is not valid base64");
  write("b.gltf", square_gltf().dump());
  expect_refused("b.gltf", "b.gltf:1: buffers[0] has no uri, and there is no binary chunk");
}

// Catches: a transform applied in the wrong order, or rows taken for columns.
TEST_F(GltfReader, TransformsOfNodesAreApplied) {
  Json json = square_gltf();
  json["nodes"][0]["translation"] = {10, 0, 0};
  json["nodes"][0]["scale"] = {2, 3, 1};
  // A quarter turn about z: x becomes y, y becomes -x.
  const double half = std::sqrt(0.5);
  json["nodes"][1]["rotation"] = {0, 0, half, half};
  json["nodes"][1]["translation"] = {0, 0, 5};
  expect_gltf(json);
  expect_vertices({{10, 0, 5}, {10, 3, 5}, {6, 3, 5}, {6, 0, 5}});
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2, 0, 2, 3}));

  json = square_gltf();
  json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
  expect_gltf(json);
  expect_vertices({{7, 8, 9}, {7, 9, 9}, {5, 9, 9}, {5, 8, 9}});
}

// Catches: fronts that become backs.
TEST_F(GltfReader, MirroredTrianglesKeepTheirFronts) {
  Json json = square_gltf();
  json["nodes"][1]["scale"] = {-1, 1, 1};
  expect_gltf(json);
  expect_vertices({{0, 0, 0}, {-1, 0, 0}, {-1, 2, 0}, {0, 2, 0}});
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 2, 1, 0, 3, 2}));
  json["nodes"][0]["scale"] = {1, 1, -2};
  expect_gltf(json);
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2, 0, 2, 3}));
}

TEST_F(GltfReader, StripsFansAndPlainVertices) {
  Json json = square_gltf();
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["mode"] = 5;
  expect_gltf(json);
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2, 1, 0, 2, 2, 0, 2, 0, 3, 2}));
  primitive["mode"] = 6;
  expect_gltf(json);
  EXPECT_EQ(values_of(scene_.corners), (Corners{1, 2, 0, 2, 0, 0, 0, 2, 0, 2, 3, 0}));
  primitive.erase("indices");
  expect_gltf(json);
  EXPECT_EQ(values_of(scene_.corners), (Corners{1, 2, 0, 2, 3, 0}));
  primitive["mode"] = 5;
  expect_gltf(json);
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2, 1, 3, 2}));
  primitive["mode"] = 4;
  json["accessors"][0]["count"] = 3;
  expect_gltf(json);
  EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2}));
  Json lines = primitive;
  lines["mode"] = 1;
  json["meshes"][0]["primitives"].push_back(lines);
  expect_gltf(json);
  EXPECT_EQ(scene_.face_count(), 1u);
  EXPECT_EQ(report_.skipped, (Skipped{{"primitives of points or lines", 1}}));
}

// Catches: a component read with the size or sign of another; a stride not kept.
TEST_F(GltfReader, ComponentTypesAndStrides) {
  Json json = square_gltf();
  for (const auto& [type, indices] : {std::pair(5121, bytes_of<std::uint8_t>({0, 1, 2, 0, 2, 3})),
                                      {5125, bytes_of<std::uint32_t>({0, 1, 2, 0, 2, 3})}}) {
    json["accessors"][1]["componentType"] = type;
    json["bufferViews"][1]["byteLength"] = indices.size();
    json["buffers"][0]["byteLength"] = 48 + indices.size();
    expect_gltf(json, square_bytes().substr(0, 48) + indices);
    EXPECT_EQ(values_of(scene_.corners), (Corners{0, 1, 2, 0, 2, 3}));
  }
  json = square_gltf();
  json["bufferViews"][0]["byteStride"] = 16;
  json["bufferViews"][0]["byteOffset"] = 16;
  json["bufferViews"][0]["byteLength"] = 64;
  json["accessors"][0]["byteOffset"] = 4;
  json["buffers"][0]["byteLength"] = 80;
  std::string bytes(16, 'x');
  for (const float y : {1.f, 2.f, 3.f, 4.f})
    bytes += bytes_of({-99.f, y * y, y, 0.5f});
  json["accessors"][1] = {
      {"bufferView", 1}, {"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}};
  json["bufferViews"][1] = {{"buffer", 0}, {"byteLength", 3}};
  bytes.replace(0, 3, bytes_of<std::uint8_t>({3, 1, 0}));
  expect_gltf(json, bytes);
  expect_vertices({{1, 1, 0.5}, {4, 2, 0.5}, {9, 3, 0.5}, {16, 4, 0.5}});
  EXPECT_EQ(values_of(scene_.corners), (Corners{3, 1, 0}));
}

TEST_F(GltfReader, QuantizedPositions) {
  Json json = square_gltf();
  json["extensionsRequired"] = {"KHR_mesh_quantization"};
  json["meshes"][0]["primitives"][0].erase("indices");
  json["accessors"][0]["count"] = 3;
  Json& accessor = json["accessors"][0];
  for (const bool normalized : {false, true}) {
    accessor["normalized"] = normalized;
    const auto expect = [&](int type, const std::string& bytes, double largest) {
      accessor["componentType"] = type;
      expect_gltf(json, bytes + std::string(60, '\0'));
      const double unit = normalized ? 1 / largest : 1;
      expect_vertices({{0, 5 * unit, 0}, {largest * unit, 0, 0}, {0, 0, 7 * unit}});
    };
    expect(5120, bytes_of<std::int8_t>({0, 5, 0, 127, 0, 0, 0, 0, 7}), 127);
    expect(5121, bytes_of<std::uint8_t>({0, 5, 0, 255, 0, 0, 0, 0, 7}), 255);
    expect(5122, bytes_of<std::int16_t>({0, 5, 0, 32767, 0, 0, 0, 0, 7}), 32767);
    expect(5123, bytes_of<std::uint16_t>({0, 5, 0, 65535, 0, 0, 0, 0, 7}), 65535);
  }
  accessor["componentType"] = 5120;
  expect_gltf(json, bytes_of<std::int8_t>({-128, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(60, '\0'));
  EXPECT_EQ(scene_.vertices[0], Vec3(-1, 0, 0));
}

TEST_F(GltfReader, MaterialsGiveReflectanceAndExitance) {
  Json json = square_gltf();
  json["materials"] = Json::parse(R"([
    {"name": "unused"},
    {"name": "lamp", "emissiveFactor": [1, 0.5, 0], "doubleSided": true,
     "pbrMetallicRoughness": {"baseColorFactor": [0, 0.125, 1, 0.5],
                              "baseColorTexture": {"index": 0}, "metallicFactor": 0},
     "alphaMode": "BLEND", "emissiveTexture": {"index": 0},
     "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 20},
                    "KHR_materials_ior": {"ior": 1.4}}},
    {"emissiveFactor": [0.25, 0, 0]}, {"name": "lamp"}, {"name": ""}])");
  json["extensionsRequired"] = {"KHR_materials_emissive_strength"};
  Json& primitives = json["meshes"][0]["primitives"];
  primitives[0]["material"] = 1;
  primitives[0]["attributes"]["COLOR_0"] = 0;
  primitives[0]["attributes"]["NORMAL"] = 0;
  for (const int material : {3, 2, 4, 1}) {
    primitives.push_back(primitives[0]);
    primitives.back()["material"] = material;
  }
  primitives.push_back(primitives[0]);
  primitives.back().erase("material");
  expect_gltf(json);
  EXPECT_EQ(names_of(scene_.materials),
            (std::vector<std::string>{"lamp", "lamp_3", "material_2", "material_4", ""}));
  EXPECT_EQ(values_of(scene_.face_material),
            (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 4}));
  EXPECT_EQ(values_of(scene_.reflectance),
            (std::vector<double>{0, 0.125, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5, 0.5, 0.5}));
  EXPECT_EQ(values_of(scene_.exitance),
            (std::vector<double>{20, 10, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(values_of(scene_.two_sided), (std::vector<std::uint8_t>{1, 0, 0, 0, 0}));
  EXPECT_EQ(report_.faces_without_material, 2u);
  EXPECT_EQ(scene_.vertices.size(), 4u) << "one accessor, read once";
  EXPECT_EQ(report_.skipped, (Skipped{{"material extensions (KHR_materials_ior)", 1},
                                      {"textures (baseColorTexture)", 1},
                                      {"textures (emissiveTexture)", 1},
                                      {"transparency (alphaMode)", 1},
                                      {"vertex attributes (NORMAL)", 6},
                                      {"vertex colours (COLOR_0)", 6}}));
}

TEST_F(GltfReader, NodesAreListedParentsFirstInTheOrderOfTheFile) {
  Json json = square_gltf();
  json["nodes"] = Json::parse(R"([{"mesh": 0, "name": "a", "children": [3, 1]},
    {"mesh": 0, "name": "b"}, {"mesh": 0}, {"mesh": 0, "name": "d", "skin": 0}, {"mesh": 0}])");
  json["meshes"][0]["name"] = "quad";
  json["scenes"] = Json::parse(R"([{"nodes": [4]}, {"nodes": [2, 0]}])");
  json["scene"] = 1;
  expect_gltf(json);
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"quad", "a", "d", "b"}));
  EXPECT_EQ(report_.skipped, (Skipped{{"skins (the mesh is taken as it is)", 1}}));
  json.erase("scene");
  json["meshes"][0].erase("name");
  expect_gltf(json);
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"node_4"}));
}

// Catches: a recursion that overflows the stack.
TEST_F(GltfReader, NodesMayNestDeeply) {
  Json json = square_gltf();
  for (int i = 1; i < 20000; ++i)
    json["nodes"][static_cast<std::size_t>(i)] = {{"children", {i + 1}}};
  json["nodes"].push_back({{"mesh", 0}, {"name", "last"}});
  expect_gltf(json);
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"last"}));
  json["nodes"].back()["children"] = {17};
  write("a.gltf", gltf_text(json, square_bytes()));
  expect_refused("a.gltf", "a.gltf:1: nodes[20000].children[0]: nodes[17] is reached twice");
  std::string deep = square_gltf().dump();
  deep.insert(1, "\"extras\": " + std::string(200000, '[') + std::string(200000, ']') + ",");
  write("a.gltf", deep);
  expect_refused("a.gltf", "a.gltf:1: nested deeper than 64 levels");
}

TEST_F(GltfReader, TheFirstPerspectiveCameraIsTheCamera) {
  Json json = square_gltf();
  json["cameras"] = Json::parse(R"([{"type": "orthographic", "orthographic": {}},
    {"type": "perspective", "perspective": {"yfov": 1.5707963267948966, "aspectRatio": 2}},
    {"type": "perspective", "perspective": {"yfov": 1}}])");
  json["nodes"].push_back({{"camera", 0}});
  json["nodes"].push_back({{"camera", 1}, {"scale", {3, 3, 3}}, {"translation", {1, 2, 3}}});
  json["nodes"].push_back({{"camera", 2}});
  json["nodes"][0]["children"] = {1, 2, 3, 4};
  // A quarter turn about y: the camera looks along -x.
  const double half = std::sqrt(0.5);
  json["nodes"][0]["rotation"] = {0, half, 0, half};
  expect_gltf(json);
  ASSERT_TRUE(scene_.has_camera);
  EXPECT_LT(glm::length(scene_.camera.position - Vec3(3, 2, -1)), 1e-14);
  EXPECT_LT(glm::length(scene_.camera.target - Vec3(2, 2, -1)), 1e-14);
  EXPECT_LT(glm::length(scene_.camera.up - Vec3(0, 1, 0)), 1e-14);
  EXPECT_NEAR(scene_.camera.vertical_field_of_view, 90, 1e-12);
  EXPECT_EQ(scene_.camera.width, 1200u);
  EXPECT_EQ(scene_.camera.height, 600u);
  EXPECT_EQ(report_.skipped, (Skipped{{"further cameras", 1}, {"orthographic cameras", 1}}));
  json["cameras"][1]["perspective"]["aspectRatio"] = 1e9;
  expect_gltf(json);
  EXPECT_EQ(scene_.camera.width, Camera::kMaxSize);
}

} // namespace
} // namespace hemicube::radiosity::test
