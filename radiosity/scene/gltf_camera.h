#pragma once

#include "radiosity/scene/gltf_node.h"
#include "radiosity/scene/scene.h"

namespace hemicube::radiosity {

/// Reads the camera that a node carries, if it is a perspective one: 600 pixels high, as wide as
/// its aspect ratio says.
/// @param is_perspective  set; the camera is filled only then
Status read_gltf_camera(const GltfFile& file, const GltfNode& node, const JsonValue& reference,
                        bool* is_perspective, Camera* camera);

} // namespace hemicube::radiosity
