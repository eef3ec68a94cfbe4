#pragma once

#include "radiosity/scene/gltf_file.h"
#include "radiosity/scene/scene_builder.h"

#include <vector>

namespace hemicube::radiosity {

inline constexpr std::string_view kGltfEmissiveStrength = "KHR_materials_emissive_strength";

/// Reads all materials of a glTF file, in the bands r, g, b: the base colour factor is the
/// reflectance, the emissive factor times the emissive strength the exitance in W/m^2, double-sided
/// is two-sided. Names are unique: equal ones get a number, missing ones are "material_INDEX".
/// Counts in report->skipped what is not modelled: textures, transparency, other extensions.
/// @return as GltfFile; kBadScene for values out of range
Status read_gltf_materials(const GltfFile& file, std::vector<SceneMaterial>* materials,
                           ReadReport* report);

} // namespace hemicube::radiosity
