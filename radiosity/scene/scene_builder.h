#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/mtl_reader.h"
#include "radiosity/scene/scene.h"

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace hemicube::radiosity {

/// A material on its way into a Scene; checked by whoever read it.
struct SceneMaterial {
  std::string name;
  std::string file; ///< where it is defined; "" for the material of faces that name none
  std::uint64_t line = 0;
  std::vector<double> reflectance; ///< [band], 0..1
  std::vector<double> exitance;    ///< [band], W/m^2, >= 0
  bool two_sided = false;
};

/// What faces get that no usemtl covers: named "", reflectance 0.5, no exitance.
SceneMaterial material_of_unnamed_faces(std::uint32_t band_count);

/// Counts the faces that no usemtl covers.
void count_unnamed_faces(const FileMesh& mesh, ReadReport* report);

/// Takes a material that a face uses from the libraries of its OBJ file.
/// @param use  the name and the line of its usemtl
/// @return kBadScene at that line if no library defines it; at its newmtl if that says neither Kd
/// nor Ke
Status material_from_library(const std::string& obj_path, const FileMesh::Name& use,
                             const MtlLibrary& library, SceneMaterial* material);

/// Puts meshes together into one Scene.
class SceneBuilder {
public:
  /// @param scene  empty but for its bands; must outlive the builder
  explicit SceneBuilder(Scene* scene) : scene_(*scene) {}

  /// Fills the number of a material, and adds it to the scene if it is new. To be called for
  /// materials that faces use only, in the order of their first use.
  /// @return kBadScene if another definition has the same name
  Status add_material(const SceneMaterial& material, std::uint32_t* index);

  /// Adds the faces of a mesh, whose arrays are used up.
  /// @param materials  the scene's number of each of mesh->materials
  /// @param max_edge   for all its faces, metres; 0 = not subdivided
  /// @param place      FILE:LINE for the message when the scene gets too large (kBadScene)
  Status add_mesh(FileMesh* mesh, std::span<const std::uint32_t> materials, double max_edge,
                  std::string_view place);

private:
  Status add_geometry(FileMesh* mesh);

  Scene& scene_;
  struct Definition {
    std::string file;
    std::uint64_t line;
    std::uint32_t index;
  };
  // Only looked up, never iterated over: NameTable::find is linear, files may have 10^5 groups.
  std::unordered_map<std::string, Definition> materials_;
  std::unordered_map<std::string, std::uint32_t> groups_;
};

} // namespace hemicube::radiosity
