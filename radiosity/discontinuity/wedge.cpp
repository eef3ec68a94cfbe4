#include "radiosity/discontinuity/wedge.h"

#include "radiosity/discontinuity/segment_clip.h"

#include <cmath>

namespace hemicube::radiosity {

double WedgeTracer::Hit::t_at(double at) const {
  // (t, w) runs straight from one end to the other: find where w = at * t.
  const double here = w[0] - at * t[0], there = w[1] - at * t[1];
  const double share = here == there ? 0.5 : here / (here - there);
  return t[0] + share * (t[1] - t[0]);
}

bool WedgeTracer::begin(const Wedge& wedge) {
  wedge_ = wedge;
  before_.clear();
  beyond_.clear();
  const Vec3 base = wedge.second - wedge.first;
  const Vec3 across = glm::cross(wedge.first, base);
  const double size = glm::length(across), tolerance = edges_.facets().tolerance();
  const double longest = std::max(glm::length(wedge.first), glm::length(wedge.second));
  const double shortest = std::min(glm::length(wedge.first), glm::length(wedge.second));
  // The triangle must be higher than what cannot be told from 0, from each of its sides.
  if (!(size > 16 * tolerance * std::max(longest, glm::length(base))))
    return false;
  normal_ = across / size;
  // t and w of a point x in the plane: dot(dual, x - apex).
  dual_t_ = glm::cross(base, normal_) / size;
  dual_w_ = glm::cross(normal_, wedge.first) / size;
  if (glm::dot(dual_t_, wedge.first) < 0) {
    dual_t_ = -dual_t_;
    dual_w_ = -dual_w_;
  }
  t_doubt_ = 16 * tolerance / shortest;
  return true;
}

/// Collects the faces that the wedge meets, before the border or beyond it.
void WedgeTracer::collect(bool before) {
  const Vec3 size = edges_.high() - edges_.low();
  const Vec3 margin(edges_.facets().tolerance());
  const double shortest = std::min(glm::length(wedge_.first), glm::length(wedge_.second));
  const double far = 2 * glm::length(size) / shortest;
  const double near_t = wedge_.begin_t(before);
  const double far_t = before ? near_t + 1 : near_t + far;
  ConvexPolygon area;
  for (const double t : {near_t, far_t}) {
    const bool is_apex = t == 0;
    area.append(wedge_.apex + t * (t == near_t ? wedge_.first : wedge_.second));
    if (!is_apex)
      area.append(wedge_.apex + t * (t == near_t ? wedge_.second : wedge_.first));
  }
  for (int axis = 0; axis < 3 && !area.empty(); ++axis) {
    Vec3 inwards(0);
    inwards[axis] = 1;
    area = clip(area, {edges_.low() - margin, inwards}, 0);
    area = area.empty() ? area : clip(area, {edges_.high() + margin, -inwards}, 0);
  }
  if (area.empty())
    return;
  Vec3 low = area.corners[0], high = low;
  for (const Vec3& corner : area.span()) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  std::vector<Hit>& hits = before ? before_ : beyond_;
  edges_.facets().tree().for_each_in_box(low - margin, high + margin, [&](std::uint32_t face) {
    Hit found;
    if (hit(face, before, &found))
      hits.push_back(found);
    return true;
  });
  // The tree has its own order; of faces at one place the first is hit.
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.face < b.face; });
}

