#include "radiosity/scene/gltf_reader.h"

#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_camera.h"
#include "radiosity/scene/gltf_material.h"
#include "radiosity/scene/gltf_node.h"
#include "radiosity/scene/scene_builder.h"

#include <array>
#include <map>
#include <utility>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;

/// How the vertices of a primitive are joined; smaller numbers are points and lines.
enum Mode : std::uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

/// Where the corners of a triangle of a primitive stand among its indices.
std::array<std::size_t, 3> corners_of(std::uint64_t mode, std::size_t triangle) {
  const std::size_t i = triangle;
  if (mode == kTriangles)
    return {3 * i, 3 * i + 1, 3 * i + 2};
  if (mode == kFan)
    return {i + 1, i + 2, 0};
  // Every second triangle of a strip would face the other way.
  return {i, i + 1 + i % 2, i + 2 - i % 2};
}

constexpr std::uint32_t kNoMaterial = 0xffffffffu;

class GltfScene {
public:
  GltfScene(const std::string& path, Scene* scene, ReadReport* report)
      : file_(path), fields_(file_.fields()), scene_(*scene), report_(*report), builder_(scene) {}

  Status read();

private:
  /// Vertices of the mesh at hand.
  struct Vertices {
    std::uint32_t first = 0;
    std::uint64_t count = 0;
  };

  Status node(const GltfNode& node);
  Status camera(const GltfNode& node, const JsonValue& reference);
  Status mesh(const GltfNode& node, const JsonValue& reference);
  Status group(const GltfNode& node, const GltfFile::Item& mesh);
  Status primitive(const GltfNode& node, const JsonValue& value, const std::string& what);
  Status vertices(const GltfNode& node, const JsonValue& primitive, const std::string& what,
                  Vertices* vertices);
  Status material(const JsonValue& primitive, const std::string& what, std::uint32_t* number);
  Status indices(const JsonValue& primitive, const std::string& what, std::uint64_t vertex_count);
  Status triangles(const JsonValue& primitive, const std::string& what, std::uint64_t mode,
                   std::uint32_t first_vertex);
  void count_skipped();

  GltfFile file_;
  const JsonFields& fields_;
  Scene& scene_;
  ReadReport& report_;
  SceneBuilder builder_;
  std::vector<SceneMaterial> materials_; // of the file

  FileMesh mesh_;                                   // of the whole scene
  std::vector<std::uint32_t> scene_materials_;      // the scene's number of each of its materials
  std::map<std::uint32_t, std::uint32_t> used_;     // its number of each material of the file
  std::map<std::uint32_t, Vertices> node_vertices_; // of the node at hand, by accessor
  bool mirrors_ = false;                            // the node at hand does
  Buffer<std::uint32_t> indices_;                   // of the primitive at hand
  KeywordCounts attributes_;
};

Status GltfScene::read() {
  for (const char* band : {"r", "g", "b"})
    HC_TRY(scene_.bands.add(band));
  HC_TRY(scene_.space_exitance.resize(scene_.band_count()));
  HC_TRY(file_.open({kGltfEmissiveStrength, "KHR_mesh_quantization"}, &report_));
  HC_TRY(read_gltf_materials(file_, &materials_, &report_));
  std::vector<GltfNode> nodes;
  HC_TRY(list_nodes(file_, &nodes));
  HC_TRY(mesh_.corner_offsets.push_back(0));
  for (const GltfNode& each : nodes)
    HC_TRY(node(each));
  if (mesh_.face_count() == 0)
    return Status::error(StatusCode::kBadScene, fields_.path(), ": the scene has no faces");
  count_skipped();
  count_unnamed_faces(mesh_, &report_);
  return builder_.add_mesh(&mesh_, scene_materials_, 0, fields_.path());
}

Status GltfScene::node(const GltfNode& node) {
  if (const JsonValue* reference = node.value->find("camera"))
    HC_TRY(camera(node, *reference));
  if (node.value->find("skin") != nullptr)
    ++report_.skipped["skins (the mesh is taken as it is)"];
  if (const JsonValue* extensions = node.value->find("extensions"))
    if (extensions->find("KHR_lights_punctual") != nullptr)
      ++report_.skipped["point lights (KHR_lights_punctual)"];
  const JsonValue* reference = node.value->find("mesh");
  return reference == nullptr ? Status() : mesh(node, *reference);
}

