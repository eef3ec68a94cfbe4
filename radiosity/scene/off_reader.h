#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/read_report.h"

#include <string>

namespace hemicube::radiosity {

/// Reads the polygons of an OFF file (Geomview): text, in three dimensions, a vertex or a face a
/// line; counts lines with colours, normals and texture coordinates in report->skipped. The counts
/// may stand on the line of the keyword OFF or on the next one, with or without that of the edges;
/// the file must hold just what they say.
/// @param mesh  one material and one group, both ""
/// @return kBadScene `PATH:LINE: ...`; kIo; kOutOfMemory
/// OpenMesh's reader is not used: with a comment in the file it returns true and no vertices, and
/// colours behind a face make it lose the next one.
Status read_off(const std::string& path, FileMesh* mesh, ReadReport* report);

} // namespace hemicube::radiosity
