#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/scene.h"

#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// patches.csv: one line a patch,
///   patch,face,parent,material,area,cx,cy,cz,nx,ny,nz
/// then per band b reflectance_b,exitance_b,irradiance_b,radiosity_b. Numbers read back bit for
/// bit; material is its name; an irradiance that was not computed is an empty field.
std::string patch_table(const Scene& scene, const PatchSet& patches, const Solution& solution);

/// Reads such a table back. It must have been written for this very mesh: the same bands, and per
/// patch the same face, parent, material, area, centre and normal.
/// @param file      the name messages use
/// @param solution  receives reflectance, exitance, irradiance and radiosity; its other arrays are
/// empty
/// @return kBadScene `FILE:LINE: ...`; kOutOfMemory
Status read_patch_table(std::string_view text, const std::string& file, const Scene& scene,
                        const PatchSet& patches, Solution* solution);

} // namespace hemicube::radiosity
