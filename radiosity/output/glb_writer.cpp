#include "radiosity/output/glb_writer.h"

#include "radiosity/elementary.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/output/file_writer.h"
#include "radiosity/output/little_endian.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity {
namespace {

using Json = nlohmann::ordered_json;

// Words of the format.
constexpr std::uint32_t kMagic = 0x46546c67, kVersion = 2;                  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942; // "JSON", "BIN"
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kTriangles = 4;

constexpr int kTriangleView = 3; ///< the buffer view behind those of positions, colours, radiances

constexpr double kNearest = 0.01; ///< that a camera shows, of the distance to its target

/// Where the parts of the binary chunk begin, in bytes; all are multiples of 4.
struct Layout {
  explicit Layout(const DisplayMesh& mesh)
      : vertex_bytes(4 * mesh.positions.size()), triangles(3 * vertex_bytes),
        end(triangles + 4 * mesh.triangles.size()) {}

  std::uint64_t vertex_bytes; ///< of each of positions, colours and radiances, in this order
  std::uint64_t triangles, end;
};

Json vector_json(const float* values) {
  // As doubles, so that every reader finds the very bits of the floats.
  return Json::array({static_cast<double>(values[0]), static_cast<double>(values[1]),
                      static_cast<double>(values[2])});
}

Json buffer_views_json(const Layout& layout) {
  Json views = Json::array();
  for (std::uint64_t offset = 0; offset < layout.triangles; offset += layout.vertex_bytes)
    views.push_back({{"buffer", 0},
                     {"byteOffset", offset},
                     {"byteLength", layout.vertex_bytes},
                     {"target", kArrayBuffer}});
  views.push_back({{"buffer", 0},
                   {"byteOffset", layout.triangles},
                   {"byteLength", layout.end - layout.triangles},
                   {"target", kElementArrayBuffer}});
  return views;
}

Json vertex_accessors_json(const DisplayMesh& mesh) {
  float low[3], high[3];
  std::copy_n(mesh.positions.begin(), 3, low);
  std::copy_n(mesh.positions.begin(), 3, high);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    low[k % 3] = std::min(low[k % 3], mesh.positions[k]);
    high[k % 3] = std::max(high[k % 3], mesh.positions[k]);
  }
  Json accessors = Json::array();
  for (int view = 0; view < kTriangleView; ++view)
    accessors.push_back({{"bufferView", view},
                         {"componentType", kFloat},
                         {"count", mesh.vertex_count()},
                         {"type", "VEC3"}});
  accessors[0]["min"] = vector_json(low);
  accessors[0]["max"] = vector_json(high);
  return accessors;
}

