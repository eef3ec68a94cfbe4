#pragma once

#include "radiosity/mesh/patch_set.h"

namespace hemicube::radiosity {

/// True if light goes on smoothly from one patch to a neighbour: the same material, and normals
/// within about 8 degrees. Across what is not one surface nothing is averaged or compared.
inline bool are_one_surface(const PatchSet& patches, std::uint32_t a, std::uint32_t b) noexcept {
  constexpr double kMinCosine = 0.99;
  return patches.material[a] == patches.material[b] &&
         glm::dot(patches.normal[a], patches.normal[b]) > kMinCosine;
}

} // namespace hemicube::radiosity