bool WedgeTracer::hit(std::uint32_t number, bool before, Hit* hit) const {
  const Facet& face = edges_.facets().face(number);
  const std::size_t count = face.corners.size();
  const double depth = edges_.depth(number);
  // The segment that the face has in common with the plane of the wedge. A face with no more than
  // an edge there is seen edge-on, or touched.
  double side[OccluderFaces::kMostCorners];
  for (std::size_t k = 0; k < count; ++k) {
    side[k] = glm::dot(normal_, face.corners[k] - wedge_.apex);
    if (std::fabs(side[k]) <= depth)
      side[k] = 0;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (side[k] == 0 && side[k + 1 == count ? 0 : k + 1] == 0)
      return false;
  SideChange changes[2];
  if (!find_side_changes({side, count}, changes))
    return false;
  Vec3 ends[2];
  for (int e = 0; e < 2; ++e)
    ends[e] = point_of(face, changes[e]);
  for (int e = 0; e < 2; ++e) {
    hit->t[e] = glm::dot(dual_t_, ends[e] - wedge_.apex);
    hit->w[e] = glm::dot(dual_w_, ends[e] - wedge_.apex);
  }
  hit->face = number;
  // 0 <= u <= 1, and t in its range.
  const double sign = before && !wedge_.apex_emits ? -1 : 1, low = wedge_.begin_t(before);
  SegmentPart part;
  part.keep_positive(hit->t[0] - low - t_doubt_, hit->t[1] - low - t_doubt_);
  if (before)
    part.keep_positive(low + 1 - t_doubt_ - hit->t[0], low + 1 - t_doubt_ - hit->t[1]);
  part.keep_positive(sign * hit->w[0], sign * hit->w[1]);
  part.keep_positive(sign * (hit->t[0] - hit->w[0]), sign * (hit->t[1] - hit->w[1]));
  if (part.is_empty())
    return false;
  const Hit whole = *hit;
  for (int e = 0; e < 2; ++e) {
    const double share = e == 0 ? part.begin : part.end;
    hit->t[e] = whole.t[0] + share * (whole.t[1] - whole.t[0]);
    hit->w[e] = whole.w[0] + share * (whole.w[1] - whole.w[0]);
  }
  if (hit->u(0) > hit->u(1)) {
    std::swap(hit->t[0], hit->t[1]);
    std::swap(hit->w[0], hit->w[1]);
  }
  return hit->u(0) < hit->u(1);
}

void WedgeTracer::find_breaks(std::span<const double> given) {
  breaks_.assign({0.0, 1.0});
  breaks_.insert(breaks_.end(), given.begin(), given.end());
  for (const std::vector<Hit>* hits : {&before_, &beyond_})
    for (const Hit& hit : *hits)
      for (const int end : {0, 1})
        breaks_.push_back(hit.u(end));
  // Where one face goes through another, which of them is first changes.
  for (std::size_t i = 1; i < beyond_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Hit &a = beyond_[i], &b = beyond_[j];
      const double low = std::max(a.u(0), b.u(0)), high = std::min(a.u(1), b.u(1));
      if (!(low < high))
        continue;
      const double at_low = a.t_at(low) - b.t_at(low), at_high = a.t_at(high) - b.t_at(high);
      if (at_low * at_high >= 0)
        continue;
      // w a straight function of t on both: solve a0 + p da = b0 + q db.
      const double at = a.t[1] - a.t[0], aw = a.w[1] - a.w[0];
      const double bt = b.t[1] - b.t[0], bw = b.w[1] - b.w[0];
      const double det = at * bw - aw * bt;
      const double share = ((b.t[0] - a.t[0]) * bw - (b.w[0] - a.w[0]) * bt) / det;
      const double u = (a.w[0] + share * aw) / (a.t[0] + share * at);
      if (u > low && u < high)
        breaks_.push_back(u);
    }
  for (double& u : breaks_)
    u = std::min(std::max(u, 0.0), 1.0);
  std::sort(breaks_.begin(), breaks_.end());
}

bool WedgeTracer::is_hidden(double u) const {
  for (const Hit& hit : before_)
    if (hit.u(0) < u && u < hit.u(1))
      return true;
  return false;
}

const WedgeTracer::Hit* WedgeTracer::first_hit(double u) const {
  const Hit* first = nullptr;
  double first_t = 0;
  for (const Hit& hit : beyond_) {
    if (!(hit.u(0) < u && u < hit.u(1)))
      continue;
    const double t = hit.t_at(u);
    if (first == nullptr || t < first_t) {
      first = &hit;
      first_t = t;
    }
  }
  return first;
}

void WedgeTracer::append(const Hit& hit, double begin, double end,
                         std::vector<DiscontinuityLine>* lines) {
  const double u[2] = {std::max(begin, hit.u(0)), std::min(end, hit.u(1))};
  Vec3 ends[2];
  for (int e = 0; e < 2; ++e)
    ends[e] = wedge_.apex + hit.t_at(u[e]) * wedge_.direction(u[e]);
  const Vec3 way = wedge_.direction(0.5 * (u[0] + u[1]));
  const bool meets_front = glm::dot(edges_.facets().face(hit.face).plane.normal, way) < 0;
  DiscontinuityLine line{hit.face, meets_front, !meets_front, EdgeLight::kBends, ends[0], ends[1]};
  line.apex = wedge_.apex;
  for (int e = 0; e < 2; ++e)
    line.source[e] = wedge_.apex_emits ? wedge_.apex : wedge_.apex - wedge_.direction(u[e]);
  lines->push_back(line);
}

} // namespace hemicube::radiosity
