// What is refused of glTF files, and the place that the message names.

#include "tests/support/gltf_files.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

class GltfRefusals : public SceneFiles {
protected:
  /// The square with the value at a JSON pointer replaced (null: removed) must be refused.
  void expect_error(const std::string& pointer, const Json& value, const std::string& why,
                    const std::string& bytes = square_bytes()) {
    SCOPED_TRACE(pointer + " = " + value.dump());
    Json json = square_gltf();
    const Json::json_pointer at(pointer);
    json[at] = value;
    if (value.is_null())
      json[at.parent_pointer()].erase(at.back());
    write("a.gltf", gltf_text(json, bytes));
    expect_refused("a.gltf", "a.gltf:");
    EXPECT_NE(std::string(read("a.gltf").message()).find(why), std::string::npos)
        << read("a.gltf").message();
  }
};

TEST_F(GltfRefusals, ReferencesThatLeadNowhereAreRefused) {
  expect_error("/accessors/0/bufferView", 7,
               "accessors[0].bufferView: 7 is none of the 2 bufferVie");
  expect_error("/accessors/0/bufferView", 4294967296, "4294967296 is none of the 2 bufferViews");
  expect_error("/accessors/0/bufferView", -1, "-1 is not a whole number from 0 on");
  expect_error("/accessors/0/bufferView", 0.5, "0.5 is not a whole number");
  expect_error("/accessors/0/bufferView", "0", "accessors[0].bufferView must be a number, not a t");
  expect_error("/bufferViews/1/buffer", 1, "bufferViews[1].buffer: 1 is none of the 1 buffers");
  expect_error("/nodes/1/mesh", 1, "nodes[1].mesh: 1 is none of the 1 meshes");
  expect_error("/nodes/1/mesh", "0", "nodes[1].mesh must be a number, not a text");
  expect_error("/nodes/0/children/0", 2, "nodes[0].children[0]: 2 is none of the 2 nodes");
  expect_error("/nodes/1/children", {0}, "nodes[1].children[0]: nodes[0] is reached twice");
  expect_error("/nodes/1/camera", 0, "nodes[1].camera: 0 is none of the 0 cameras");
  expect_error("/scene", 1, "scene: 1 is none of the 1 scenes");
  expect_error("/scenes", Json::array(), "the file has no scenes");
  expect_error("/scenes/0/nodes", Json::array(), "the scene has no faces");
  const std::string primitive = "/meshes/0/primitives/0";
  const std::string what = "meshes[0].primitives[0]";
  expect_error(primitive + "/material", 1, what + ".material: 1 is none of the 1 materials");
  expect_error(primitive + "/indices", 2, what + ".indices: 2 is none of the 2 accessors");
  expect_error(primitive + "/attributes/POSITION", 9, what + ".attributes.POSITION: 9 is none");
  expect_error(primitive + "/attributes", Json::object(), "lacks the key 'POSITION'");
  expect_error(primitive + "/mode", 7, what + ".mode: 7 is not known");
}

TEST_F(GltfRefusals, AccessorsThatLeaveTheirBytesAreRefused) {
  expect_error("/accessors/0/count", 5,
               "accessors[0]: its 5 elements end at byte 60 of a buffer v");
  expect_error("/accessors/0/count", 9007199254740992, "9007199254740992 elements end at byte ");
  expect_error("/accessors/0/count", 0, "accessors[0].count: 0 elements");
  expect_error("/accessors/0/count", nullptr, "accessors[0] lacks the key 'count'");
  expect_error("/accessors/0/byteOffset", 4, "its 4 elements end at byte 52");
  expect_error("/accessors/0/byteOffset", -4, "accessors[0].byteOffset: -4 is not a whole number");
  expect_error("/bufferViews/0/byteStride", 16, "its 4 elements end at byte 60");
  expect_error("/bufferViews/0/byteStride", 253, "bufferViews[0].byteStride: 253 is more than 252");
  expect_error("/bufferViews/1/byteOffset", 49, "bufferViews[1]: bytes 49 to 61 of buffers[0]");
  expect_error("/bufferViews/1/byteOffset", 9007199254740992, "of buffers[0], which has 60");
  expect_error("/buffers/0/byteLength", 61, "buffers[0].byteLength: 61 bytes are more than the 60");
  expect_error("/buffers/0/byteLength", 59, "bytes 48 to 60 of buffers[0], which has 59");
  expect_error("/accessors/0/type", "VEC2", "accessors[0].type: 'VEC2' must be 'VEC3' here");
  expect_error("/accessors/0/componentType", 5124, "accessors[0].componentType: 5124 is not known");
  expect_error("/accessors/0/componentType", 5125, "positions cannot be 5125");
  expect_error("/accessors/1/componentType", 5122, "indices must be 5121, 5123 or 5125, not 5122");
  expect_error("/accessors/0/sparse", Json::object(), "accessors[0].sparse: sparse accessors are");
  expect_error("/accessors/0/count", 3,
               "accessors[1]: element 5 is vertex index 3, but there are 3");
  expect_error("/accessors/1/count", 5, "5 vertices make no whole triangles");
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    std::string bytes = square_bytes();
    bytes.replace(20, 4, bytes_of(bad));
    expect_error("/scene", 0, "accessors[0]: element 1 has a coordinate of ", bytes);
  }
}

