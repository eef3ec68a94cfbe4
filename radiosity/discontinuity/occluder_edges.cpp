#include "radiosity/discontinuity/occluder_edges.h"

#include "radiosity/discontinuity/segment_clip.h"
#include "radiosity/mesh/weld.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Of directions of length 1: what is closer to edge-on has no width.
constexpr double kEdgeOn = 1e-9;

double distance_to_line(const Vec3& point, const Vec3& begin, const Vec3& end) {
  const Vec3 way = end - begin;
  return glm::length(glm::cross(point - begin, way)) / glm::length(way);
}

/// A direction across the way light goes.
struct Vec2 {
  double x, y;
};
double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// The directions from a corner into one face, seen along the light: less than half a turn.
struct Sector {
  Vec2 begin, end;

  /// The end does not belong to it.
  bool contains(const Vec2& way) const {
    return cross(begin, way) > -kEdgeOn && cross(way, end) > kEdgeOn;
  }
};

/// What faces cover of the directions around a point, seen along the light.
class Cover {
public:
  explicit Cover(const Vec3& way) : way_(way) {
    const Vec3 size(std::fabs(way.x), std::fabs(way.y), std::fabs(way.z));
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                      : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                           : Vec3(0, 0, 1);
    right_ = unit(glm::cross(axis, way));
    up_ = glm::cross(way, right_);
  }

  /// @param depth  metres: what is closer to an edge lies on it
  void add(const Facet& face, const Vec3& point, double depth) {
    const double facing = glm::dot(face.plane.normal, way_);
    if (std::fabs(facing) <= kEdgeOn)
      return;
    const std::size_t count = face.corners.size();
    std::size_t on = count, nearest = 0;
    double nearest_distance = glm::length(face.corners[0] - point);
    for (std::size_t k = 0; k < count; ++k) {
      const double distance = glm::length(face.corners[k] - point);
      if (distance < nearest_distance) {
        nearest = k;
        nearest_distance = distance;
      }
      if (distance_to_line(point, face.corners[k], face.corners[k + 1 == count ? 0 : k + 1]) <=
          depth)
        on = k;
    }
    if (on == count) {
      is_full_ = true;
      return;
    }
    const auto edge = [&](std::size_t k) {
      return flat(face.corners[k + 1 == count ? 0 : k + 1] - face.corners[k]);
    };
    const bool is_corner = nearest_distance <= depth;
    Vec2 begin = edge(is_corner ? nearest : on);
    const Vec2 before = edge(is_corner ? (nearest + count - 1) % count : on);
    Vec2 end{-before.x, -before.y};
    if (facing < 0)
      std::swap(begin, end);
    const Vec2 middle = flat(face.centre - point);
    sectors_.push_back({begin, middle});
    sectors_.push_back({middle, end});
  }

  bool is_partial() const {
    if (is_full_ || sectors_.empty())
      return false;
    for (const Sector& sector : sectors_) {
      bool goes_on = false;
      for (const Sector& other : sectors_)
        goes_on = goes_on || other.contains(sector.end);
      if (!goes_on)
        return true;
    }
    return false;
  }

private:
  Vec2 flat(const Vec3& direction) const {
    const Vec2 v{glm::dot(right_, direction), glm::dot(up_, direction)};
    const double length = std::sqrt(v.x * v.x + v.y * v.y);
    return length > 0 ? Vec2{v.x / length, v.y / length} : Vec2{1, 0};
  }

  Vec3 way_, right_, up_;
  std::vector<Sector> sectors_;
  bool is_full_ = false;
};

} // namespace

Status OccluderEdges::build(const SceneFacets& facets) {
  *this = {};
  facets_ = &facets;
  measure();
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = 0; face < facets.face_count(); ++face)
    if (facets.can_block(face))
      faces.push_back(face);
  const auto size = [&](std::uint32_t f) {
    return glm::length(facets.face(f).high - facets.face(f).low);
  };
  std::stable_sort(faces.begin(), faces.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return size(a) > size(b); });
  for (const std::uint32_t face : faces)
    add_edges(face);
  return add_corners();
}

void OccluderEdges::measure() {
  low_ = facets_->face(0).low;
  high_ = facets_->face(0).high;
  for (std::uint32_t f = 0; f < facets_->face_count(); ++f) {
    const Facet& face = facets_->face(f);
    low_ = glm::min(low_, face.low);
    high_ = glm::max(high_, face.high);
    double depth = 0;
    for (const Vec3& corner : face.corners)
      depth = std::max(depth, std::fabs(face.plane.side(corner)));
    depths_.push_back(facets_->tolerance() + 2 * depth);
  }
}

