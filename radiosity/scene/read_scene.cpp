#include "radiosity/scene/read_scene.h"

#include "radiosity/scene/gltf_reader.h"
#include "radiosity/scene/json_reader.h"
#include "radiosity/scene/mesh_reader.h"
#include "radiosity/scene/scene_builder.h"
#include "radiosity/scene/text_cursor.h"

namespace hemicube::radiosity {
namespace {

Status read_mesh_scene(const std::string& path, Scene* scene, ReadReport* report) {
  for (const char* band : {"r", "g", "b"})
    HC_TRY(scene->bands.add(band));
  HC_TRY(scene->space_exitance.resize(scene->band_count()));

  FileMesh mesh;
  HC_TRY(read_mesh(path, &mesh, report));
  count_unnamed_faces(mesh, report);
  MtlLibrary library;
  HC_TRY(read_libraries(path, mesh, &library, report));

  SceneBuilder builder(scene);
  std::vector<std::uint32_t> numbers;
  for (const FileMesh::Name& use : mesh.materials) {
    SceneMaterial material = material_of_unnamed_faces(scene->band_count());
    if (!use.text.empty())
      HC_TRY(material_from_library(path, use, library, &material));
    HC_TRY(builder.add_material(material, &numbers.emplace_back()));
  }
  return builder.add_mesh(&mesh, numbers, 0, path);
}

} // namespace

Status read_scene(const std::string& path, Scene* scene, ReadReport* report) {
  return without_exceptions(path, [&]() -> Status {
    Scene fresh;
    *report = {};
    if (is_mesh_file(path))
      HC_TRY(read_mesh_scene(path, &fresh, report));
    else if (is_gltf_file(path))
      HC_TRY(read_gltf_scene(path, &fresh, report));
    else if (has_extension(path, ".json"))
      HC_TRY(read_json_scene(path, &fresh, report));
    else
      return Status::error(StatusCode::kBadScene, path,
                           ": a scene is read from a file named .json, .gltf, .glb, ",
                           kMeshExtensions);
    *scene = std::move(fresh);
    return {};
  });
}

} // namespace hemicube::radiosity
