#pragma once

#include "tests/support/scenes_shared.h"

namespace hemicube::test {

/// How many rooms an office has, and how finely it is meshed.
struct OfficePlan {
  int rooms_x, rooms_y, storeys;
  double cell; ///< metres: no patch is larger
};

/// Storeys of furnished rooms, 4.1 m x 5.3 m x 2.8 m, with walls 0.15 m thick and doors between
/// neighbours, some open and some shut: every surface closed and one-sided, most of it hidden from
/// any one patch. Walls are meshed on their own, so that they meet floors and door frames in
/// T-vertices; some of the furniture stands askew. What a room holds depends on its number alone:
/// an office with more rooms shows the same from inside of one.
Scene office(const OfficePlan& plan);

} // namespace hemicube::test
