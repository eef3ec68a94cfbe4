#pragma once

#include "raster/math.h"
#include "raster/memory.h"
#include "raster/types.h"

#include <cstdint>

namespace hemicube::raster {

/// Convex planar polygons by index. Polygon p has the corners corner_offsets[p] ..
/// corner_offsets[p+1], at least 3, counter-clockwise seen from its front; its id is p. The arrays
/// belong to the caller and must outlive every use. Polygons that share an edge must share its
/// positions bit for bit.
struct Polygons {
  std::span<const Vec3> vertices;
  std::span<const std::uint32_t> corner_offsets; ///< [polygon count + 1]
  std::span<const std::uint32_t> corners;        ///< indices into vertices

  std::uint32_t count() const noexcept {
    return corner_offsets.empty() ? 0 : static_cast<std::uint32_t>(corner_offsets.size() - 1);
  }
};

/// The supporting plane of a polygon, computed from its vertex *set*: a polygon and its reversed or
/// rotated copy get the same bits.
struct Plane {
  Vec3 normal{0, 0, 0}; ///< Newell sum, not normalised; points to the back if `reversed`
  Vec3 point{0, 0, 0};  ///< mean of the vertices
  bool reversed = false;
};

/// True for planes of polygons with the same vertex set.
inline bool same_place(const Plane& a, const Plane& b) noexcept {
  return a.point == b.point && a.normal == b.normal;
}

/// Fills one plane per polygon.
Status compute_planes(const Polygons& polygons, Buffer<Plane>* planes);

} // namespace hemicube::raster
