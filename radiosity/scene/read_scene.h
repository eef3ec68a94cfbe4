#pragma once

#include "radiosity/scene/read_report.h"
#include "radiosity/scene/scene.h"

#include <string>

namespace hemicube::radiosity {

/// Reads a scene: a mesh file (Wavefront OBJ with its material libraries, PLY, OFF or STL), a glTF
/// file, or a JSON scene file (schema: scenes/README.md), told apart by the extension, in any case.
/// @param scene   replaced; left as it was on an error
/// @param report  replaced; on an error it tells of what was read until then
/// @return kBadScene with the message `FILE:LINE: what is wrong`; kIo if reading breaks off;
///         kOutOfMemory
/// Deterministic: coordinates are the nearest doubles to the decimals in the file.
Status read_scene(const std::string& path, Scene* scene, ReadReport* report);

} // namespace hemicube::radiosity
