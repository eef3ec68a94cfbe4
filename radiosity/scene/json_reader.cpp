#include "radiosity/scene/json_reader.h"

#include "radiosity/scene/camera_problem.h"
#include "radiosity/scene/gltf_reader.h"
#include "radiosity/scene/json_fields.h"
#include "radiosity/scene/mesh_reader.h"
#include "radiosity/scene/placement.h"
#include "radiosity/scene/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostBands = 1024; // a number for all bands must not fill the memory
constexpr double kUnbounded = std::numeric_limits<double>::max();

class SceneFile {
public:
  SceneFile(const std::string& path, Scene* scene, ReadReport* report)
      : fields_(path), scene_(*scene), report_(*report), builder_(scene) {}

  Status read();

private:
  Status header(const JsonValue& root);
  Status units(const JsonValue& value);
  Status bands(const JsonValue* value);
  Status materials(const JsonValue& value);
  Status material(const std::string& name, const JsonValue& value);
  Status camera(const JsonValue& value);
  Status mesh(const JsonValue& value, const std::string& what);
  Status mesh_materials(const JsonValue& value, const std::string& what,
                        const std::string& mesh_path, const FileMesh& mesh,
                        std::vector<std::uint32_t>* numbers);
  Status placement(const JsonValue* transform, const std::string& what, Placement* placement) const;

  const JsonFields fields_;
  Scene& scene_;
  ReadReport& report_;
  SceneBuilder builder_;
  double metres_per_unit_ = 1;
  double max_edge_ = 0;
  bool bands_are_rgb_ = false;
  std::map<std::string, SceneMaterial> materials_;
};

Status SceneFile::read() {
  std::string text;
  HC_TRY(read_file(fields_.path(), &text));
  report_.add_file(fields_.path());
  JsonValue root;
  HC_TRY(parse_json(text, fields_.path(), &root));
  HC_TRY(fields_.object(root, "the scene",
                        {"format", "version", "units", "bands", "materials", "meshes", "max_edge",
                         "space_exitance", "camera"}));
  HC_TRY(header(root));
  if (const JsonValue* value = root.find("units"))
    HC_TRY(units(*value));
  HC_TRY(bands(root.find("bands")));
  if (const JsonValue* value = root.find("materials"))
    HC_TRY(materials(*value));
  if (const JsonValue* value = root.find("max_edge"))
    HC_TRY(fields_.positive_number(*value, "max_edge", &max_edge_));

  std::vector<double> space(scene_.band_count(), 0.0);
  if (const JsonValue* value = root.find("space_exitance"))
    HC_TRY(fields_.per_band(*value, "space_exitance", scene_.band_count(), kUnbounded, &space));
  HC_TRY(scene_.space_exitance.assign(space));
  if (const JsonValue* value = root.find("camera"))
    HC_TRY(camera(*value));

  const JsonValue* meshes = root.find("meshes");
  if (meshes != nullptr) {
    HC_TRY(fields_.kind(*meshes, "meshes", Kind::kArray));
    for (std::size_t i = 0; i < meshes->items.size(); ++i)
      HC_TRY(mesh(meshes->items[i], "mesh " + std::to_string(i)));
  }
  if (scene_.face_count() == 0)
    return Status::error(StatusCode::kBadScene, fields_.path(), ": the scene has no faces");
  return {};
}

Status SceneFile::header(const JsonValue& root) {
  const JsonValue* format = root.find("format");
  const JsonValue* version = root.find("version");
  if (format == nullptr || version == nullptr)
    return fields_.error(root, "the scene lacks the key '", format ? "version" : "format",
                         "': it must say \"format\": \"hemicube-scene\", \"version\": 1");
  std::string name;
  HC_TRY(fields_.name(*format, "format", &name));
  if (name != "hemicube-scene")
    return fields_.error(*format, "format ", in_quotes(name), " is not 'hemicube-scene'");
  double number = 0;
  HC_TRY(fields_.number(*version, "version", &number));
  if (number != 1)
    return fields_.error(*version, "version ", number, " is not known; this program reads 1");
  return {};
}

Status SceneFile::units(const JsonValue& value) {
  if (value.kind != Kind::kString)
    return fields_.positive_number(value, "units (metres per unit)", &metres_per_unit_);
  for (const auto& [name, metres] : {std::pair("m", 1.0), {"cm", 0.01}, {"mm", 0.001}})
    if (value.text == name) {
      metres_per_unit_ = metres;
      return {};
    }
  return fields_.error(value, "units ", in_quotes(value.text),
                       " are not known; known are m, cm, mm, or a number of metres per unit");
}

