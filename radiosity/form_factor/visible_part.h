#pragma once

#include "radiosity/form_factor/shaft.h"
#include "raster/memory.h"

namespace hemicube::radiosity {

/// What may hide a target: opaque from both sides.
struct Blocker {
  const Facet* facet = nullptr;
  std::uint32_t face = 0;       ///< of SceneFacets, that it is or belongs to
  bool in_target_plane = false; ///< hides what it covers of the target's own plane
};

/// What an eye cannot see because of a blocker: the points beyond the blocker's plane and inside
/// the planes through the eye and its edges. Relative to the eye.
struct Shadow {
  static constexpr std::size_t kMaxBlockerCorners = 32;

  struct Side {
    Vec3 normal; ///< inwards, unit
    double offset;
    double inside(const Vec3& from_eye) const noexcept {
      return glm::dot(normal, from_eye) + offset;
    }
  };

  int side_count = 0;  ///< 0: seen edge-on, nothing is hidden
  double distance = 0; ///< of the eye from the blocker's plane
  Side sides[kMaxBlockerCorners + 1];

  Shadow() noexcept {} // the sides stay unset
  /// @param blocker  at most kMaxBlockerCorners corners
  Shadow(const Vec3& eye, const Blocker& blocker) noexcept;
};

/// Form factors of a polygon from a point of a surface.
struct PointFormFactors {
  double whole = 0;   ///< as if nothing were in between
  double visible = 0; ///< of the parts in no shadow; 0 .. whole
};

/// Exact visibility from a point: clips away what is in shadow of a polygon. One per worker.
class VisiblePart {
public:
  /// @param eye, normal  the point and the unit normal of its surface
  /// @param target       its front is what counts: nothing where the eye is behind it
  /// @param shadows      of what may hide it from that eye
  /// @return kOutOfMemory
  /// Cost: grows with the number of pieces that the shadows cut the target into.
  Status find(const Vec3& eye, const Vec3& normal, const Facet& target,
              std::span<const Shadow* const> shadows, PointFormFactors* form_factors);

private:
  /// Part of the target, and the first shadow it was not tested against.
  struct Piece {
    std::size_t first_corner, next;
  };

  Status push(const ConvexPolygon& polygon, std::size_t next);
  void pop(ConvexPolygon* polygon, std::size_t* next);

  Buffer<Piece> pieces_; ///< a stack
  Buffer<Vec3> corners_; ///< of the pieces, one after the other, relative to the eye
};

} // namespace hemicube::radiosity
