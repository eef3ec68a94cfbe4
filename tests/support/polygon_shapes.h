#pragma once

#include "tests/support/scenes_shared.h"

#include <array>
#include <vector>

/// Convex polygons, as corners.
namespace hemicube::test {

std::vector<Vec3> reversed(std::vector<Vec3> polygon);

/// The same polygon from another corner on.
std::vector<Vec3> turned(std::vector<Vec3> polygon, int corners);

/// An ellipse of any orientation by its corners. @param corners  3 .. 40
std::vector<Vec3> random_ngon(Random& random, int corners, const Vec3& centre, double size);

/// A square with one corner at a point, its normal along an axis, to either side.
std::vector<Vec3> axis_rectangle(Random& random, int axis, const Vec3& corner, double size);

/// The rectangle [x0, x1] x [y0, y1] at depth z, seen from its front from below, its outline cut
/// into `corners` >= 4 corners.
std::vector<Vec3> card(double x0, double x1, double y0, double y1, double z, int corners = 4);

/// The two parts of a convex polygon on either side of the line through two of its edges' points.
std::array<std::vector<Vec3>, 2> halves(const std::vector<Vec3>& polygon, double at);

} // namespace hemicube::test
