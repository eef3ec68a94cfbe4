#pragma once

#include "tests/support/polygon_lists.h"

namespace hemicube::test {

/// One of two patches that exchange light, measured.
struct PairSide {
  Polygon corners;
  Vec3 normal, centre;
  double area = 0, radius = 0, perimeter = 0, coordinate = 0, longest = 0;

  PairSide(const PatchSet& patches, std::uint32_t patch);
};

/// What the rounding of coordinates may move the exchange area by. A corner is known to `r`, a
/// point of the plane through a polygon to r (1 + reach / width). Who moves an area by that much
/// moves the contour integral (1 / 2 pi) of ln r by at most that much of 1 / r along both contours:
/// perimeter * (1 + ln(perimeter / r)) / pi. Far apart the kernel itself says less: it changes by
/// 4 / (pi distance^3) per length.
double rounding_of(const PairSide& p, const PairSide& q);

/// Whether one lies in the plane of the other as far as rounding tells. Then what they exchange may
/// be nothing, or, if they face each other, all.
bool lie_in_one_plane(const PairSide& p, const PairSide& q);

/// Whether the spheres around them do not meet: what one sees of the other then changes slowly.
bool are_well_apart(const PairSide& p, const PairSide& q);

} // namespace hemicube::test
