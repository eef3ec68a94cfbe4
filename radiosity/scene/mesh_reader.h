#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/read_report.h"

#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// What is_mesh_file knows, for messages.
inline constexpr std::string_view kMeshExtensions = ".obj, .ply, .off or .stl";

/// Whether the name of a file says that it holds polygons: kMeshExtensions, in any case.
bool is_mesh_file(std::string_view path);

/// Reads such a file.
/// @return as read_obj, read_ply, read_off and read_stl
Status read_mesh(const std::string& path, FileMesh* mesh, ReadReport* report);

} // namespace hemicube::radiosity
