#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/read_report.h"

#include <string>

namespace hemicube::radiosity {

/// Reads `v`, `f`, `g`, `usemtl` and `mtllib`; counts all other statements in report->skipped.
/// @return kBadScene `PATH:LINE: ...` for a file that is missing, no OBJ file, has no faces, or
/// says
///         something wrong: a coordinate that is not a finite number, a vertex index that is 0 or
///         names no vertex, a face with fewer than 3 corners; kIo; kOutOfMemory
Status read_obj(const std::string& path, FileMesh* mesh, ReadReport* report,
                const MeshLimits& limits = {});

} // namespace hemicube::radiosity
