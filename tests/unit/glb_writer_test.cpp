#include "radiosity/output/glb_writer.h"

#include "radiosity/elementary.h"
#include "tests/unit/output_support.h"

#include <cstring>
#include <set>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace hemicube::radiosity::test {
namespace {

struct GlbWriterTest : OutputFolder {
  GlbWriterTest() {
    SceneBuilder builder(3);
    const std::uint32_t white = builder.material("white", 0.5, 0);
    builder.material("unused", 0.5, 0);
    const std::uint32_t odd = builder.material("\xff\"odd\"", 0.5, 0); // neither UTF-8 nor plain
    builder.grid([&](int i, int) { return i == 0 ? odd : white; }, {0, 0, -4}, {3, 0, -4.1},
                 {3, 2, -4.1}, {0, 2, -4}, 3, 2);
    scene = builder.finish();
    patches = patches_of(scene);
    for (std::size_t corner = 0; corner < patches.corners.size(); ++corner)
      for (int band = 0; band < 3; ++band) {
        const auto x = static_cast<float>(patches.vertices[patches.corners[corner]].x);
        light.push_back(0.1f + x + 0.3f * static_cast<float>(band));
      }
    require(build_display_mesh(scene, patches, gather_corner_vertices(patches, light, 3), &mesh));
    camera.position = {1, 2, 3};
    camera.target = {1, 2, -4};
    camera.width = 320;
    camera.height = 240;
    camera.vertical_field_of_view = 60;
  }

  Status try_to_write(const DisplayMesh& shown, const Camera& from) {
    FileSet files;
    HC_TRY(files.begin(folder_.string()));
    HC_TRY(write_glb(&files, "s.glb", scene, shown, 2.0, from, "1.2"));
    return files.commit();
  }

  /// Writes the mesh and reads it with another program's reader.
  tinygltf::Model read_back() {
    require(try_to_write(mesh, camera));
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path("s.glb")));
    EXPECT_EQ(error, "");
    EXPECT_EQ(warning, "");
    return model;
  }

  /// The numbers of an accessor. Checks that they lie within the buffer, on multiples of 4.
  template <typename T> static std::vector<T> numbers(const tinygltf::Model& model, int which) {
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(which));
    const tinygltf::BufferView& view =
        model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    const std::vector<unsigned char>& bytes = model.buffers.at(0).data;
    const std::size_t count =
        accessor.count * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                             static_cast<std::uint32_t>(accessor.type)));
    const std::size_t begin = view.byteOffset + accessor.byteOffset;
    EXPECT_EQ(view.byteOffset % 4, 0u);
    EXPECT_EQ(accessor.byteOffset % 4, 0u);
    EXPECT_LE(accessor.byteOffset + count * sizeof(T), view.byteLength);
    EXPECT_LE(view.byteOffset + view.byteLength, bytes.size());
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes.data() + begin, count * sizeof(T));
    return values;
  }

  Scene scene;
  PatchSet patches;
  std::vector<float> light;
  DisplayMesh mesh;
  Camera camera;
};

TEST_F(GlbWriterTest, TheContainerIsWellFormed) {
  require(try_to_write(mesh, camera));
  const std::string bytes = read(path("s.glb"));
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    EXPECT_LE(at + 4, bytes.size());
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), bytes.size());
  const std::uint32_t json_length = word(12);
  EXPECT_EQ(json_length % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(bytes.substr(20, 10), "{\"asset\":{");
  EXPECT_EQ(word(20 + json_length) + 28 + json_length, bytes.size());
  EXPECT_EQ(bytes.substr(24 + json_length, 4), std::string("BIN\0", 4));
  require(try_to_write(mesh, camera));
  EXPECT_EQ(read(path("s.glb")), bytes) << "the same bytes twice";
}

