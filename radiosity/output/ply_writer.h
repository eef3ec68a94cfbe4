#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/file_set.h"
#include "radiosity/scene/scene.h"

#include <span>
#include <string_view>

namespace hemicube::radiosity {

/// Writes the mesh with its light as binary little-endian PLY. Vertices: float x,y,z in scene
/// units; float radiosity_BAND in W/m^2 for each band (radiosity_NUMBER if a band's name is not a
/// plain word); uchar red,green,blue, the display colour that viewers show. Corners with equal
/// position and light share a vertex. Faces: the corners of patch k in order, and int patch = k.
/// @param corner_radiosity  from vertex_radiosities()
/// @param exposure          as for a picture: display white = 1 / exposure in W/(m^2 sr)
/// @return kIo
Status write_ply(FileSet* files, std::string_view name, const Scene& scene, const PatchSet& patches,
                 std::span<const float> corner_radiosity, double exposure);

} // namespace hemicube::radiosity
