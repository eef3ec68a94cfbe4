#pragma once

#include "radiosity/discontinuity/side_changes.h"
#include "radiosity/form_factor/shaft.h"

#include <algorithm>

namespace hemicube::radiosity {

/// The part of a segment, as shares of the way from its begin to its end.
struct SegmentPart {
  double begin = 0, end = 1;

  bool is_empty() const noexcept { return !(begin < end); }

  /// Keeps the part where a function that is linear along the segment is not negative.
  void keep_positive(double at_begin, double at_end) noexcept {
    if (at_begin < 0 && at_end < 0) {
      end = begin;
    } else if (at_begin < 0) {
      begin = std::max(begin, at_begin / (at_begin - at_end));
    } else if (at_end < 0) {
      end = std::min(end, at_begin / (at_begin - at_end));
    }
  }
};

/// The part of a segment over the inside of a facet, seen along its normal.
/// @param margin  metres: so far outside counts as inside
inline SegmentPart part_over(const Facet& facet, const Vec3& begin, const Vec3& end,
                             double margin) noexcept {
  SegmentPart part;
  const std::size_t count = facet.corners.size();
  for (std::size_t k = 0; k < count && !part.is_empty(); ++k) {
    const Vec3& corner = facet.corners[k];
    const Vec3 edge = facet.corners[k + 1 == count ? 0 : k + 1] - corner;
    const Vec3 inwards = glm::cross(facet.plane.normal, edge) / glm::length(edge);
    part.keep_positive(glm::dot(inwards, begin - corner) + margin,
                       glm::dot(inwards, end - corner) + margin);
  }
  return part;
}

/// The point where the border of a facet changes sides.
inline Vec3 point_of(const Facet& facet, const SideChange& change) noexcept {
  const Vec3& corner = facet.corners[change.corner];
  if (change.share == 0)
    return corner;
  const std::size_t next = change.corner + 1 == facet.corners.size() ? 0 : change.corner + 1;
  return corner + (facet.corners[next] - corner) * change.share;
}

} // namespace hemicube::radiosity
