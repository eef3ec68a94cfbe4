#pragma once

#include "raster/math.h"

#include <span>

namespace hemicube::radiosity {

/// How coarse the coordinates of a mesh are that come from 32-bit floats, which are the further
/// apart the further they are from 0.
/// @return how far the largest coordinate is from the float before it, over the longest edge of the
///         box around the vertices; 0 if a coordinate is no such float, or the box a point
double float_grid_step(std::span<const Vec3> vertices);

} // namespace hemicube::radiosity
