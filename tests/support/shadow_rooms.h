#pragma once

#include "tests/support/scenes_shared.h"

/// Rooms with things that throw shadows, and sheets to cut.
namespace hemicube::test {

/// Every coordinate times factor.
Scene scaled(Scene scene, double factor);

/// Adds a box seen from outside. @param edges  from the corner, right-handed
void add_box(SceneBuilder* builder, std::uint32_t material, const Vec3& corner,
             const std::array<Vec3, 3>& edges);

/// A flat sheet of quads and triangles that share their edges, of irregular shape and turned at
/// random.
Scene crooked_sheet(std::uint32_t seed);

/// A closed room 4 x 3 x 2.5 with a lamp under the ceiling that shines down, and 1 to 4 boxes of
/// any size that stand on the floor or float, turned about the vertical or at random, and may go
/// through one another.
Scene random_box_room(std::uint32_t seed);

/// Whether something of the scene lies between two points. @param doubt  metres: what is as close
/// to a plane lies in it
bool is_hidden(const PatchSet& patches, const Vec3& from, const Vec3& to, double doubt);

/// Up to 6 points of a polygon that are farther than `margin` from its border.
std::vector<Vec3> inner_points(const std::vector<Vec3>& polygon, const Vec3& normal, double margin,
                               Random* random);

} // namespace hemicube::test
