#pragma once

#include "radiosity/form_factor/coplanar_cells.h"

namespace hemicube::radiosity {

/// Parts a mesh along straight lines of its edges, from each corner where the outline of coplanar
/// cells turns right on to the next outline or cut: what is left is convex where such lines exist,
/// as in every grid. Of the two lines that go on from the sides of a corner, the shorter.
/// @return kOutOfMemory
Status cut_at_reflex_corners(CoplanarMesh* mesh);

} // namespace hemicube::radiosity
