#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/scene.h"

#include <string>

namespace hemicube::radiosity {

/// groups.csv: one line per pair of group and material, in the order of their first patch,
///   group,material,patches,area
/// then per band b, in W: emitted_b = sum A E, absorbed_b = sum A (1 - rho) H, received_b = sum A
/// H. A sum over an irradiance that was not computed is an empty field. Sums run in patch order.
std::string group_table(const Scene& scene, const PatchSet& patches, const Solution& solution);

} // namespace hemicube::radiosity
