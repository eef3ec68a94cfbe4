#pragma once

#include "radiosity/output/corner_vertices.h"
#include "radiosity/output/file_set.h"
#include "radiosity/scene/scene.h"

#include <string_view>

namespace hemicube::radiosity {

/// What the red, green and blue of a PLY file are. Viewers take floats for 0..255 and show them
/// black; programs that compute with colours take bytes for all there is.
enum class PlyColours {
  kDisplay, ///< uchar, for viewers: exposed and encoded as in the display picture
  kRadiance ///< float, for programs: linear radiance L = B / pi in W/(m^2 sr)
};

/// Writes the mesh with its light as binary little-endian PLY. Vertices: float x,y,z in metres;
/// float radiosity_BAND in W/m^2 for each band (radiosity_NUMBER if a band's name is not a plain
/// word); red,green,blue. Faces: the corners of patch k in order, and int patch = k.
/// @param exposure  as for a picture: display white = 1 / exposure in W/(m^2 sr)
/// @return kIo
Status write_ply(FileSet* files, std::string_view name, const Scene& scene, const PatchSet& patches,
                 const CornerVertices& vertices, PlyColours colours, double exposure);

} // namespace hemicube::radiosity
