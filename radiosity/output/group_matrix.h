#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/file_set.h"
#include "radiosity/scene/scene.h"

namespace hemicube::radiosity {

/// Writes the form factors of groups as a table: F_GH, the fraction of the light leaving all
/// patches of group G that arrives at those of group H, sum_{i in G} A_i sum_{j in H} F_ij / A_G,
/// if G sends the same from everywhere. Columns: group, area (m^2), one per group, space,
/// back_side; a line per group, groups in the scene's order, those without patches left out. F_GG
/// is what a group sends to itself.
/// @param matrix  row i belongs to patch i
/// @return kIo, kOutOfMemory
Status write_group_matrix(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                          const Scene& scene, const PatchSet& patches);

} // namespace hemicube::radiosity
