#pragma once

#include "radiosity/form_factor/convex_polygon.h"

namespace hemicube::radiosity {

/// One of two areas, prepared: corners relative to an origin near both, and what the choice of a
/// method asks about.
struct AreaShape {
  ConvexPolygon polygon;
  Vec3 normal{0, 0, 0};
  Vec3 centre{0, 0, 0};                  ///< mean of the corners
  Vec3 axis_u{0, 0, 0}, axis_v{0, 0, 0}; ///< half edges of a parallelogram
  double area = 0;
  double radius = 0;             ///< largest distance from centre to a corner
  double half_u = 0, half_v = 0; ///< largest half edge of its pieces along each parameter
  double bend = 0;               ///< how much the pieces' Jacobian varies, 0 (parallelogram) .. 1
  double tilt = 0;               ///< how much the height over the other's plane varies, 0 .. 1
  double height = 0;             ///< mean height of the corners over the other's plane
};

/// No lower bound for an angle.
inline constexpr double kAnySteepness = 1e300;

/// Heights over a plane below this are rounding of the coordinates.
/// @param coordinate  largest magnitude of a coordinate
/// @param reach       distance of the point from a corner of the polygon that spans the plane
/// @param width       of that polygon: its normal is no better than the coordinates over it
inline double height_tolerance(double coordinate, double reach, double width) noexcept {
  return 0x1p-49 * coordinate * (1 + reach / width);
}

/// The smallest Gauss-Legendre order whose error on a line is below `limit` of the value, for the
/// kernel (1 + tilt x) (1 + bend x) / r^4; 0 if there is none up to 16.
/// @param half       half the line's length
/// @param distance   from its middle to the nearest point of the other polygon, or less
/// @param steepness  1 / sin^2 of the smallest angle to a line to the other polygon, or more
/// @param bound      the rule's bound is added to it
int smallest_order(double half, double distance, double steepness, double tilt, double bend,
                   double limit, double* bound) noexcept;

/// Fills everything but tilt and height from polygon and normal.
void measure(AreaShape* shape) noexcept;

/// Fills tilt and height. @param plane  of the other area
void measure_height(AreaShape* shape, const Plane& plane) noexcept;

/// A tensor Gauss-Legendre rule for a pair: the orders along both parameters of both polygons.
/// The a-priori bound of its relative error is below what was asked.
struct TensorOrders {
  int p_u = 0, p_v = 0, q_u = 0, q_v = 0;
  double bound = 0;
  double evaluations = 0; ///< of the kernel; infinity if no rule is good enough
};

/// The cheapest orders for both polygons.
TensorOrders choose_orders(const AreaShape& p, const AreaShape& q, double relative_error) noexcept;

/// The cheapest orders for p alone, the other integral being exact; q_u = q_v = 0 and evaluations
/// counts points of p. @param distance  from p's centre to the nearest point of q
TensorOrders choose_outer_orders(const AreaShape& p, double distance,
                                 double relative_error) noexcept;

/// The exchange area in m^2 by quadrature over both polygons.
double tensor_exchange(const AreaShape& p, const AreaShape& q, const TensorOrders& orders) noexcept;

/// The exchange area in m^2 by quadrature over p of Lambert's form factor to q.
double outer_exchange(const AreaShape& p, const AreaShape& q, const TensorOrders& orders) noexcept;

/// The distance from a point to the nearest point of a convex polygon.
double distance_to_polygon(const Vec3& point, const AreaShape& shape) noexcept;

} // namespace hemicube::radiosity
