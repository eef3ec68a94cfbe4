#include "radiosity/scene/scene_builder.h"

#include "radiosity/scene/text_cursor.h"

namespace hemicube::radiosity {

SceneMaterial material_of_unnamed_faces(std::uint32_t band_count) {
  SceneMaterial material;
  material.reflectance.assign(band_count, 0.5);
  material.exitance.assign(band_count, 0.0);
  return material;
}

void count_unnamed_faces(const FileMesh& mesh, ReadReport* report) {
  for (const std::uint32_t material : mesh.face_material)
    if (mesh.materials[material].text.empty())
      ++report->faces_without_material;
}

Status material_from_library(const std::string& obj_path, const FileMesh::Name& use,
                             const MtlLibrary& library, SceneMaterial* material) {
  const auto entry = library.find(use.text);
  if (entry == library.end())
    return error_at(obj_path, use.line, "material ", in_quotes(use.text),
                    " is used by a face, but no material library defines it");
  const MtlMaterial& found = entry->second;
  if (found.reflectance_line == 0 && found.exitance_line == 0)
    return error_at(found.file, found.line, "material ", in_quotes(use.text),
                    " is used by a face, but has neither Kd (reflectance) nor Ke (exitance)");
  material->name = use.text;
  material->file = found.file;
  material->line = found.line;
  material->reflectance.assign(found.reflectance.begin(), found.reflectance.end());
  material->exitance.assign(found.exitance.begin(), found.exitance.end());
  return {};
}

Status SceneBuilder::add_material(const SceneMaterial& material, std::uint32_t* index) {
  const auto [entry, is_new] = materials_.try_emplace(
      material.name, Definition{material.file, material.line, scene_.materials.size()});
  const Definition& first = entry->second;
  *index = first.index;
  if (!is_new) {
    if (first.file == material.file) // a file defines a name only once
      return {};
    return error_at(material.file, material.line, "material ", in_quotes(material.name),
                    " is defined twice, first at ", first.file, ":", first.line,
                    ", and the scene uses both: rename one");
  }
  HC_TRY(scene_.materials.add(material.name));
  HC_TRY(scene_.reflectance.append(material.reflectance));
  HC_TRY(scene_.exitance.append(material.exitance));
  return scene_.two_sided.push_back(material.two_sided ? 1 : 0);
}

Status SceneBuilder::add_mesh(FileMesh* mesh, std::span<const std::uint32_t> materials,
                              double max_edge, std::string_view place) {
  const std::size_t face_count = scene_.face_count() + mesh->face_count();
  const std::size_t vertex_count = scene_.vertices.size() + mesh->vertices.size();
  const MeshLimits limits;
  if (face_count > limits.faces || vertex_count > limits.vertices)
    return Status::error(StatusCode::kBadScene, place,
                         ": the scene is too large with this mesh: ", face_count, " faces (limit ",
                         limits.faces, "), ", vertex_count, " vertices (limit ", limits.vertices,
                         ")");

  for (std::uint32_t& material : mesh->face_material)
    material = materials[material];

  std::vector<std::uint32_t> groups;
  for (const FileMesh::Name& group : mesh->groups) {
    const auto [entry, is_new] = groups_.try_emplace(group.text, scene_.groups.size());
    if (is_new)
      HC_TRY(scene_.groups.add(group.text));
    groups.push_back(entry->second);
  }
  for (std::uint32_t& group : mesh->face_group)
    group = groups[group];

  if (max_edge > 0 || !scene_.face_max_edge.empty()) {
    HC_TRY(scene_.face_max_edge.resize(scene_.face_count(), 0.0));
    HC_TRY(scene_.face_max_edge.resize(face_count, max_edge));
  }
  return add_geometry(mesh);
}

/// The first mesh is moved; the others are appended, their numbers shifted.
Status SceneBuilder::add_geometry(FileMesh* mesh) {
  if (scene_.corner_offsets.empty()) {
    scene_.vertices.swap(mesh->vertices);
    scene_.corner_offsets.swap(mesh->corner_offsets);
    scene_.corners.swap(mesh->corners);
    scene_.face_material.swap(mesh->face_material);
    scene_.face_group.swap(mesh->face_group);
    return {};
  }
  const auto first_vertex = static_cast<std::uint32_t>(scene_.vertices.size());
  const std::uint64_t first_corner = scene_.corners.size();
  for (std::uint32_t& corner : mesh->corners)
    corner += first_vertex;
  for (std::uint64_t& offset : mesh->corner_offsets)
    offset += first_corner;
  HC_TRY(scene_.vertices.append(mesh->vertices.span()));
  HC_TRY(scene_.corner_offsets.append(mesh->corner_offsets.span().subspan(1)));
  HC_TRY(scene_.corners.append(mesh->corners.span()));
  HC_TRY(scene_.face_material.append(mesh->face_material.span()));
  return scene_.face_group.append(mesh->face_group.span());
}

} // namespace hemicube::radiosity
