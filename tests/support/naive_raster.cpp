#include "tests/support/naive_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemicube::test {

namespace {

using Real = long double;
using Vector = glm::vec<3, Real>;

constexpr Real kFar = std::numeric_limits<Real>::max();

/// A linear function of the pixel's place on the face: a x + b y + c.
struct Linear {
  Real a = 0, b = 0, c = 0;
  Real at(Real x, Real y) const { return a * x + b * y + c; }
  Real largest() const { return std::fabs(a) + std::fabs(b) + std::fabs(c); }
};

/// The axes of a face in the world: a pixel looks along x right + y up + forward.
struct FaceAxes {
  Vector right, up, forward;

  FaceAxes(const raster::View& view, raster::Face face) {
    const auto world = [&](const Vec3& face_vector) {
      const Vec3 local = raster::from_face(face, face_vector);
      return Vector(view.axis_x) * Real(local.x) + Vector(view.axis_y) * Real(local.y) +
             Vector(view.axis_z) * Real(local.z);
    };
    right = world({1, 0, 0});
    up = world({0, 1, 0});
    forward = world({0, 0, 1});
  }

  Linear along(const Vector& n) const {
    return {glm::dot(n, right), glm::dot(n, up), glm::dot(n, forward)};
  }
};

/// A polygon prepared for one face.
struct Candidate {
  std::uint32_t id = 0;
  bool back = false;         ///< its back is seen
  bool edge_on = false;      ///< the eye lies in its plane, up to rounding
  Linear inverse_depth;      ///< 1/z
  std::vector<Linear> edges; ///< signed distance in pixels, positive inside

  /// Signed distance of a place from the polygon's outline, as far as its edges' lines tell.
  Real inside(Real x, Real y) const {
    Real distance = kFar;
    for (const Linear& edge : edges)
      distance = std::min(distance, edge.at(x, y));
    return distance;
  }
};

Vector newell_normal(const std::vector<Vector>& corners) {
  Vector sum(0);
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += glm::cross(corners[k], corners[(k + 1) % corners.size()]);
  return sum;
}

/// Distances in pixels are those to the line that an edge's plane through the eye draws on the
/// face.
Linear scaled_to_pixels(const Linear& edge, Real sign, const raster::PixelGrid& grid) {
  const Real slope = std::hypot(edge.a * Real(grid.dx), edge.b * Real(grid.dy));
  const Real scale = slope > 0 ? sign / slope : 0;
  // A line that never crosses the face (slope 0) has everything on one side, infinitely far away;
  // an edge whose line goes through the eye (all 0) decides nothing: distance 0.
  if (slope == 0)
    return {0, 0, edge.c == 0 ? 0 : sign * edge.c > 0 ? kFar : -kFar};
  return {edge.a * scale, edge.b * scale, edge.c * scale};
}

Candidate prepare(const raster::Polygons& polygons, std::uint32_t id, const raster::View& view,
                  const FaceAxes& axes, const raster::PixelGrid& grid) {
  std::vector<Vector> corners;
  Vector middle(0);
  Real reach = 0;
  for (std::uint32_t k = polygons.corner_offsets[id]; k < polygons.corner_offsets[id + 1]; ++k) {
    corners.push_back(Vector(polygons.vertices[polygons.corners[k]]) - Vector(view.eye));
    middle += corners.back();
    reach = std::max(reach, glm::length(corners.back()));
  }
  middle /= static_cast<Real>(corners.size());
  const Vector normal = newell_normal(corners);
  const Real distance = glm::dot(normal, middle);

  Candidate candidate;
  candidate.id = id;
  candidate.back = distance > 0;
  candidate.edge_on = std::fabs(distance) <= 1e-13L * glm::length(normal) * reach;
  candidate.inverse_depth = axes.along(distance == 0 ? Vector(0) : normal / distance);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector plane = glm::cross(corners[k], corners[(k + 1) % corners.size()]);
    candidate.edges.push_back(
        scaled_to_pixels(axes.along(plane), candidate.back ? 1.0L : -1.0L, grid));
  }
  return candidate;
}

/// Larger 1/z first, then facing before back-facing, then the lower id.
bool beats(const Candidate& a, Real depth_a, const Candidate& b, Real depth_b) {
  if (depth_a != depth_b)
    return depth_a > depth_b;
  if (a.back != b.back)
    return b.back;
  return a.id < b.id;
}

NaivePixel look(const std::vector<Candidate>& candidates, Real x, Real y) {
  const Candidate* nearest = nullptr;
  Real nearest_depth = 0;
  for (const Candidate& candidate : candidates) {
    const Real depth = candidate.inverse_depth.at(x, y);
    if (candidate.edge_on || depth <= 0 || candidate.inside(x, y) < 0)
      continue;
    if (nearest == nullptr || beats(candidate, depth, *nearest, nearest_depth)) {
      nearest = &candidate;
      nearest_depth = depth;
    }
  }
  NaivePixel pixel;
  pixel.edge_margin = pixel.depth_gap = kFar;
  if (nearest != nullptr) {
    pixel.item = nearest->id | (nearest->back ? raster::kBackFacing : 0u);
    pixel.inverse_depth = nearest_depth;
    pixel.depth_scale = nearest->inverse_depth.largest();
    pixel.edge_margin = nearest->inside(x, y);
    pixel.depth_gap = nearest_depth / pixel.depth_scale; // to the background, whose 1/z is 0
  }
  for (const Candidate& candidate : candidates) {
    if (&candidate == nearest)
      continue;
    const Real inside = candidate.inside(x, y);
    const Real scale = candidate.inverse_depth.largest() + pixel.depth_scale;
    const Real gap = (nearest_depth - candidate.inverse_depth.at(x, y)) / scale;
    const bool hidden = nearest != nullptr && gap > kDepthError && !candidate.edge_on;
    if (!hidden)
      pixel.edge_margin = std::min(pixel.edge_margin, std::fabs(inside));
    if (inside >= 0 && !candidate.edge_on)
      pixel.depth_gap = std::min(pixel.depth_gap, gap);
  }
  return pixel;
}

} // namespace

NaiveImage naive_image(const raster::Polygons& polygons, const raster::View& view,
                       raster::Face face, const raster::PixelGrid& grid) {
  const FaceAxes axes(view, face);
  std::vector<Candidate> candidates;
  for (std::uint32_t id = 0; id < polygons.count(); ++id) {
    if (id == view.skip)
      continue;
    Candidate candidate = prepare(polygons, id, view, axes, grid);
    if (!candidate.back || view.draw_backs)
      candidates.push_back(std::move(candidate));
  }
  NaiveImage image{grid.width, grid.height, {}};
  for (int j = 0; j < grid.height; ++j)
    for (int i = 0; i < grid.width; ++i)
      image.pixels.push_back(
          look(candidates, Real(grid.x0) + i * Real(grid.dx), Real(grid.y0) + j * Real(grid.dy)));
  return image;
}

} // namespace hemicube::test
