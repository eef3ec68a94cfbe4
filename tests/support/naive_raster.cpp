#include "tests/support/naive_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace hemicube::test {

namespace {

using Real = long double;
using Vector = glm::vec<3, Real>;

constexpr Real kFar = std::numeric_limits<Real>::max();

/// A linear function of the pixel's place on the face: a x + b y + c.
struct Linear {
  Real a = 0, b = 0, c = 0;
  Real at(Real x, Real y) const { return a * x + b * y + c; }
};

/// How far a grid reaches from the middle of its face.
struct Reach {
  Real x, y;

  explicit Reach(const raster::PixelGrid& grid)
      : x(along(grid.x0, grid.dx, grid.width)), y(along(grid.y0, grid.dy, grid.height)) {}

  /// The largest magnitude of a linear function on it, or more.
  Real largest(const Linear& f) const {
    return std::fabs(f.a) * x + std::fabs(f.b) * y + std::fabs(f.c);
  }

private:
  static Real along(Real first, Real step, int count) { // a pixel farther than centres reach
    return std::max(std::fabs(first - step), std::fabs(first + count * step));
  }
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

/// A bound on the magnitude of any place's coordinates, as the errors below grow with it.
Real spread(Real x, Real y) {
  return std::fabs(x) + std::fabs(y) + 1;
}

/// Rounding to double, with room for the few operations between a corner and what depends on it.
constexpr Real kRounding = 0x1p-48L;

/// The line that an edge's plane through the eye draws on the face; positive inside.
struct Edge {
  Linear line;
  Real slope; ///< of the line, per pixel
  Real error; ///< of the line, times the spread of the place

  Real distance(Real x, Real y) const { return in_pixels(line.at(x, y)); }
  /// By how many pixels a place is certain to be inside; < 0: it is not.
  Real margin_inside(Real x, Real y) const {
    return in_pixels(line.at(x, y) - error * spread(x, y));
  }
  Real margin_outside(Real x, Real y) const {
    return in_pixels(-line.at(x, y) - error * spread(x, y));
  }

private:
  /// A line that never crosses the face (slope 0) has everything on one side, infinitely far away;
  /// an edge whose plane holds the eye (all 0) decides nothing: distance 0.
  Real in_pixels(Real value) const {
    return slope > 0 ? value / slope : value == 0 ? 0 : value > 0 ? kFar : -kFar;
  }
};

enum class Tilt : std::uint8_t { kSeen, kEdgeOn, kTooCloseToSay };

/// A polygon prepared for one face.
struct Candidate {
  std::uint32_t id = 0;
  bool back = false; ///< its back is seen
  Tilt tilt = Tilt::kSeen;
  Linear inverse_depth; ///< 1/z
  Real scale = 0;       ///< the largest 1/z on the grid, or more
  Real depth_error = 0; ///< of it, times the spread of the place
  std::vector<Edge> edges;

