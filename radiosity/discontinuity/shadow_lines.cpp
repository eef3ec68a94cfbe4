#include "radiosity/discontinuity/shadow_lines.h"

#include "radiosity/discontinuity/wedge.h"
#include "radiosity/form_factor/lambert.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Of an edge of the emitter: how far beside its corners light in its plane is followed from.
constexpr double kBeside = 0x1p-10;

class ShadowCaster {
public:
  ShadowCaster(const OccluderEdges& edges, const EmitterFace& emitter, std::uint64_t most_wedges,
               std::vector<DiscontinuityLine>* lines, ShadowLineReport* report)
      : edges_(edges), emitter_(emitter), most_wedges_(most_wedges), lines_(*lines),
        report_(*report), tracer_(edges) {}

  void run() {
    const std::size_t begin = lines_.size();
    const auto& edges = edges_.edges();
    const auto& corners = edges_.corners();
    for (std::size_t k = 0; k < emitter_.corners.size(); ++k)
      if (may_follow())
        cast_horizon(k);
    for (std::size_t i = 0; i < std::max(edges.size(), corners.size()); ++i) {
      for (const Vec3& corner : emitter_.corners)
        if (i < edges.size() && may_follow())
          cast(corner, edges[i]);
      for (std::size_t k = 0; k < emitter_.corners.size(); ++k)
        if (i < corners.size() && may_follow())
          cast(k, corners[i]);
    }
    for (std::size_t k = begin; k < lines_.size(); ++k)
      lines_[k].strength = strength(lines_[k]);
  }

private:
  bool may_follow() {
    if (report_.wedges < most_wedges_)
      return true;
    ++report_.wedges_skipped;
    return false;
  }

  /// Metres in front of the emitter, of a two-sided one on either side.
  double height(const Vec3& point) const {
    const double side = glm::dot(emitter_.normal, point - emitter_.corners[0]);
    return emitter_.two_sided ? std::fabs(side) : side;
  }

  void cast(const Vec3& corner, const OccluderEdge& edge) {
    const double depth = edges_.depth(edge.face);
    const double begin = height(edge.begin), end = height(edge.end);
    if (begin <= depth && end <= depth)
      return;
    breaks_.clear();
    for (const Touching& touching : edge.touching) {
      breaks_.push_back(touching.begin);
      breaks_.push_back(touching.end);
    }
    if ((begin > 0) != (end > 0))
      breaks_.push_back(begin / (begin - end));
    follow(Wedge::vertex_edge(corner, edge.begin, edge.end), [&](double u, const Vec3& normal) {
      return begin + u * (end - begin) > depth && edges_.is_border(edge, u, corner, normal);
    });
  }

  void cast(std::size_t k, const OccluderCorner& corner) {
    if (height(corner.position) <= edges_.depth(corner.face))
      return;
    const Vec3 &a = emitter_.corners[k],
               &b = emitter_.corners[k + 1 == emitter_.corners.size() ? 0 : k + 1];
    breaks_.clear();
    for (const Touching& touching : corner.touching) {
      const Plane& plane = edges_.facets().face(touching.face).plane;
      const double at_a = plane.side(a), at_b = plane.side(b);
      if ((at_a > 0) != (at_b > 0))
        breaks_.push_back(at_a / (at_a - at_b));
    }
    const Wedge wedge = Wedge::edge_vertex(a, b, corner.position);
    follow(wedge, [&](double u, const Vec3&) {
      return edges_.is_border(corner, unit(wedge.direction(u)));
    });
  }

  /// Light sets where the plane of the emitter is crossed, as seen from its corners.
  void cast_horizon(std::size_t k) {
    const Vec3& corner = emitter_.corners[k];
    const Vec3 x = kBeside * (emitter_.corners[(k + 1) % emitter_.corners.size()] - corner);
    const Vec3 y = glm::cross(emitter_.normal, x);
    const Vec3 around[5] = {x, y, -x, -y, x};
    breaks_.clear();
    for (int quarter = 0; quarter < 4; ++quarter)
      follow({corner, around[quarter], around[quarter + 1], true},
             [](double, const Vec3&) { return true; });
  }

