#pragma once

#include "radiosity/mesh/patch_set.h"

#include <vector>

namespace hemicube::test {

/// The corners of a patch.
inline std::vector<Vec3> polygon_of(const radiosity::PatchSet& mesh, std::uint32_t patch) {
  std::vector<Vec3> points;
  for (const std::uint32_t corner : mesh.corners_of(patch))
    points.push_back(mesh.vertices[corner]);
  return points;
}

} // namespace hemicube::test
