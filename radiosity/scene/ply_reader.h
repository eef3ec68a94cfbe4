#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/read_report.h"

#include <string>

namespace hemicube::radiosity {

/// Reads the polygons of a PLY file, text or binary: `x`, `y`, `z` of element `vertex`, of any
/// type, and `vertex_indices` (or `vertex_index`) of element `face`; counts all other elements and
/// properties in report->skipped. The file must hold just what its header says.
/// @param mesh  one material and one group, both ""
/// @return kBadScene `PATH:LINE: ...`, in the values of a binary file `PATH: byte N: ...`; kIo;
///         kOutOfMemory
/// OpenMesh's reader is not used: it returns true with fewer faces than the file has (a list before
/// the indices, a vertex named twice) and never returns from a header that breaks off; what would
/// have to be checked before it is the whole file.
Status read_ply(const std::string& path, FileMesh* mesh, ReadReport* report);

} // namespace hemicube::radiosity
