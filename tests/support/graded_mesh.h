#pragma once

#include "tests/support/scenes_shared.h"

namespace hemicube::test {

/// Where a graded sheet lies: its point (0, 0) and its two sides, of any length and at any angle.
struct SheetPlace {
  Vec3 origin{0, 0, 0}, u{1, 0, 0}, v{0, 1, 0};
  Vec3 at(double x, double y) const { return origin + x * u + y * v; }
};

/// Adds the unit square, cut like a quadtree, to a scene: a square is cut in four while
/// splits(x, y, size) of its lower left corner and its size says so, down to 1/64. A square lists
/// the corners of smaller neighbours on its sides (hanging vertices) among its own.
/// @param material_of  of the square with that lower left corner and size
void add_graded_sheet(SceneBuilder* builder, const SheetPlace& place,
                      const std::function<bool(double, double, double)>& splits,
                      const std::function<std::uint32_t(double, double, double)>& material_of);

/// Cuts towards the middle of the left side, so that sizes next to each other differ twofold.
bool splits_gently(double x, double y, double size);
/// Cuts most within a small square, so that sizes next to each other differ up to eightfold.
bool splits_steeply(double x, double y, double size);
/// Cuts at random, the same on every machine.
std::function<bool(double, double, double)> splits_at_random(std::uint32_t seed);

} // namespace hemicube::test
