#pragma once

#include "radiosity/form_factor/convex_polygon.h"

namespace hemicube::radiosity {

/// A sum over pairs of edges and what it may be off by.
struct ContourSum {
  double value = 0;     ///< m^2
  double error = 0;     ///< bound on the quadrature's part of the error, m^2
  double magnitude = 0; ///< of the terms that cancel, m^2; the rounding error is a few ulps of it
};

/// The exchange area of two convex polygons as an integral of ln r over both contours: closed form
/// for parallel edges, closed form inside and graded Gauss-Legendre outside for the others. Edges
/// may touch, cross in space and coincide. Lengths should be around 1, lest the logarithms cancel.
/// @param tolerance  the quadrature's error aimed at, m^2
/// Source: the contour form of Sparrow 1963, "A new and simpler formulation for radiative angle
/// factors".
ContourSum contour_exchange(const ConvexPolygon& p, const ConvexPolygon& q,
                            double tolerance) noexcept;

} // namespace hemicube::radiosity
