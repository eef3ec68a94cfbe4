#pragma once

#include "raster/math.h"

#include <cstddef>
#include <functional>

namespace hemicube::radiosity {

/// For tables of vertices by position that are looked up, never walked.
struct PositionHash {
  std::size_t operator()(const Vec3& position) const noexcept {
    std::size_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) // of 0 and -0 the same
      hash = hash * 0x9e3779b97f4a7c15u + std::hash<double>()(position[axis]);
    return hash;
  }
};

} // namespace hemicube::radiosity