  template <typename IsBorder> void follow(const Wedge& wedge, IsBorder is_border) {
    report_.wedges += tracer_.trace(wedge, breaks_, is_border, &lines_);
  }

  /// What the emitter sends to the middle of a line if nothing is in between, W/m^2.
  double strength(const DiscontinuityLine& line) const {
    const Facet& face = edges_.facets().face(line.face);
    const Vec3 normal = line.on_front ? face.plane.normal : -face.plane.normal;
    const double seen = point_to_polygon(0.5 * (line.begin + line.end), normal, emitter_.corners);
    return emitter_.radiosity * (emitter_.two_sided ? std::fabs(seen) : std::max(seen, 0.0));
  }

  const OccluderEdges& edges_;
  const EmitterFace& emitter_;
  std::uint64_t most_wedges_;
  std::vector<DiscontinuityLine>& lines_;
  ShadowLineReport& report_;
  WedgeTracer tracer_;
  std::vector<double> breaks_;
};

/// The patches of one material that shines, as a set of their own.
Status emitting_patches(const PatchSet& patches, std::uint32_t material, PatchSet* emitting) {
  HC_TRY(emitting->vertices.assign(patches.vertices));
  HC_TRY(emitting->corner_offsets.push_back(0));
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    if (patches.material[i] != material)
      continue;
    HC_TRY(emitting->corners.append(patches.corners_of(i)));
    HC_TRY(
        emitting->corner_offsets.push_back(static_cast<std::uint32_t>(emitting->corners.size())));
    HC_TRY(emitting->area.push_back(patches.area[i]));
    HC_TRY(emitting->centre.push_back(patches.centre[i]));
    HC_TRY(emitting->normal.push_back(patches.normal[i]));
    HC_TRY(emitting->face.push_back(patches.face[i]));
    HC_TRY(emitting->material.push_back(material));
  }
  emitting->front_count = emitting->patch_count();
  return {};
}

} // namespace

Status find_emitters(const Scene& scene, const PatchSet& patches,
                     std::vector<EmitterFace>* emitters) {
  const std::uint32_t bands = scene.band_count();
  emitters->clear();
  for (std::uint32_t material = 0; material < scene.materials.size(); ++material) {
    double radiosity = 0;
    for (std::uint32_t band = 0; band < bands; ++band)
      radiosity += scene.exitance[std::size_t{material} * bands + band];
    PatchSet emitting;
    OccluderFaces faces;
    if (!(radiosity > 0))
      continue;
    HC_TRY(emitting_patches(patches, material, &emitting));
    if (emitting.patch_count() == 0)
      continue;
    HC_TRY(faces.build(emitting));
    for (std::uint32_t f = 0; f < faces.face_count(); ++f) {
      const auto corners = faces.corners_of(f);
      EmitterFace emitter;
      emitter.corners.assign(corners.begin(), corners.end());
      emitter.normal = faces.normal[f];
      emitter.two_sided = scene.two_sided[material] != 0;
      emitter.radiosity = radiosity;
      emitter.power = radiosity * glm::length(area_vector(corners));
      emitters->push_back(std::move(emitter));
    }
  }
  std::stable_sort(emitters->begin(), emitters->end(),
                   [](const EmitterFace& a, const EmitterFace& b) { return a.power > b.power; });
  return {};
}

void find_shadow_lines(const OccluderEdges& edges, const EmitterFace& emitter,
                       std::uint64_t most_wedges, std::vector<DiscontinuityLine>* lines,
                       ShadowLineReport* report) {
  ShadowCaster(edges, emitter, most_wedges, lines, report).run();
}

} // namespace hemicube::radiosity
