#pragma once

#include "raster/math.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace hemicube::radiosity {

/// For tables of vertices by position that are looked up, never walked.
struct PositionHash {
  std::size_t operator()(const Vec3& position) const noexcept {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) // of 0 and -0 the same
      hash = (hash ^ (hash >> 32)) * 0x9e3779b97f4a7c15u +
             std::bit_cast<std::uint64_t>(position[axis] + 0.0);
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

} // namespace hemicube::radiosity
