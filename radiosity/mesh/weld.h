#pragma once

#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>
#include <span>

namespace hemicube::radiosity {

/// Finds vertices at the same place: many files repeat a vertex for every face that uses it.
/// @param first  [vertex] the lowest vertex whose coordinates are the same (0 and -0 are)
/// @return kOutOfMemory
Status weld_positions(std::span<const Vec3> vertices, Buffer<std::uint32_t>* first);

} // namespace hemicube::radiosity
