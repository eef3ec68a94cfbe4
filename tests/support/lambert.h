#pragma once

#include "raster/face_view.h"

#include <cstdint>
#include <span>
#include <vector>

/// Exact form factors of small receivers, and what a hemicube may make of them. libm allowed here.
namespace hemicube::test {

/// The part of a convex polygon on the positive side of the plane through `origin`
/// (Sutherland-Hodgman).
std::vector<Vec3> clipped(std::span<const Vec3> polygon, const Vec3& origin, const Vec3& normal);

/// The fraction of the hemisphere over a point (cosine-weighted) that an unoccluded polygon fills:
/// Lambert's formula on the polygon clipped at the horizon, 0 if the point sees its back.
/// @param normal  of the receiver, any length
double lambert_form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon);

/// The same seen past opaque convex blockers that lie wholly nearer than the polygon and do not
/// overlap as seen from the point: what each of them covers is cut out of the polygon and taken
/// away.
double blocked_form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon,
                           std::span<const std::vector<Vec3>> blockers);

/// How far the form factor that one hemicube measures may be from the exact one, wherever its
/// pixels fall: a row of pixels sees a convex polygon as one run, each of whose two ends is rounded
/// by at most half a pixel; and the lengths of the runs, sampled once a row, rise and fall once,
/// which costs at most half a row of the longest run at either side. So the error is at most one
/// pixel of the largest weight for every row and one for every column that the polygon touches, on
/// every face.
double aliasing_bound(const raster::View& view, std::span<const Vec3> polygon,
                      std::uint32_t resolution);

/// The same for any polygon and frame: all rows and columns of all faces, about 3.4 / resolution.
double largest_aliasing_bound(std::uint32_t resolution);

} // namespace hemicube::test
