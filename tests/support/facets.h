#pragma once

#include "radiosity/form_factor/visible_part.h"
#include "tests/support/polygon_lists.h"

#include <vector>

/// Facets that own their corners, and visibility by brute force.
namespace hemicube::test {

/// A facet and what it points to. Moves, but does not copy: a copy would point to the original.
struct OwnedFacet {
  Polygon corners;
  radiosity::Facet facet;

  /// A polygon, counter-clockwise seen from its front.
  explicit OwnedFacet(Polygon polygon);
  /// A point of a surface. @param normal  any length
  OwnedFacet(const Vec3& point, const Vec3& normal);
  OwnedFacet(OwnedFacet&&) = default;
  OwnedFacet(const OwnedFacet&) = delete;
};

/// Whether a segment passes through a convex polygon.
enum class Crossing { kMisses, kCrosses, kTooCloseToSay };

/// @param margin  how close to the polygon's plane or edges is too close, metres
Crossing crossing(const Vec3& a, const Vec3& b, const radiosity::Facet& polygon, double margin);

/// A place in a convex polygon, evenly distributed; the only corner of a point.
Vec3 random_place(Random& random, const radiosity::Facet& facet);

/// The point of a parallelogram at u, v along its first and its last side, 0 .. 1.
Vec3 spot(const Polygon& parallelogram, double u, double v);

/// Form factors of a parallelogram from a point, by the kernel at the middles of n x n cells and a
/// ray to each: behind a blocker of its own plane, or beyond any other, nothing is seen.
radiosity::PointFormFactors sampled(const Vec3& eye, const Vec3& normal, const OwnedFacet& target,
                                    std::span<const radiosity::Blocker> blockers, int n);

/// VisiblePart for blockers.
radiosity::PointFormFactors visible_part(const Vec3& eye, const Vec3& normal,
                                         const radiosity::Facet& target,
                                         std::span<const radiosity::Blocker> blockers);

} // namespace hemicube::test
