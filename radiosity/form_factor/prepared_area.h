#pragma once

#include "radiosity/form_factor/convex_polygon.h"

namespace hemicube::radiosity {

/// A convex planar polygon with what its pairs with all others ask for.
struct PreparedArea {
  std::span<const Vec3> corners; ///< not owned
  Vec3 normal{0, 0, 0};          ///< of length 1
  Vec3 centre{0, 0, 0};          ///< mean of the corners
  double area = 0;               ///< m^2
  double radius = 0;             ///< largest distance from centre to a corner
  double width = 0;              ///< area over longest edge
  double coordinate = 0;         ///< largest magnitude of a coordinate
  bool parallelogram = false;
  Vec3 half_u{0, 0, 0}, half_v{0, 0, 0}; ///< half edges, if it is one
  double length_u = 0, length_v = 0;     ///< of the half edges
};

/// Measures a polygon. @param corners  must outlive what is returned
PreparedArea prepare_area(std::span<const Vec3> corners, const Vec3& normal) noexcept;

} // namespace hemicube::radiosity
