#pragma once

#include "radiosity/form_factor/prepared_area.h"

namespace hemicube::radiosity {

/// What two areas exchange when nothing is between them.
struct AreaIntegral {
  double value = 0; ///< A_p F_pq = A_q F_qp, m^2, >= 0
  double error = 0; ///< bound on |value - exact|, m^2: of the method, and an estimate of rounding
  double work = 0;  ///< roughly nanoseconds, by the method: a constant, not a measurement
};

/// The integral of cos cos' / (pi r^2) over two convex planar polygons, by the cheapest of three
/// methods that is good enough for the pair: Gauss-Legendre over both, Gauss-Legendre over one of
/// Lambert's form factor to the other, the integral of ln r over both contours.
/// @param p, q            3..64 corners, counter-clockwise about the normals; each counts only with
///                        its part in front of the other's plane; edges and corners may be shared
/// @param normal_p, normal_q  of length 1
/// @param relative_error  what the error may be of the value, 1e-12 .. 1e-2; `error` says what it
/// is
/// @return exactly 0 for areas in one plane up to rounding of the coordinates, or turned away
/// Deterministic: + - * / sqrt only. Exchanging p and q, or scaling both by a power of two, changes
/// no bit. Nothing is allocated.
AreaIntegral exchange_area(const ConvexPolygon& p, const Vec3& normal_p, const ConvexPolygon& q,
                           const Vec3& normal_q, double relative_error) noexcept;

/// The same, bit for bit, of polygons prepared once for many pairs.
AreaIntegral exchange_area(const PreparedArea& p, const PreparedArea& q,
                           double relative_error) noexcept;

} // namespace hemicube::radiosity