  /// Signed distance of a place from the polygon's outline, as far as its edges' lines tell.
  Real inside(Real x, Real y) const {
    Real distance = kFar;
    for (const Edge& edge : edges)
      distance = std::min(distance, edge.distance(x, y));
    return distance;
  }
  /// By how many pixels a place is certain to be covered, or certain not to be.
  Real margin(Real x, Real y) const {
    Real in = kFar, out = -kFar;
    for (const Edge& edge : edges) {
      in = std::min(in, edge.margin_inside(x, y));
      out = std::max(out, edge.margin_outside(x, y));
    }
    return std::max(in, out);
  }
};

Vector newell_normal(const std::vector<Vector>& corners) {
  Vector sum(0);
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += glm::cross(corners[k], corners[(k + 1) % corners.size()]);
  return sum;
}

Edge prepare_edge(const Vector& from, const Vector& to, Real sign, const FaceAxes& axes,
                  const raster::PixelGrid& grid) {
  const Linear line = axes.along(glm::cross(from, to) * sign);
  const Real lengths = glm::length(from) + glm::length(to);
  return {line, std::hypot(line.a * Real(grid.dx), line.b * Real(grid.dy)),
          kRounding * lengths * lengths};
}

/// Fills the plane: depth, side, and how well they are known.
/// @param corners     from the eye
/// @param coordinate  the largest of a corner: what is computed of them is rounded as they are
void prepare_plane(const std::vector<Vector>& corners, Real coordinate, const FaceAxes& axes,
                   const Reach& grid, Candidate* candidate) {
  Vector middle(0);
  Real reach = 0, extent = 0, warp = 0;
  for (const Vector& corner : corners) {
    middle += corner / static_cast<Real>(corners.size());
    reach = std::max(reach, glm::length(corner));
    extent = std::max(extent, glm::length(corner - corners[0]));
  }
  const Vector normal = newell_normal(corners);
  const Real length = glm::length(normal), distance = glm::dot(normal, middle);
  for (const Vector& corner : corners)
    warp = std::max(warp, length > 0 ? std::fabs(glm::dot(normal, corner - middle)) / length : 0);
  const Real normal_error = (kRounding * extent + warp) * extent;
  const Real distance_error =
      normal_error * reach + length * (warp + kRounding * reach + 0x1p-51L * coordinate);
  const Real edge_on = 0x1p-45L * length * reach, size = std::fabs(distance);
  candidate->tilt = size - distance_error > 1.01L * edge_on   ? Tilt::kSeen
                    : size + distance_error < 0.99L * edge_on ? Tilt::kEdgeOn
                                                              : Tilt::kTooCloseToSay;
  candidate->back = distance > 0;
  if (distance == 0)
    return;
  candidate->inverse_depth = axes.along(normal / distance);
  candidate->scale = grid.largest(candidate->inverse_depth);
  candidate->depth_error = (normal_error + candidate->scale * distance_error) / size;
}

Candidate prepare(const raster::Polygons& polygons, std::uint32_t id, const raster::View& view,
                  const FaceAxes& axes, const raster::PixelGrid& grid) {
  std::vector<Vector> corners;
  Real coordinate = 0;
  for (std::uint32_t k = polygons.corner_offsets[id]; k < polygons.corner_offsets[id + 1]; ++k) {
    const Vector corner(polygons.vertices[polygons.corners[k]]);
    corners.push_back(corner - Vector(view.eye));
    for (int axis = 0; axis < 3; ++axis)
      coordinate = std::max(coordinate, std::fabs(corner[axis]));
  }
  Candidate candidate;
  candidate.id = id;
  prepare_plane(corners, coordinate, axes, Reach(grid), &candidate);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector& to = corners[(k + 1) % corners.size()];
    if (corners[k] != to) // a corner twice is no edge
      candidate.edges.push_back(
          prepare_edge(corners[k], to, candidate.back ? 1.0L : -1.0L, axes, grid));
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
    if (depth <= 0 || candidate.inside(x, y) < 0)
      continue;
    if (nearest == nullptr || beats(candidate, depth, *nearest, nearest_depth)) {
      nearest = &candidate;
      nearest_depth = depth;
    }
  }
  NaivePixel pixel;
  pixel.edge_margin = pixel.depth_gap = kFar;
  Real nearest_scale = 0, nearest_error = 0;
  if (nearest != nullptr) {
    pixel.item = nearest->id | (nearest->back ? raster::kBackFacing : 0u);
    pixel.inverse_depth = nearest_depth;
    nearest_scale = nearest->scale;
    nearest_error = nearest->depth_error * spread(x, y);
    pixel.depth_error = kDepthError * nearest_scale + nearest_error;
    pixel.edge_margin = nearest->margin(x, y);
    pixel.depth_gap = (nearest_depth - nearest_error) / nearest_scale; // the background's 1/z is 0
    if (nearest_scale > 1e37L || nearest_depth < 1e-37L)
      pixel.edge_margin = -kFar;
  }
  for (const Candidate& candidate : candidates) {
    if (candidate.tilt == Tilt::kTooCloseToSay)
      pixel.edge_margin = -kFar;
    if (&candidate == nearest)
      continue;
    const Real scale = candidate.scale + nearest_scale;
    const Real error = nearest_error + candidate.depth_error * spread(x, y);
    const Real gap = (nearest_depth - candidate.inverse_depth.at(x, y) - error) / scale;
    const bool hidden = nearest != nullptr && gap > kDepthError;
    if (!hidden)
      pixel.edge_margin = std::min(pixel.edge_margin, candidate.margin(x, y));
    if (candidate.inside(x, y) >= 0)
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
    if (candidate.tilt == Tilt::kTooCloseToSay ||
        (candidate.tilt == Tilt::kSeen && (!candidate.back || view.draw_backs)))
      candidates.push_back(std::move(candidate));
  }
  NaiveImage image{grid.width, grid.height, {}};
  for (int j = 0; j < grid.height; ++j)
    for (int i = 0; i < grid.width; ++i)
      image.pixels.push_back(
          look(candidates, Real(grid.x0) + i * Real(grid.dx), Real(grid.y0) + j * Real(grid.dy)));
  return image;
}

int undecided_count(const NaiveImage& image) {
  return static_cast<int>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                        [](const NaivePixel& pixel) { return !pixel.decided(); }));
}

std::string difference(const NaiveImage& naive, const DrawnFace& drawn) {
  std::ostringstream text;
  int wrong = 0;
  for (int y = 0; y < naive.height; ++y)
    for (int x = 0; x < naive.width; ++x) {
      const NaivePixel& expected = naive.at(x, y);
      const raster::Item item = drawn.items[drawn.index(x, y)];
      const auto depth = static_cast<Real>(drawn.depths[drawn.index(x, y)]);
      if (!expected.decided() ||
          (item == expected.item &&
           std::fabs(depth - expected.inverse_depth) <= expected.depth_error))
        continue;
      if (++wrong == 1)
        text << "pixel (" << x << ", " << y << "): item " << std::hex << item << ", expected "
             << expected.item << std::dec << "; 1/z " << depth << ", expected "
             << expected.inverse_depth << " to " << expected.depth_error << "; edge margin "
             << expected.edge_margin << " px, depth gap " << expected.depth_gap;
    }
  if (wrong > 0)
    text << "; " << wrong << " pixels differ";
  return text.str();
}

} // namespace hemicube::test
