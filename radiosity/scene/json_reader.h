#pragma once

#include "radiosity/scene/read_report.h"
#include "radiosity/scene/scene.h"

#include <string>

namespace hemicube::radiosity {

/// Reads a JSON scene file (schema: scenes/README.md) and the mesh and MTL files it names.
/// @param scene  empty; on an error it holds whatever was read so far
/// @return kBadScene `FILE:LINE: ...`, FILE being the one of the files that says something wrong;
/// kIo;
///         kOutOfMemory
Status read_json_scene(const std::string& path, Scene* scene, ReadReport* report);

} // namespace hemicube::radiosity
