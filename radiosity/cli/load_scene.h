#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/certificate.h"
#include "radiosity/scene/read_report.h"
#include "radiosity/scene/scene.h"

#include <string>
#include <vector>

namespace hemicube::radiosity::cli {

/// A scene with its mesh, and what was done to get there.
struct LoadedScene {
  Scene scene;
  PatchSet patches; ///< elements, once it was refined
  ReadReport read;
  MeshReport mesh;
};

/// Reads a scene and meshes it: patches, subdivision, back sides.
/// @param max_edge  metres, in the place of what the scene says; 0 = as the scene says
/// @param run       read_seconds and mesh_seconds are set
/// @return as read_scene and the mesh functions; kCancelled
Status load_scene(const std::string& path, double max_edge, LoadedScene* loaded, RunReport* run);

/// What was skipped and repaired, and how often: one line each, empty if nothing was.
std::vector<std::string> warnings(const LoadedScene& loaded);

} // namespace hemicube::radiosity::cli
