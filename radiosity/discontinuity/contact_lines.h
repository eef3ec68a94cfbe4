#pragma once

#include "radiosity/discontinuity/discontinuity_line.h"
#include "radiosity/discontinuity/occluder_edges.h"

#include <vector>

namespace hemicube::radiosity {

/// Where faces stand on others, lie on them or go through them: light jumps there (D0).
/// @param lines  are appended, face by face; light = kJumps
/// Lines along the border of a face are left out: there is nothing to cut.
void find_contact_lines(const OccluderEdges& edges, std::vector<DiscontinuityLine>* lines);

} // namespace hemicube::radiosity
