#pragma once

#include "radiosity/form_factor/shaft.h"
#include "raster/memory.h"

namespace hemicube::radiosity {

/// Form factors of a polygon from a point of a surface.
struct PointFormFactors {
  double whole = 0;   ///< as if nothing were in between
  double visible = 0; ///< of the parts that no blocker hides; 0 .. whole
};

/// What may hide a target: opaque from both sides.
struct Blocker {
  const Facet* facet = nullptr;
  bool in_target_plane = false; ///< hides what it covers of the target's own plane
};

/// Exact visibility from a point: clips away what blockers hide of a polygon. One per worker.
class VisiblePart {
public:
  /// @param eye, normal  the point and the unit normal of its surface
  /// @param target       its front is what counts: nothing where the eye is behind it
  /// @param blockers     at most kMaxBlockerCorners corners each
  /// @return kOutOfMemory
  /// Cost: grows with the number of pieces that the blockers cut the target into.
  Status find(const Vec3& eye, const Vec3& normal, const Facet& target,
              std::span<const Blocker> blockers, PointFormFactors* form_factors);

  static constexpr std::size_t kMaxBlockerCorners = 32;

private:
  /// Part of the target, and the first blocker it was not tested against.
  struct Piece {
    std::size_t first_corner, next;
  };

  Status push(const ConvexPolygon& polygon, std::size_t next);
  void pop(ConvexPolygon* polygon, std::size_t* next);

  Buffer<Piece> pieces_; ///< a stack
  Buffer<Vec3> corners_; ///< of the pieces, one after the other
};

} // namespace hemicube::radiosity
