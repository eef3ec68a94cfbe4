#pragma once

#include "radiosity/output/display_mesh.h"
#include "radiosity/output/file_set.h"

#include <string_view>

namespace hemicube::radiosity {

/// Writes a mesh as glTF 2.0 binary: one mesh, one primitive and one unlit, one-sided material
/// (KHR_materials_unlit) per material of the scene that has triangles; float POSITION in metres;
/// float COLOR_0, linear, exposed, 1 = display white, cut off there as the format demands; float
/// _RADIANCE, linear L = B / pi in W/(m^2 sr), whole; and the camera as a node "view".
/// @param exposure  as for a picture: display white = 1 / exposure in W/(m^2 sr)
/// @param version  of this program, for asset.generator
/// @return kInvalidArgument for a camera that shows nothing, for a mesh without triangles, or for
///         more than the 4 GiB that the format can hold: nothing is then written; kIo
Status write_glb(FileSet* files, std::string_view name, const Scene& scene, const DisplayMesh& mesh,
                 double exposure, const Camera& camera, std::string_view version);

/// Whether a file can be that large.
/// @param shown_as  the name messages use
/// @return kInvalidArgument
Status check_glb_size(std::string_view shown_as, std::uint64_t bytes);

} // namespace hemicube::radiosity
