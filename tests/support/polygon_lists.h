#pragma once

#include "tests/support/scenes_shared.h"

/// Polygons as lists of points, each with corners of its own: easy to move, turn and shuffle.
namespace hemicube::test {

using Polygon = std::vector<Vec3>;
using PolygonList = std::vector<Polygon>;

/// One patch per polygon, in order; no two share a vertex, so what hangs together does so by
/// position alone.
PatchSet patches_of(const PolygonList& polygons);
PolygonList list_of(const PatchSet& patches);

PolygonList moved(PolygonList polygons, double scale, const Vec3& offset);
/// x, y and z of each point along the axes of the frame.
PolygonList turned(PolygonList polygons, const std::array<Vec3, 3>& frame);
PolygonList shuffled(PolygonList polygons, std::uint32_t seed);
PolygonList reversed(PolygonList polygons);
PolygonList without(const PolygonList& polygons, std::initializer_list<int> removed);
void append(PolygonList* polygons, PolygonList more);

/// nx x ny rectangles that tile [low, high] of the plane z = 0, front towards +z.
PolygonList rectangle_grid(double low_x, double low_y, double high_x, double high_y, int nx,
                           int ny);
/// Every quad cut into two triangles along a diagonal of random choice.
PolygonList in_triangles(const PolygonList& polygons, std::uint32_t seed);

/// With corners on a circle of radius 1 around (2, 0, 1) in the plane z = 1.
Polygon regular(int corners);

} // namespace hemicube::test
