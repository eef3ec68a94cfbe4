#pragma once

#include "radiosity/scene/file_mesh.h"

#include <array>
#include <span>

namespace hemicube::radiosity {

/// Where a mesh stands in the scene: an affine map, and then a change of unit.
struct Placement {
  bool has_transform = false;    ///< without one, coordinates keep their bits
  std::array<double, 12> rows{}; ///< the first three rows of the 4 x 4 matrix, row by row
  double metres_per_unit = 1;    ///< applied after the matrix
};

/// The largest magnitude of the three; NaN or infinity if one of them is.
double largest_component(const Vec3& v);

/// The determinant of the linear part with its rows brought to length 1: in [-1, 1], and 0 where
/// the map flattens the mesh up to rounding (below 1e-12) or is not finite. Its sign tells a
/// mirroring.
double relative_determinant(const Placement& placement);

/// Moves vertices.
/// @return false if a coordinate is no longer finite
bool place_vertices(const Placement& placement, std::span<Vec3> vertices);

/// Moves the vertices. A mirroring placement also reverses the corners of each face, from the
/// second on, so that fronts stay fronts.
/// @return false if a coordinate is no longer finite
bool place_mesh(const Placement& placement, FileMesh* mesh);

} // namespace hemicube::radiosity