TEST_F(GltfRefusals, ValuesOutOfRangeAreRefused) {
  const std::string base = "/materials/0/pbrMetallicRoughness/baseColorFactor";
  expect_error(base, {0.5, 1.5, 0, 1}, "baseColorFactor: 1.5 is outside [0, 1]");
  expect_error(base, {0.5, -0.5, 0, 1}, "baseColorFactor: -0.5 is outside [0, 1]");
  expect_error(base, {0.5, 0.5, 0.5}, "baseColorFactor must have 4 numbers, not 3");
  expect_error(base, {"0", 0, 0, 1}, "baseColorFactor must be a number, not a text");
  expect_error("/materials/0/emissiveFactor", {0, -1, 0}, "emissiveFactor: -1 is negative");
  expect_error("/materials/0/emissiveFactor", 1, "emissiveFactor must be an array, not a number");
  expect_error("/materials/0/doubleSided", "yes", "doubleSided must be true or false, not a text");
  const Json strength = {{"KHR_materials_emissive_strength", {{"emissiveStrength", -2}}}};
  expect_error("/materials/0/extensions", strength, "emissiveStrength: -2 is negative");
  expect_error("/materials/0/name", "a\nb", "materials[0].name must not hold control characters");
  expect_error("/nodes/0/scale", {0, 1, 1}, "nodes[1]: the transforms down to it flatten its mesh");
  expect_error("/nodes/0/scale", {1, 1}, "nodes[0].scale must have 3 numbers, not 2");
  expect_error("/nodes/0/rotation", {0, 0, 0, 0}, "nodes[0].rotation must be of length 1, not 0");
  expect_error("/nodes/0/scale", {1, 1.7e308, 1}, "nodes[1]: its transform makes a coordinate too");
  expect_error("/nodes/0/matrix", Json(std::vector<int>(16, 1)),
               "nodes[0].matrix must have the la");
  expect_error("/nodes/0/matrix", {1, 0}, "nodes[0].matrix must have 16 numbers, not 2");
}

TEST_F(GltfRefusals, OtherVersionsAndRequiredExtensionsAreRefused) {
  expect_error("/asset/version", "1.0",
               "asset.version: '1.0' is not known; this program reads 2.0");
  expect_error("/asset/version", 2.0, "asset.version must be a text, not a number");
  expect_error("/asset/minVersion", "2.1", "asset.minVersion: '2.1' is not known");
  expect_error("/asset", nullptr, "the file lacks the key 'asset'");
  expect_error("/extensionsRequired", {"KHR_draco_mesh_compression"},
               "extensionsRequired: 'KHR_draco_mesh_compression' is not supported");
  write("a.gltf", "[]");
  expect_refused("a.gltf", "a.gltf:1: the file must be an object, not an array");
  expect_refused("none.glb", "none.glb: does not exist");
}

TEST_F(GltfRefusals, GlbFilesThatAreNoneAreRefused) {
  const std::string good = glb(square_gltf(), square_bytes());
  for (std::size_t size = 0; size < good.size(); size += 7) {
    write("a.glb", good.substr(0, size));
    expect_refused("a.glb", "a.glb: ");
  }
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string file = good;
    return file.replace(at, bytes.size(), bytes);
  };
  const std::pair<std::string, std::string> cases[] = {
      {with(0, "glTG"), "this is no GLB file: it does not begin with 'glTF'"},
      {with(4, "\1"), "version 1 is not known; this program reads 2"},
      {good + "x", "the header says " + std::to_string(good.size()) + " bytes, but the file has "},
      {with(14, "\1"), "byte 12: the chunk says "},
      {with(16, "BSON"), "byte 12: the first chunk is not JSON"},
      {"glTF" + bytes_of<std::uint32_t>({2, 12}), "there is no JSON chunk"}};
  for (const auto& [bytes, why] : cases) {
    write("a.glb", bytes);
    expect_refused("a.glb", "a.glb: " + why);
  }
  write("a.glb", glb(square_gltf(), ""));
  expect_refused("a.glb", "a.glb:1: buffers[0] has no uri, and there is no binary chunk for it");
}

TEST_F(GltfRefusals, SceneFilesDoNotTakeGltfAsAMesh) {
  write("a.glb", glb(square_gltf(), square_bytes()));
  write("s.json", "{\"format\": \"hemicube-scene\", \"version\": 1,\n\"meshes\": [{\"file\": "
                  "\"a.glb\"}]}");
  expect_refused("s.json", "s.json:2: mesh 0: file 'a.glb' is a scene of its own");
}

} // namespace
} // namespace hemicube::radiosity::test
