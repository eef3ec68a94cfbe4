#pragma once

#include "tests/fuzz/byte_reader.h"
#include "tests/support/polygon_lists.h"

#include <optional>

namespace hemicube::test {

/// A planar convex polygon of 3..14 corners, 2^-10 to 4 in size, around points of [-2, 2): shapes
/// of all kinds, slivers among them. It is planar but for the rounding of its coordinates.
Polygon decode_polygon(ByteReader* bytes);

/// A polygon that stands to another one as neighbours in a mesh do: at an angle across an edge or a
/// corner of it, in its plane, over it at any distance, turned over.
Polygon decode_neighbour(ByteReader* bytes, const Polygon& of);

/// The patches of polygons, one each.
/// @return nothing if there are none, or meshing would drop or cut one
std::optional<PatchSet> patches_if_kept(const PolygonList& polygons);

} // namespace hemicube::test