Status SceneFile::bands(const JsonValue* value) {
  std::vector<std::string> names = {"r", "g", "b"};
  const std::vector<std::string> rgb = names;
  if (value != nullptr) {
    HC_TRY(fields_.kind(*value, "bands", Kind::kArray));
    if (value->items.empty())
      return fields_.error(*value, "bands must name at least one band");
    if (value->items.size() > kMostBands)
      return fields_.error(*value, "more than ", kMostBands, " bands");
    names.clear();
    for (const JsonValue& item : value->items) {
      std::string name;
      HC_TRY(fields_.name(item, "a band's name", &name));
      for (const std::string& other : names)
        if (other == name)
          return fields_.error(item, "band ", in_quotes(name), " is named twice");
      names.push_back(name);
    }
  }
  bands_are_rgb_ = names == rgb;
  for (const std::string& name : names)
    HC_TRY(scene_.bands.add(name));
  return {};
}

Status SceneFile::materials(const JsonValue& value) {
  HC_TRY(fields_.kind(value, "materials", Kind::kObject));
  for (std::size_t i = 0; i < value.keys.size(); ++i)
    HC_TRY(material(value.keys[i], value.items[i]));
  return {};
}

Status SceneFile::material(const std::string& name, const JsonValue& value) {
  const std::string what = "material " + in_quotes(name);
  HC_TRY(fields_.check_name(value, "a material's name", name));
  HC_TRY(fields_.object(value, what, {"reflectance", "exitance", "radiance", "two_sided"}));
  const JsonValue* reflectance = value.find("reflectance");
  const JsonValue* exitance = value.find("exitance");
  const JsonValue* radiance = value.find("radiance");
  const JsonValue* two_sided = value.find("two_sided");
  if (exitance != nullptr && radiance != nullptr)
    return fields_.error(value, what, " has both exitance and radiance; give one of them");
  if (reflectance == nullptr && exitance == nullptr && radiance == nullptr)
    return fields_.error(value, what, " has neither reflectance nor exitance nor radiance");

  const std::uint32_t band_count = scene_.band_count();
  SceneMaterial& material = materials_[name];
  material.name = name;
  material.file = fields_.path();
  material.line = value.line;
  material.reflectance.assign(band_count, 0.0);
  material.exitance.assign(band_count, 0.0);
  if (reflectance != nullptr)
    HC_TRY(fields_.per_band(*reflectance, what + ": reflectance", band_count, 1,
                            &material.reflectance));
  if (exitance != nullptr)
    HC_TRY(fields_.per_band(*exitance, what + ": exitance", band_count, kUnbounded,
                            &material.exitance));
  if (radiance != nullptr) {
    HC_TRY(fields_.per_band(*radiance, what + ": radiance", band_count, kUnbounded,
                            &material.exitance));
    for (double& band : material.exitance) {
      const double exitance_of_band = kPi * band;
      if (!std::isfinite(exitance_of_band))
        return fields_.error(*radiance, what, ": radiance ", band, " is too large");
      band = exitance_of_band;
    }
  }
  if (two_sided != nullptr)
    HC_TRY(fields_.boolean(*two_sided, what + ": two_sided", &material.two_sided));
  return {};
}

Status SceneFile::camera(const JsonValue& value) {
  Camera& camera = scene_.camera;
  HC_TRY(fields_.object(value, "camera",
                        {"position", "target", "up", "vertical_field_of_view", "width", "height"}));
  const JsonValue* position = value.find("position");
  const JsonValue* target = value.find("target");
  if (position == nullptr || target == nullptr)
    return fields_.error(value, "camera lacks the key '", position ? "target" : "position", "'");
  HC_TRY(fields_.vector(*position, "camera: position", &camera.position));
  HC_TRY(fields_.vector(*target, "camera: target", &camera.target));
  camera.position *= metres_per_unit_;
  camera.target *= metres_per_unit_;
  if (const JsonValue* up = value.find("up"))
    HC_TRY(fields_.vector(*up, "camera: up", &camera.up));
  if (const JsonValue* angle = value.find("vertical_field_of_view")) {
    double& degrees = camera.vertical_field_of_view;
    HC_TRY(fields_.positive_number(*angle, "camera: vertical_field_of_view", &degrees));
    if (degrees >= 180)
      return fields_.error(*angle, "camera: vertical_field_of_view must be less than 180, not ",
                           degrees);
  }
  if (const JsonValue* width = value.find("width"))
    HC_TRY(fields_.pixels(*width, "camera: width", &camera.width));
  if (const JsonValue* height = value.find("height"))
    HC_TRY(fields_.pixels(*height, "camera: height", &camera.height));
  scene_.has_camera = true;
  const std::string_view problem = camera_problem(camera);
  return problem.empty() ? Status() : fields_.error(value, "camera: ", problem);
}