// Catches: colours not exposed, not cut off at white, or encoded; radiances that are not those of
// the mesh; bounds that are not those of the floats.
TEST_F(GlbWriterTest, VerticesReadBackAsTheyWere) {
  const tinygltf::Model model = read_back();
  const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  const auto colours = numbers<float>(model, primitive.attributes.at("COLOR_0"));
  EXPECT_EQ(numbers<float>(model, primitive.attributes.at("POSITION")), mesh.positions);
  EXPECT_EQ(numbers<float>(model, primitive.attributes.at("_RADIANCE")), mesh.radiances);
  ASSERT_EQ(colours.size(), mesh.radiances.size());
  std::size_t cut_off = 0;
  for (std::size_t k = 0; k < colours.size(); ++k) {
    EXPECT_EQ(colours[k], std::min(2 * mesh.radiances[k], 1.f));
    cut_off += colours[k] == 1;
  }
  EXPECT_GT(cut_off, 0u);
  EXPECT_LT(cut_off, colours.size());
  const tinygltf::Accessor& positions = model.accessors.at(0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = mesh.positions[axis], high = low;
    for (std::size_t k = axis; k < mesh.positions.size(); k += 3) {
      low = std::min(low, mesh.positions[k]);
      high = std::max(high, mesh.positions[k]);
    }
    EXPECT_EQ(positions.minValues.at(axis), static_cast<double>(low));
    EXPECT_EQ(positions.maxValues.at(axis), static_cast<double>(high));
  }
}

// Catches: triangles of one material shown with another, and primitives without triangles, which
// the format forbids.
TEST_F(GlbWriterTest, EveryMaterialInUseHasAPrimitive) {
  const tinygltf::Model model = read_back();
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"KHR_materials_unlit"});
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].name, "white");
  EXPECT_EQ(model.materials[1].name, "\xef\xbf\xbd\"odd\"") << "what is no text is replaced";
  for (const tinygltf::Material& material : model.materials) {
    EXPECT_FALSE(material.doubleSided);
    EXPECT_TRUE(material.extensions.contains("KHR_materials_unlit"));
  }
  std::vector<std::uint32_t> all;
  const auto& primitives = model.meshes.at(0).primitives;
  ASSERT_EQ(primitives.size(), 2u);
  for (const tinygltf::Primitive& primitive : primitives) {
    EXPECT_EQ(primitive.mode, TINYGLTF_MODE_TRIANGLES);
    const auto triangles = numbers<std::uint32_t>(model, primitive.indices);
    all.insert(all.end(), triangles.begin(), triangles.end());
    for (const std::uint32_t vertex : triangles) {
      ASSERT_LT(vertex, mesh.vertex_count());
      const float x = mesh.positions[std::size_t{3} * vertex];
      EXPECT_TRUE(primitive.material == 1 ? x <= 1 : x >= 1) << x;
    }
  }
  EXPECT_EQ(all, mesh.triangles);
  EXPECT_EQ(all.size(), 6 * patches.patch_count());
}

// Catches: a camera mirrored, upside down or looking backwards, and degrees for radians.
TEST_F(GlbWriterTest, TheCameraIsANode) {
  camera.target = {6, 2, 3}; // looks along +x, +y up: +z is on the right
  const tinygltf::Model model = read_back();
  const tinygltf::PerspectiveCamera& perspective = model.cameras.at(0).perspective;
  EXPECT_DOUBLE_EQ(perspective.yfov, kPi / 3);
  EXPECT_DOUBLE_EQ(perspective.aspectRatio, 4.0 / 3);
  EXPECT_GT(perspective.znear, 0);
  EXPECT_EQ(model.scenes.at(0).nodes, (std::vector<int>{0, 1}));
  const tinygltf::Node& node = model.nodes.at(1);
  EXPECT_EQ(node.camera, 0);
  EXPECT_EQ(node.matrix, (std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 2, 3, 1}));
  EXPECT_EQ(model.asset.generator, "hemicube 1.2");
}

TEST_F(GlbWriterTest, WhatTheFormatCannotHoldIsRefusedAndNothingWritten) {
  EXPECT_TRUE(check_glb_size("d/s.glb", 0xffffffffu).ok());
  const Status large = check_glb_size("d/s.glb", 0x100000000u);
  EXPECT_EQ(large.code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(large.message().starts_with("d/s.glb: would be 4294967296 bytes")) << large.message();
  EXPECT_EQ(try_to_write(DisplayMesh{}, camera).code(), StatusCode::kInvalidArgument);
  camera.target = camera.position;
  EXPECT_EQ(try_to_write(mesh, camera).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(names(), std::vector<std::string>{});
}

} // namespace
} // namespace hemicube::radiosity::test
