#pragma once

#include "radiosity/cli/load_scene.h"
#include "radiosity/cli/table_option.h"

#include <span>

namespace hemicube::radiosity::cli {

/// --max-edge, --discontinuity and how far that goes: options of all commands that read a scene.
using MeshOption = TableOption<MeshOptions>;
std::span<const MeshOption> mesh_options();

/// Refuses what needs --discontinuity without it.
/// @return kInvalidArgument
Status check_mesh_options(const MeshOptions& options);

} // namespace hemicube::radiosity::cli
