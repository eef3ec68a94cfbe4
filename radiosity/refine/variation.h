#pragma once

#include "radiosity/mesh/patch_set.h"

#include <span>
#include <vector>

namespace hemicube::radiosity {

/// How much radiosity varies within each element, judged by its neighbours on the same surface
/// (an edge in common across which light does not jump, the same material, normals within about
/// 8 degrees): the difference to a neighbour, over the way between their middles, times the size of
/// the element across the common edge. Of all neighbours and bands the largest, in units of
/// `scale`.
/// @param elements   T-vertices of refinement are corners on both sides (ElementTree::make_mesh)
/// @param radiosity  [element][band] W/m^2
/// @param scale      [band] W/m^2; a band with 0 does not count
/// @param variation  receives [element], >= 0; of one without a neighbour, what it reflects in
/// units
///                   of `scale`: nothing tells how that is spread
/// @return as build_half_edges
/// Deterministic: + - * / sqrt only.
Status find_variation(const PatchSet& elements, std::span<const double> radiosity,
                      std::span<const double> exitance, std::span<const double> scale,
                      std::vector<double>* variation);

} // namespace hemicube::radiosity
