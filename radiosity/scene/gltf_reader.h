#pragma once

#include "radiosity/scene/read_report.h"
#include "radiosity/scene/scene.h"

#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// Whether the name of a file says that it is glTF: .gltf or .glb, in any case.
bool is_gltf_file(std::string_view path);

/// Reads a scene from a glTF 2.0 file: the triangles of the meshes of its default scene, or of its
/// first one, in the order of its nodes, their materials and the first perspective camera. What is
/// made of it: scenes/README.md.
/// @param scene  empty; on an error it holds whatever was read so far
/// @return kBadScene `PATH:LINE: JSON.path: ...`, LINE being that of the JSON, or `PATH: ...`; kIo;
///         kOutOfMemory
/// tinygltf is not used: it reads over values of the wrong kind without a word ("mesh": "0" is no
/// mesh), takes index 2^32 for 0, and overflows the stack on JSON that is nested deeply.
Status read_gltf_scene(const std::string& path, Scene* scene, ReadReport* report);

} // namespace hemicube::radiosity
