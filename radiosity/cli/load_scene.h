#pragma once

#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/certificate.h"
#include "radiosity/scene/read_report.h"
#include "radiosity/scene/scene.h"

#include <string>
#include <vector>

namespace hemicube::radiosity::cli {

/// How a scene is meshed, but for what the light on it asks for.
struct MeshOptions {
  double max_edge = 0; ///< metres, in the place of what the scene says; 0 = as the scene says
  bool discontinuity = false;
  DiscontinuityLimits limits;
  const char* limit_given = nullptr; ///< an option that set one; null = none did
};

/// A scene with its mesh, and what was done to get there.
struct LoadedScene {
  Scene scene;
  PatchSet patches; ///< elements, once it was refined
  ReadReport read;
  MeshReport mesh;
  // Of MeshOptions::discontinuity.
  DiscontinuityReport discontinuities;
  std::vector<DiscontinuityLine> lines;
};

/// Reads a scene and meshes it: patches, subdivision, discontinuities, back sides.
/// @param run  read_seconds and mesh_seconds are set
/// @return as read_scene and the mesh functions; kCancelled
Status load_scene(const std::string& path, const MeshOptions& options, LoadedScene* loaded,
                  RunReport* run);

/// What was skipped and repaired, and how often: one line each, empty if nothing was.
std::vector<std::string> warnings(const LoadedScene& loaded);

} // namespace hemicube::radiosity::cli
