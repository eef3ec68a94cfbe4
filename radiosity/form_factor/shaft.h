#pragma once

#include "radiosity/form_factor/convex_polygon.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Something planar and convex that sees or blocks: corners, their plane, a box around them.
struct Facet {
  std::span<const Vec3> corners; ///< a single one for a point
  Plane plane;                   ///< normal of length 1, any origin in the plane
  Vec3 centre, low, high;

  /// @param normal  unit
  static Facet of(std::span<const Vec3> corners, const Vec3& normal) noexcept;

  /// True if no corner of `other` lies more than `tolerance` behind this facet's plane.
  bool has_in_front(const Facet& other, double tolerance) const noexcept;
  /// True if no corner of `other` lies more than `tolerance` in front of it.
  bool has_behind(const Facet& other, double tolerance) const noexcept;
};

/// True if two facets lie in one plane within 2^-12 radians, one beside the other. Neither hides
/// more of the other's hemisphere than about the square of that angle: the slightly warped pieces
/// of one wall need not be asked whether they occlude one another.
/// @param tolerance  metres
bool lie_side_by_side(const Facet& a, const Facet& b, double tolerance) noexcept;

/// What may lie between two facets: their convex hull. Source of the idea: Haines and Wallace
/// 1991, "Shaft culling for efficient ray-cast radiosity"; here with all supporting planes.
class Shaft {
public:
  enum class Verdict {
    kMisses,   ///< blocks no segment from one facet's front to the other's front
    kMayBlock, ///< could not be excluded
    kBlocksAll ///< blocks every such segment
  };

  /// @param p, q       outlive the shaft; each sees with its front
  /// @param tolerance  points closer than this to a plane lie in it, metres: the rounding of the
  ///                   coordinates
  Shaft(const Facet& p, const Facet& q, double tolerance) noexcept;

  const Vec3& low() const noexcept { return low_; }
  const Vec3& high() const noexcept { return high_; }

  /// @param blocker  opaque from both sides
  Verdict test(const Facet& blocker) noexcept;

private:
  void find_planes() noexcept;
  void add_planes(const Facet& edges_of, const Facet& corners_of) noexcept;
  bool blocks_all(const Facet& blocker, double p_sign) const noexcept;

  static constexpr int kMaxPlanes = 32;

  const Facet& p_;
  const Facet& q_;
  double tolerance_;
  Vec3 low_, high_;
  int plane_count_ = -1;     ///< -1: not asked for yet
  Plane planes_[kMaxPlanes]; ///< both facets behind each of them
};

} // namespace hemicube::radiosity
