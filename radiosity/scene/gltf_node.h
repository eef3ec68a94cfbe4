#pragma once

#include "radiosity/scene/gltf_file.h"
#include "radiosity/scene/placement.h"

#include <array>
#include <string>
#include <vector>

namespace hemicube::radiosity {

/// A node of a glTF scene, where it stands.
struct GltfNode {
  const JsonValue* value = nullptr;
  std::string what; ///< its name in messages, as in "nodes[3]"
  std::uint32_t index = 0;
  Placement placement; ///< from the node to the scene
};

/// Lists the nodes of the default scene, or of the first one if none is, each before its children,
/// in the order of the file.
/// @return as GltfFile; kBadScene also for a node that is reached twice, a transform that is none,
///         and a file without scenes
Status list_nodes(const GltfFile& file, std::vector<GltfNode>* nodes);

} // namespace hemicube::radiosity
