#pragma once

#include "raster/math.h"
#include "raster/types.h"

#include <cstdint>

namespace hemicube::raster {

/// Where from and how a set of polygons is looked at: an eye and a right-handed orthonormal frame.
/// For a hemicube axis_z is the receiver's normal; for a camera it is the viewing direction.
struct View {
  Vec3 eye{0, 0, 0};
  Vec3 axis_x{1, 0, 0};
  Vec3 axis_y{0, 1, 0};
  Vec3 axis_z{0, 0, 1};
  std::uint32_t skip = kNoItem; ///< the receiver: not drawn, nor polygons of the same vertices
  bool above_horizon = true;    ///< drop polygons below, or edge-on to, the plane axis_z = 0
  bool draw_backs = true;       ///< polygons seen from their back occlude
};

/// The faces of a hemicube. The window of a face shows the directions
///   kTop: x X + y Y + Z    kPlusX: x Y + y Z + X    kMinusX: -x Y + y Z - X
///                          kPlusY: -x X + y Z + Y   kMinusY: x X + y Z - Y
/// with X, Y, Z the axes of the view: axis permutations that keep orientation.
enum class Face : std::uint8_t { kTop, kPlusX, kMinusX, kPlusY, kMinusY };
inline constexpr int kFaceCount = 5;

/// A vector in the view's axes, as the face sees it: (right, up, forward).
inline Vec3 to_face(Face face, const Vec3& v) {
  switch (face) {
  case Face::kTop:
    return v;
  case Face::kPlusX:
    return {v.y, v.z, v.x};
  case Face::kMinusX:
    return {-v.y, v.z, -v.x};
  case Face::kPlusY:
    return {-v.x, v.z, v.y};
  case Face::kMinusY:
    return {v.x, v.z, -v.y};
  }
  return v;
}

/// The inverse of to_face.
inline Vec3 from_face(Face face, const Vec3& v) {
  switch (face) {
  case Face::kTop:
    return v;
  case Face::kPlusX:
    return {v.z, v.x, v.y};
  case Face::kMinusX:
    return {-v.z, -v.x, v.y};
  case Face::kPlusY:
    return {-v.x, v.z, v.y};
  case Face::kMinusY:
    return {v.x, -v.z, v.y};
  }
  return v;
}

/// Pixel centres on the plane forward = 1 of a face: pixel (i, j) looks along
/// (x0 + i dx, y0 + j dy, 1), 0 <= i < width, 0 <= j < height.
/// |x0 / dx| and |y0 / dy|, and with them the sizes, stay below 2^17: bounds of polygons are found
/// in single precision.
struct PixelGrid {
  std::int32_t width = 0, height = 0;
  double x0 = 0, dx = 0, y0 = 0, dy = 0;
};

/// The grid of a hemicube face of `resolution` pixels along the full edge (even): the whole square
/// for the top, its upper half (forward rows only, j = 0 at the horizon) for a side.
inline PixelGrid hemicube_grid(Face face, std::uint32_t resolution) {
  const double step = 2.0 / resolution;
  PixelGrid grid;
  grid.width = static_cast<std::int32_t>(resolution);
  grid.height = static_cast<std::int32_t>(face == Face::kTop ? resolution : resolution / 2);
  grid.x0 = -1.0 + 0.5 * step;
  grid.dx = step;
  grid.y0 = face == Face::kTop ? grid.x0 : 0.5 * step;
  grid.dy = step;
  return grid;
}

/// A rectangle of pixels of a grid, up to kMaxWindowSize along each side; drawn, read and cleared
/// at a time so that it stays in cache.
struct Window {
  std::int32_t x = 0, y = 0, width = 0, height = 0;
};

} // namespace hemicube::raster