Json material_json(std::string_view name) {
  return {{"name", name},
          {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
          {"doubleSided", false},
          {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
}

/// Adds the mesh, its materials and its accessors.
void add_primitives(const Scene& scene, const DisplayMesh& mesh, Json* gltf) {
  Json accessors = vertex_accessors_json(mesh), materials = Json::array();
  Json primitives = Json::array();
  for (std::uint32_t material = 0; material < scene.materials.size(); ++material) {
    const std::size_t first = mesh.first[material], count = mesh.first[material + 1] - first;
    if (count == 0)
      continue;
    primitives.push_back({{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}, {"_RADIANCE", 2}}},
                          {"indices", accessors.size()},
                          {"material", materials.size()},
                          {"mode", kTriangles}});
    materials.push_back(material_json(scene.materials[material]));
    accessors.push_back({{"bufferView", kTriangleView},
                         {"byteOffset", 4 * first},
                         {"componentType", kUnsignedInt},
                         {"count", count},
                         {"type", "SCALAR"}});
  }
  (*gltf)["meshes"].push_back({{"name", "solution"}, {"primitives", primitives}});
  (*gltf)["materials"] = materials;
  (*gltf)["accessors"] = accessors;
}

/// Adds a camera and its node. Cameras of glTF look along their -z, with +y up.
Status add_camera(const Camera& camera, Json* gltf) {
  CameraView picture;
  HC_TRY(camera_view(camera, 1, &picture));
  const Vec3 &right = picture.view.axis_x, &down = picture.view.axis_y,
             &forward = picture.view.axis_z, &eye = picture.view.eye;
  (*gltf)["nodes"].push_back({{"name", "view"},
                              {"camera", 0},
                              {"matrix",
                               {right.x, right.y, right.z, 0, -down.x, -down.y, -down.z, 0,
                                -forward.x, -forward.y, -forward.z, 0, eye.x, eye.y, eye.z, 1}}});
  const double distance = glm::distance(camera.position, camera.target);
  (*gltf)["cameras"].push_back(
      {{"name", "view"},
       {"type", "perspective"},
       {"perspective",
        {{"aspectRatio", static_cast<double>(camera.width) / camera.height},
         {"yfov", camera.vertical_field_of_view * (kPi / 180)},
         {"znear", kNearest * distance}}}});
  return {};
}

Status make_json(const Scene& scene, const DisplayMesh& mesh, const Camera& camera,
                 std::string_view version, std::string* text) {
  const Layout layout(mesh);
  Json gltf;
  gltf["asset"] = {{"version", "2.0"}, {"generator", "hemicube " + std::string(version)}};
  gltf["extensionsUsed"].push_back("KHR_materials_unlit");
  gltf["scene"] = 0;
  gltf["scenes"].push_back({{"nodes", {0, 1}}});
  gltf["nodes"].push_back({{"name", "solution"}, {"mesh", 0}});
  HC_TRY(add_camera(camera, &gltf));
  add_primitives(scene, mesh, &gltf);
  gltf["bufferViews"] = buffer_views_json(layout);
  gltf["buffers"].push_back({{"byteLength", layout.end}});
  *text = gltf.dump(-1, ' ', false, Json::error_handler_t::replace);
  text->resize((text->size() + 3) / 4 * 4, ' ');
  return {};
}

} // namespace

Status check_glb_size(std::string_view shown_as, std::uint64_t bytes) {
  if (bytes <= 0xffffffffu)
    return {};
  return Status::error(StatusCode::kInvalidArgument, shown_as, ": would be ", bytes,
                       " bytes, more than the 4294967295 that its format can hold; it is left out");
}

Status write_glb(FileSet* files, std::string_view name, const Scene& scene, const DisplayMesh& mesh,
                 double exposure, const Camera& camera, std::string_view version) {
  if (mesh.triangles.empty())
    return Status::error(StatusCode::kInvalidArgument, files->shown_path(name),
                         ": no patch has an area in single precision; it is left out");
  std::string json;
  HC_TRY(make_json(scene, mesh, camera, version, &json));
  const std::uint64_t binary = Layout(mesh).end;
  const std::uint64_t length = 12 + 8 + json.size() + 8 + binary;
  HC_TRY(check_glb_size(files->shown_path(name), length));

  FileWriter writer;
  HC_TRY(writer.open(files->path_for(name), files->shown_path(name)));
  std::string& bytes = writer.text();
  for (const std::uint64_t word : {std::uint64_t{kMagic}, std::uint64_t{kVersion}, length,
                                   std::uint64_t{json.size()}, std::uint64_t{kJsonChunk}})
    append_little_endian(&bytes, static_cast<std::uint32_t>(word));
  bytes += json;
  append_little_endian(&bytes, static_cast<std::uint32_t>(binary));
  append_little_endian(&bytes, kBinaryChunk);
  const auto append_all = [&](const auto& values, auto&& shown) {
    for (const auto value : values) {
      append_little_endian(&bytes, shown(value));
      writer.flush_if_large();
    }
  };
  append_all(mesh.positions, std::identity());
  append_all(mesh.radiances, [&](float radiance) {
    return static_cast<float>(std::min(exposure * static_cast<double>(radiance), 1.0));
  });
  append_all(mesh.radiances, std::identity());
  append_all(mesh.triangles, std::identity());
  return writer.close();
}

} // namespace hemicube::radiosity
