#include "radiosity/discontinuity/contact_lines.h"

#include "radiosity/discontinuity/segment_clip.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

class ContactFinder {
public:
  ContactFinder(const OccluderEdges& edges, std::uint32_t face,
                std::vector<DiscontinuityLine>* lines)
      : edges_(edges), number_(face), face_(edges.facets().face(face)), lines_(*lines) {}

  void run() {
    const double reach = edges_.depth(number_);
    std::vector<std::uint32_t> others;
    edges_.facets().tree().for_each_in_box(face_.low - Vec3(reach), face_.high + Vec3(reach),
                                           [&](std::uint32_t other) {
                                             if (other != number_)
                                               others.push_back(other);
                                             return true;
                                           });
    std::sort(others.begin(), others.end());
    for (const std::uint32_t other : others)
      add(other);
  }

private:
  void add(std::uint32_t number) {
    const Facet& other = edges_.facets().face(number);
    const double reach = edges_.depth(number_) + edges_.depth(number);
    std::vector<double> side;
    bool any_front = false, any_back = false;
    for (const Vec3& corner : other.corners) {
      const double s = face_.plane.side(corner);
      side.push_back(std::fabs(s) <= reach ? 0 : s);
      any_front = any_front || s > reach;
      any_back = any_back || s < -reach;
    }
    const std::size_t count = side.size();
    const bool is_coplanar = !any_front && !any_back;
    const bool on_front = any_front || is_coplanar, on_back = any_back || is_coplanar;
    if (any_front && any_back) {
      SideChange changes[2];
      if (find_side_changes(side, changes))
        add(point_of(other, changes[0]), point_of(other, changes[1]), reach, on_front, on_back);
      return;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = k + 1 == count ? 0 : k + 1;
      if (side[k] == 0 && side[next] == 0)
        add(other.corners[k], other.corners[next], reach, on_front, on_back);
    }
  }

  void add(const Vec3& begin, const Vec3& end, double reach, bool on_front, bool on_back) {
    const double length = glm::length(end - begin);
    // The inside alone: what runs along the border has no part there.
    const SegmentPart part = part_over(face_, begin, end, -reach);
    if (part.is_empty() || !((part.end - part.begin) * length > 4 * reach))
      return;
    lines_.push_back({number_, on_front, on_back, EdgeLight::kJumps,
                      begin + part.begin * (end - begin), begin + part.end * (end - begin)});
  }

  const OccluderEdges& edges_;
  std::uint32_t number_;
  const Facet& face_;
  std::vector<DiscontinuityLine>& lines_;
};

} // namespace

void find_contact_lines(const OccluderEdges& edges, std::vector<DiscontinuityLine>* lines) {
  for (std::uint32_t face = 0; face < edges.facets().face_count(); ++face)
    ContactFinder(edges, face, lines).run();
}

} // namespace hemicube::radiosity