Status GltfScene::camera(const GltfNode& node, const JsonValue& reference) {
  bool is_perspective = false;
  Camera camera;
  HC_TRY(read_gltf_camera(file_, node, reference, &is_perspective, &camera));
  if (!is_perspective || scene_.has_camera) {
    ++report_.skipped[is_perspective ? "further cameras" : "orthographic cameras"];
    return {};
  }
  scene_.camera = camera;
  scene_.has_camera = true;
  return {};
}

Status GltfScene::mesh(const GltfNode& node, const JsonValue& reference) {
  GltfFile::Item mesh;
  HC_TRY(file_.follow(reference, node.what + ".mesh", "meshes", &mesh));
  const double determinant = relative_determinant(node.placement);
  if (determinant == 0)
    return fields_.error(*node.value, node.what, ": the transforms down to it flatten its mesh");
  mirrors_ = determinant < 0;
  node_vertices_.clear();
  HC_TRY(group(node, mesh));
  const JsonValue* primitives = nullptr;
  HC_TRY(file_.required(*mesh.value, mesh.what, "primitives", &primitives));
  const std::string list = mesh.what + ".primitives";
  HC_TRY(fields_.kind(*primitives, list, Kind::kArray));
  for (std::size_t i = 0; i < primitives->items.size(); ++i)
    HC_TRY(primitive(node, primitives->items[i], list + "[" + std::to_string(i) + "]"));
  return {};
}

/// The group of a node's faces has the name of the node, else of the mesh, else its number.
Status GltfScene::group(const GltfNode& node, const GltfFile::Item& mesh) {
  std::string text;
  for (const auto& [value, what] :
       {std::pair(node.value, &node.what), std::pair(mesh.value, &mesh.what)}) {
    const JsonValue* name = value->find("name");
    if (name == nullptr || !text.empty())
      continue;
    HC_TRY(fields_.kind(*name, *what + ".name", Kind::kString));
    text = name->text;
    if (!text.empty())
      HC_TRY(fields_.check_name(*name, *what + ".name", text));
  }
  if (text.empty())
    text = "node_" + std::to_string(node.index);
  mesh_.groups.push_back({std::move(text), node.value->line});
  return {};
}

Status GltfScene::primitive(const GltfNode& node, const JsonValue& value, const std::string& what) {
  HC_TRY(fields_.kind(value, what, Kind::kObject));
  std::uint64_t mode = kTriangles;
  const JsonValue* mode_value = value.find("mode");
  if (mode_value != nullptr)
    HC_TRY(file_.whole_number(*mode_value, what + ".mode", &mode));
  if (mode > kFan)
    return fields_.error(*mode_value, what, ".mode: ", mode, " is not known; known are 0 to 6");
  if (mode < kTriangles) {
    ++report_.skipped["primitives of points or lines"];
    return {};
  }
  if (value.find("targets") != nullptr)
    ++report_.skipped["morph targets (the mesh is taken as it is)"];
  Vertices found;
  HC_TRY(vertices(node, value, what, &found));
  HC_TRY(indices(value, what, found.count));
  return triangles(value, what, mode, found.first);
}

/// Adds the vertices of a primitive to the mesh, unless one before it in the node has done so.
Status GltfScene::vertices(const GltfNode& node, const JsonValue& primitive,
                           const std::string& what, Vertices* vertices) {
  const JsonValue *attributes = nullptr, *reference = nullptr;
  const std::string list = what + ".attributes";
  HC_TRY(file_.required(primitive, what, "attributes", &attributes));
  HC_TRY(fields_.kind(*attributes, list, Kind::kObject));
  HC_TRY(file_.required(*attributes, list, "POSITION", &reference));
  for (const std::string& key : attributes->keys)
    if (key != "POSITION")
      attributes_.count(key);
  GltfFile::Item accessor;
  HC_TRY(file_.follow(*reference, list + ".POSITION", "accessors", &accessor));
  const auto [entry, is_new] = node_vertices_.try_emplace(accessor.index);
  if (is_new) {
    const std::size_t first = mesh_.vertices.size();
    HC_TRY(read_positions(&file_, accessor, &mesh_.vertices));
    const auto added = mesh_.vertices.span().subspan(first);
    report_.add_float_grid(added);
    if (!place_vertices(node.placement, added))
      return fields_.error(*node.value, node.what, ": its transform makes a coordinate too large");
    entry->second = {static_cast<std::uint32_t>(first), added.size()};
  }
  *vertices = entry->second;
  return {};
}

