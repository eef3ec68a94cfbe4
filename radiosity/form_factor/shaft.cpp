#include "radiosity/form_factor/shaft.h"

#include "radiosity/elementary.h"

#include <cmath>

namespace hemicube::radiosity {

Facet Facet::of(std::span<const Vec3> corners, const Vec3& normal) noexcept {
  Facet facet;
  facet.corners = corners;
  facet.plane = {corners[0], normal};
  facet.low = facet.high = corners[0];
  Vec3 sum(0, 0, 0);
  for (const Vec3& corner : corners) {
    sum += corner - corners[0];
    facet.low = glm::min(facet.low, corner);
    facet.high = glm::max(facet.high, corner);
  }
  facet.centre = corners[0] + sum / static_cast<double>(corners.size());
  return facet;
}

bool Facet::has_in_front(const Facet& other, double tolerance) const noexcept {
  for (const Vec3& corner : other.corners)
    if (plane.side(corner) < -tolerance)
      return false;
  return true;
}

bool Facet::has_behind(const Facet& other, double tolerance) const noexcept {
  for (const Vec3& corner : other.corners)
    if (plane.side(corner) > tolerance)
      return false;
  return true;
}

namespace {

constexpr double kFlatAngle = 0x1p-12;

bool is_flat_over(const Facet& a, const Facet& b, double tolerance) {
  for (const Vec3& corner : b.corners) {
    const double height = max_number(std::fabs(a.plane.side(corner)) - tolerance, 0);
    const Vec3 apart = corner - a.centre;
    if (height * height > kFlatAngle * kFlatAngle * glm::dot(apart, apart))
      return false;
  }
  return true;
}

/// An edge of `a` has all of `b` on its outer side.
bool has_aside(const Facet& a, const Facet& b, double tolerance) {
  const std::size_t count = a.corners.size();
  for (std::size_t k = 0; k < count && count > 1; ++k) {
    const Vec3& from = a.corners[k];
    const Vec3 edge = a.corners[k + 1 == count ? 0 : k + 1] - from;
    const Vec3 inward = glm::cross(a.plane.normal, edge);
    const double inside = tolerance * glm::length(inward);
    bool is_aside = true;
    for (const Vec3& corner : b.corners)
      is_aside = is_aside && glm::dot(inward, corner - from) <= inside;
    if (is_aside)
      return true;
  }
  return false;
}

} // namespace

bool lie_side_by_side(const Facet& a, const Facet& b, double tolerance) noexcept {
  return is_flat_over(a, b, tolerance) && is_flat_over(b, a, tolerance) &&
         (has_aside(a, b, tolerance) || has_aside(b, a, tolerance));
}

Shaft::Shaft(const Facet& p, const Facet& q, double tolerance) noexcept
    : p_(p), q_(q), tolerance_(tolerance), low_(glm::min(p.low, q.low)),
      high_(glm::max(p.high, q.high)) {}

Shaft::Verdict Shaft::test(const Facet& blocker) noexcept {
  for (int axis = 0; axis < 3; ++axis)
    if (blocker.high[axis] < low_[axis] || blocker.low[axis] > high_[axis])
      return Verdict::kMisses;
  // Segments stay in front of both facets, and never meet a plane that both are on one side of.
  if (p_.has_behind(blocker, tolerance_) || q_.has_behind(blocker, tolerance_))
    return Verdict::kMisses;
  const bool p_front = blocker.has_in_front(p_, tolerance_);
  const bool q_front = blocker.has_in_front(q_, tolerance_);
  if (p_front && q_front)
    return Verdict::kMisses;
  const bool p_back = !p_front && blocker.has_behind(p_, tolerance_);
  const bool q_back = !q_front && blocker.has_behind(q_, tolerance_);
  if (p_back && q_back)
    return Verdict::kMisses;
  if (lie_side_by_side(p_, blocker, tolerance_) || lie_side_by_side(q_, blocker, tolerance_))
    return Verdict::kMisses;
  if (plane_count_ < 0)
    find_planes();
  for (int k = 0; k < plane_count_; ++k) {
    bool outside = true;
    for (const Vec3& corner : blocker.corners)
      outside = outside && planes_[k].side(corner) >= -tolerance_;
    if (outside)
      return Verdict::kMisses;
  }
  if ((p_front && q_back) || (p_back && q_front))
    if (blocks_all(blocker, p_front ? 1 : -1))
      return Verdict::kBlocksAll;
  return Verdict::kMayBlock;
}

/// The hull's part in the blocker's plane is that of the points where segments between corners
/// meet the plane: if the blocker holds them all, it holds the hull's part.
bool Shaft::blocks_all(const Facet& blocker, double p_sign) const noexcept {
  const std::size_t count = blocker.corners.size();
  for (const Vec3& a : p_.corners) {
    const double side_a = p_sign * blocker.plane.side(a);
    for (const Vec3& b : q_.corners) {
      const double side_b = p_sign * blocker.plane.side(b);
      if (!(side_a > tolerance_ && side_b < -tolerance_))
        return false;
      const Vec3 meets = a + (b - a) * (side_a / (side_a - side_b));
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3& from = blocker.corners[k];
        const Vec3 edge = blocker.corners[k + 1 == count ? 0 : k + 1] - from;
        if (glm::dot(glm::cross(blocker.plane.normal, edge), meets - from) < 0)
          return false;
      }
    }
  }
  return true;
}

void Shaft::find_planes() noexcept {
  plane_count_ = 0;
  add_planes(p_, q_);
  add_planes(q_, p_);
}

/// Planes through an edge of one facet and a corner of the other that have both behind them.
void Shaft::add_planes(const Facet& edges_of, const Facet& corners_of) noexcept {
  const std::size_t count = edges_of.corners.size();
  if (count < 2)
    return;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& from = edges_of.corners[k];
    const Vec3 edge = edges_of.corners[k + 1 == count ? 0 : k + 1] - from;
    for (const double turn : {1.0, -1.0}) {
      Vec3 normal(0, 0, 0);
      for (const Vec3& corner : corners_of.corners)
        if (normal == Vec3(0, 0, 0) || glm::dot(normal, corner - from) > 0)
          normal = glm::cross(edge, corner - from) * turn;
      // Most are not: lengths are compared squared until one is.
      const double square = glm::dot(normal, normal);
      const auto has_behind = [&](const Facet& facet) {
        for (const Vec3& corner : facet.corners) {
          const double side = glm::dot(normal, corner - from);
          if (side > 0 && side * side > tolerance_ * tolerance_ * square)
            return false;
        }
        return true;
      };
      if (square > 0 && plane_count_ < kMaxPlanes && has_behind(edges_of) && has_behind(corners_of))
        planes_[plane_count_++] = {from, normal / std::sqrt(square)};
    }
  }
}

} // namespace hemicube::radiosity
