#pragma once

#include "tests/support/polygon_lists.h"

/// Small scenes for rows of every rung.
namespace hemicube::test {

/// Two walls, a lamp and a table whose backs are seen, a lone triangle: nothing closes by chance,
/// nothing is alike.
PolygonList open_scene();

/// Two plates and a small one in between, of which the lower sees the back.
PolygonList tiny_scene();

PolygonList l_shaped();   ///< l_room, closed and not convex; coordinates are whole numbers
PolygonList t_vertices(); ///< t_vertex_room, closed and convex

/// Polygons of any shape and size across one another's planes.
PolygonList random_soup();

} // namespace hemicube::test
