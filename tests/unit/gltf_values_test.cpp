// glTF files with any value of their JSON exchanged: a clear error or a sound scene.

#include "tests/support/gltf_files.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

class GltfValues : public SceneFiles {
protected:
  void expect_refused_or_sound(const std::string& name, const std::string& bytes) {
    SCOPED_TRACE(bytes);
    write(name, bytes);
    const Status status = read(name);
    ++(status.ok() ? sound_ : refused_);
    if (status.ok()) {
      expect_scene_is_sound(scene_);
      return;
    }
    EXPECT_EQ(status.code(), StatusCode::kBadScene) << status.message();
    EXPECT_TRUE(status.message().starts_with(path(name) + ":")) << status.message();
  }

  int sound_ = 0, refused_ = 0;
};

/// The square with all that is read: two nodes more, a camera, a strength, a strip.
Json full_gltf() {
  Json json = square_gltf();
  json["nodes"][0]["rotation"] = {0, 0, 0.6, 0.8};
  json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 5, 6, 7, 1};
  json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 3}}, {"scale", {1, 2, 3}}});
  json["nodes"][0]["children"] = {1, 2};
  json["cameras"] = Json::parse(R"([{"perspective": {"yfov": 1, "aspectRatio": 1.5}}])");
  json["materials"][0]["emissiveFactor"] = {1, 0, 0.5};
  json["materials"][0]["doubleSided"] = true;
  json["materials"][0]["extensions"] = {
      {"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}}};
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 5}});
  return json;
}

// Catches: a value of the wrong kind or out of range that is used all the same.
TEST_F(GltfValues, AnyValueExchangedIsRefusedOrSound) {
  const Json values[] = {nullptr,
                         -1,
                         0,
                         1,
                         2,
                         3,
                         7,
                         0.5,
                         1e308,
                         4294967296,
                         5121,
                         5125,
                         1e-300,
                         "text",
                         true,
                         Json::array(),
                         Json::object(),
                         Json::array({0, 1}),
                         Json::array({1e200, 1, 1})};
  const Json original = full_gltf();
  const Json flat = original.flatten();
  for (const auto& entry : flat.items()) {
    // The value itself, and the array or object around it.
    for (const Json::json_pointer& at :
         {Json::json_pointer(entry.key()), Json::json_pointer(entry.key()).parent_pointer()})
      for (const Json& value : values) {
        Json json = original;
        json[at] = value;
        expect_refused_or_sound("a.glb", glb(json, square_bytes()));
        if (HasFailure())
          return;
      }
  }
  EXPECT_GT(sound_, 200);
  EXPECT_GT(refused_, 1000);
}

} // namespace
} // namespace hemicube::radiosity::test