Status SceneFile::mesh(const JsonValue& value, const std::string& what) {
  HC_TRY(fields_.object(value, what, {"file", "transform", "material", "max_edge"}));
  const JsonValue* file = value.find("file");
  if (file == nullptr)
    return fields_.error(value, what, " lacks the key 'file'");
  std::string name;
  HC_TRY(fields_.name(*file, what + ": file", &name));
  if (is_gltf_file(name))
    return fields_.error(*file, what, ": file ", in_quotes(name),
                         " is a scene of its own, with materials and transforms: solve it alone");
  if (!is_mesh_file(name))
    return fields_.error(*file, what, ": file ", in_quotes(name), " is not named ",
                         kMeshExtensions);
  Placement place;
  HC_TRY(placement(value.find("transform"), what, &place));
  double max_edge = max_edge_;
  if (const JsonValue* edge = value.find("max_edge"))
    HC_TRY(fields_.positive_number(*edge, what + ": max_edge", &max_edge));

  const auto folder = std::filesystem::path(fields_.path()).parent_path();
  const std::string mesh_path = (folder / name).lexically_normal().string();
  if (const std::string why = why_no_file(mesh_path); !why.empty())
    return fields_.error(*file, what, ": file ", in_quotes(name), why, " (looked for ", mesh_path,
                         ")");
  FileMesh mesh;
  HC_TRY(read_mesh(mesh_path, &mesh, &report_));
  std::vector<std::uint32_t> numbers;
  HC_TRY(mesh_materials(value, what, mesh_path, mesh, &numbers));
  if (!place_mesh(place, &mesh))
    return fields_.error(value, what, ": transform and units make a coordinate too large");
  return builder_.add_mesh(&mesh, numbers, max_edge,
                           fields_.path() + ":" + std::to_string(value.line));
}

/// Finds what the materials of a mesh are, and their numbers in the scene.
Status SceneFile::mesh_materials(const JsonValue& value, const std::string& what,
                                 const std::string& mesh_path, const FileMesh& mesh,
                                 std::vector<std::uint32_t>* numbers) {
  if (const JsonValue* material = value.find("material")) {
    std::string name;
    HC_TRY(fields_.name(*material, what + ": material", &name));
    const auto entry = materials_.find(name);
    if (entry == materials_.end())
      return fields_.error(*material, what, ": material ", in_quotes(name),
                           " is not among the materials of this file");
    numbers->resize(mesh.materials.size());
    for (std::uint32_t& number : *numbers)
      HC_TRY(builder_.add_material(entry->second, &number));
    return {};
  }
  count_unnamed_faces(mesh, &report_);
  MtlLibrary library;
  bool library_is_read = false;
  for (const FileMesh::Name& use : mesh.materials) {
    const auto entry = materials_.find(use.text);
    SceneMaterial material;
    if (entry != materials_.end()) {
      material = entry->second;
    } else if (use.text.empty()) {
      material = material_of_unnamed_faces(scene_.band_count());
    } else if (!bands_are_rgb_) {
      return error_at(mesh_path, use.line, "material ", in_quotes(use.text),
                      " is used by a face, but is not among the materials of ", fields_.path(),
                      " (material libraries are read for the bands r, g, b only)");
    } else {
      if (!library_is_read)
        HC_TRY(read_libraries(mesh_path, mesh, &library, &report_));
      library_is_read = true;
      HC_TRY(material_from_library(mesh_path, use, library, &material));
    }
    HC_TRY(builder_.add_material(material, &numbers->emplace_back()));
  }
  return {};
}

Status SceneFile::placement(const JsonValue* transform, const std::string& what,
                            Placement* placement) const {
  placement->metres_per_unit = metres_per_unit_;
  if (transform == nullptr)
    return {};
  std::vector<double> matrix;
  HC_TRY(fields_.numbers(*transform, what + ": transform", 16, &matrix));
  if (matrix[12] != 0 || matrix[13] != 0 || matrix[14] != 0 || matrix[15] != 1)
    return fields_.error(*transform, what, ": transform must end in the row 0 0 0 1");
  placement->has_transform = true;
  std::copy_n(matrix.begin(), 12, placement->rows.begin());
  if (relative_determinant(*placement) == 0)
    return fields_.error(*transform, what, ": transform is singular: it flattens the mesh");
  return {};
}

} // namespace

Status read_json_scene(const std::string& path, Scene* scene, ReadReport* report) {
  return without_exceptions(path, [&] { return SceneFile(path, scene, report).read(); });
}

} // namespace hemicube::radiosity
