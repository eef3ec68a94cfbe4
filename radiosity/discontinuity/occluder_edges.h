#pragma once

#include "radiosity/form_factor/scene_facets.h"

#include <vector>

namespace hemicube::radiosity {

/// A face that a point or a part of an edge lies on, with its inside or its border.
struct Touching {
  std::uint32_t face = 0;
  double begin = 0, end = 1;   ///< which part of the edge
  bool has_edge_there = false; ///< one of its own edges runs along it
};

/// An edge of a face that can hide something.
struct OccluderEdge {
  std::uint32_t face = 0;
  Vec3 begin{0, 0, 0}, end{0, 0, 0};
  std::vector<Touching> touching; ///< the face itself, too; ascending
};

/// A corner of faces that can hide something; no two at one place.
struct OccluderCorner {
  std::uint32_t face = 0; ///< the first it is a corner of
  Vec3 position{0, 0, 0};
  std::vector<Touching> touching;
};

/// What of a scene casts borders of shadows: of the largest faces first.
class OccluderEdges {
public:
  /// @param facets  outlive this
  /// @return kOutOfMemory; what runs out in the C++ library's containers is thrown
  Status build(const SceneFacets& facets);

  const SceneFacets& facets() const noexcept { return *facets_; }
  const std::vector<OccluderEdge>& edges() const noexcept { return edges_; }
  const std::vector<OccluderCorner>& corners() const noexcept { return corners_; }
  const Vec3& low() const noexcept { return low_; } ///< of the box around the scene
  const Vec3& high() const noexcept { return high_; }

  /// Points closer than this to the plane of a face lie in it: warped faces have some depth.
  double depth(std::uint32_t face) const noexcept { return depths_[face]; }

  /// True if light that just passes an edge on one side is let through and on the other is not.
  /// @param at     0..1 along the edge
  /// @param apex   the point on the emitter that the light comes from
  /// @param normal of the plane through both, unit
  bool is_border(const OccluderEdge& edge, double at, const Vec3& apex, const Vec3& normal) const;

  /// True if light can pass a corner on its way along a direction and is blocked beside it.
  /// @param way  unit
  bool is_border(const OccluderCorner& corner, const Vec3& way) const;

private:
  void measure();
  void add_edges(std::uint32_t face);
  Status add_corners();
  void find_touching(OccluderEdge* edge) const;
  void find_touching(OccluderCorner* corner) const;

  const SceneFacets* facets_ = nullptr;
  std::vector<double> depths_; ///< [face]
  std::vector<OccluderEdge> edges_;
  std::vector<OccluderCorner> corners_;
  Vec3 low_{0, 0, 0}, high_{0, 0, 0};
};

} // namespace hemicube::radiosity