/// Fills indices_: given or, where none are, all in their order.
Status GltfScene::indices(const JsonValue& primitive, const std::string& what,
                          std::uint64_t vertex_count) {
  if (const JsonValue* reference = primitive.find("indices")) {
    GltfFile::Item accessor;
    HC_TRY(file_.follow(*reference, what + ".indices", "accessors", &accessor));
    return read_indices(&file_, accessor, vertex_count, &indices_);
  }
  HC_TRY(indices_.resize(vertex_count));
  for (std::uint32_t i = 0; i < vertex_count; ++i)
    indices_[i] = i;
  return {};
}

Status GltfScene::triangles(const JsonValue& primitive, const std::string& what, std::uint64_t mode,
                            std::uint32_t first_vertex) {
  const std::size_t count = indices_.size();
  if (count < 3 || (mode == kTriangles && count % 3 != 0))
    return fields_.error(primitive, what, ": ", count, " vertices make no whole triangles");
  const std::size_t triangle_count = mode == kTriangles ? count / 3 : count - 2;
  if (mesh_.face_count() + triangle_count > MeshLimits().faces)
    return fields_.error(primitive, what, ": more than ", MeshLimits().faces,
                         " faces with these: split the scene into several runs");
  std::uint32_t number = 0;
  HC_TRY(material(primitive, what, &number));
  const auto group = static_cast<std::uint32_t>(mesh_.groups.size() - 1);
  for (std::size_t i = 0; i < triangle_count; ++i) {
    std::array<std::size_t, 3> corners = corners_of(mode, i);
    if (mirrors_)
      std::swap(corners[1], corners[2]);
    for (const std::size_t corner : corners)
      HC_TRY(mesh_.corners.push_back(first_vertex + indices_[corner]));
    HC_TRY(mesh_.corner_offsets.push_back(mesh_.corners.size()));
    HC_TRY(mesh_.face_material.push_back(number));
    HC_TRY(mesh_.face_group.push_back(group));
  }
  return {};
}

/// The number of a primitive's material in the mesh.
Status GltfScene::material(const JsonValue& primitive, const std::string& what,
                           std::uint32_t* number) {
  GltfFile::Item item;
  item.index = kNoMaterial;
  if (const JsonValue* reference = primitive.find("material"))
    HC_TRY(file_.follow(*reference, what + ".material", "materials", &item));
  const auto [entry, is_new] =
      used_.try_emplace(item.index, static_cast<std::uint32_t>(mesh_.materials.size()));
  *number = entry->second;
  if (!is_new)
    return {};
  const SceneMaterial material = item.index == kNoMaterial
                                     ? material_of_unnamed_faces(scene_.band_count())
                                     : materials_[item.index];
  mesh_.materials.push_back({material.name, material.line});
  return builder_.add_material(material, &scene_materials_.emplace_back());
}

void GltfScene::count_skipped() {
  attributes_.add_to(&report_, [](std::string_view key) -> std::string_view {
    return key.starts_with("COLOR_") ? "vertex colours" : "vertex attributes";
  });
  std::size_t count = 0;
  if (file_.count("animations", &count).ok() && count != 0)
    report_.skipped["animations"] += count;
}

} // namespace

bool is_gltf_file(std::string_view path) {
  return has_extension(path, ".gltf") || has_extension(path, ".glb");
}

Status read_gltf_scene(const std::string& path, Scene* scene, ReadReport* report) {
  return without_exceptions(path, [&] { return GltfScene(path, scene, report).read(); });
}

} // namespace hemicube::radiosity