void OccluderEdges::add_edges(std::uint32_t f) {
  const auto corners = facets_->face(f).corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    OccluderEdge edge{f, corners[k], corners[k + 1 == corners.size() ? 0 : k + 1], {}};
    if (!(glm::length(edge.end - edge.begin) > 2 * depth(f)))
      continue;
    find_touching(&edge);
    edges_.push_back(std::move(edge));
  }
}

Status OccluderEdges::add_corners() {
  std::vector<Vec3> positions;
  Buffer<std::uint32_t> first;
  for (const OccluderEdge& edge : edges_)
    positions.push_back(edge.begin);
  HC_TRY(weld_positions(positions, &first));
  for (std::size_t k = 0; k < edges_.size(); ++k)
    if (first[k] == k) {
      OccluderCorner corner{edges_[k].face, positions[k], {}};
      find_touching(&corner);
      corners_.push_back(std::move(corner));
    }
  return {};
}

void OccluderEdges::find_touching(OccluderEdge* edge) const {
  const Vec3 &a = edge->begin, &b = edge->end;
  const double length = glm::length(b - a);
  const Vec3 margin(depth(edge->face));
  facets_->tree().for_each_in_box(
      glm::min(a, b) - margin, glm::max(a, b) + margin, [&](std::uint32_t f) {
        const Facet& face = facets_->face(f);
        const double reach = std::max(depth(f), depth(edge->face));
        const double side_a = face.plane.side(a), side_b = face.plane.side(b);
        SegmentPart part = part_over(face, a, b, reach);
        part.keep_positive(reach - side_a, reach - side_b);
        part.keep_positive(reach + side_a, reach + side_b);
        if (f == edge->face)
          part = {};
        else if (!((part.end - part.begin) * length > 4 * reach))
          return true;
        Touching touching{f, part.begin, part.end, false};
        const Vec3 from = a + part.begin * (b - a), to = a + part.end * (b - a);
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
          const Vec3 &c = face.corners[k],
                     &d = face.corners[k + 1 == face.corners.size() ? 0 : k + 1];
          touching.has_edge_there =
              touching.has_edge_there || (distance_to_line(from, c, d) <= 2 * reach &&
                                          distance_to_line(to, c, d) <= 2 * reach);
        }
        edge->touching.push_back(touching);
        return true;
      });
  std::sort(edge->touching.begin(), edge->touching.end(),
            [](const Touching& x, const Touching& y) { return x.face < y.face; });
}

void OccluderEdges::find_touching(OccluderCorner* corner) const {
  const Vec3& point = corner->position;
  const Vec3 margin(depth(corner->face));
  facets_->tree().for_each_in_box(point - margin, point + margin, [&](std::uint32_t f) {
    const Facet& face = facets_->face(f);
    const double reach = std::max(depth(f), depth(corner->face));
    if (std::fabs(face.plane.side(point)) <= reach &&
        !part_over(face, point, point, reach).is_empty())
      corner->touching.push_back({f, 0, 1, true});
    return true;
  });
  std::sort(corner->touching.begin(), corner->touching.end(),
            [](const Touching& x, const Touching& y) { return x.face < y.face; });
}

bool OccluderEdges::is_border(const OccluderEdge& edge, double at, const Vec3& apex,
                              const Vec3& normal) const {
  const Vec3 point = edge.begin + at * (edge.end - edge.begin);
  const double length = glm::length(edge.end - edge.begin);
  bool any_left = false, any_right = false;
  for (const Touching& touching : edge.touching) {
    if (!(touching.begin < at && at < touching.end))
      continue;
    const Facet& face = facets_->face(touching.face);
    if (touching.face < edge.face && touching.has_edge_there && facets_->can_block(touching.face))
      return false; // it has that edge itself
    const double doubt_far =
        1 + glm::length(apex - face.centre) / glm::length(face.high - face.low);
    if (std::fabs(face.plane.side(apex)) <= depth(touching.face) * doubt_far)
      continue; // edge-on
    for (const Vec3& corner : face.corners) {
      const Vec3 from_point = corner - point;
      const double side = glm::dot(normal, from_point);
      const double doubt = depth(touching.face) * (2 + glm::length(from_point) / length);
      any_left = any_left || side > doubt;
      any_right = any_right || side < -doubt;
    }
  }
  return any_left != any_right;
}

bool OccluderEdges::is_border(const OccluderCorner& corner, const Vec3& way) const {
  Cover cover(way);
  for (const Touching& touching : corner.touching)
    cover.add(facets_->face(touching.face), corner.position,
              std::max(depth(touching.face), depth(corner.face)));
  return cover.is_partial();
}

} // namespace hemicube::radiosity
