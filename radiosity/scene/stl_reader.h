#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/read_report.h"

#include <string>

namespace hemicube::radiosity {

/// Reads the triangles of an STL file, text or binary. Each has vertices of its own: equal ones are
/// found where it matters. The order of the corners tells the front; normals are not used. Names
/// behind `solid` become groups.
/// @param mesh  one material, ""
/// @return kBadScene `PATH:LINE: ...`, of a binary file `PATH: byte N: ...`; kIo; kOutOfMemory
/// OpenMesh's reader is not used: it drops triangles with two equal corners without a word, after
/// which all others have other numbers.
Status read_stl(const std::string& path, FileMesh* mesh, ReadReport* report);

} // namespace hemicube::radiosity
