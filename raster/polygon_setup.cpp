#include "raster/polygon_setup.h"

#include <cmath>

namespace hemicube::raster {
namespace {

/// A polygon whose plane passes the eye at less than this fraction of its farthest vertex' distance
/// is seen edge-on: it covers nothing, and its depth would be rounding errors.
constexpr double kThroughEye = 0x1p-45;

/// A polygon is edge-on to the receiver when no vertex rises above its plane by more than this
/// fraction of its distance.
constexpr double kEdgeOn = 0x1p-20;

// Which sides of the planes between hemicube faces a vertex lies on. What all vertices of a polygon
// have in common, and what none has, tells the faces it cannot reach.
constexpr unsigned kBelowPlusX = 1 << 0;  // x <= z: not beyond the edge between top and +x
constexpr unsigned kBelowMinusX = 1 << 1; // -x <= z
constexpr unsigned kBelowPlusY = 1 << 2;
constexpr unsigned kBelowMinusY = 1 << 3;
constexpr unsigned kXLessY = 1 << 4;    // x <= y
constexpr unsigned kXLessNegY = 1 << 5; // x <= -y
constexpr unsigned kXNegative = 1 << 6; // x <= 0
constexpr unsigned kYNegative = 1 << 7; // y <= 0
constexpr unsigned kEdgeOnBit = 1 << 8; // not above the horizon
constexpr std::uint16_t kAllOutcodes = (1 << 9) - 1;

std::uint16_t outcode(const Vec3& v) {
  unsigned code = 0;
  code |= v.x <= v.z ? kBelowPlusX : 0u;
  code |= -v.x <= v.z ? kBelowMinusX : 0u;
  code |= v.y <= v.z ? kBelowPlusY : 0u;
  code |= -v.y <= v.z ? kBelowMinusY : 0u;
  code |= v.x <= v.y ? kXLessY : 0u;
  code |= v.x <= -v.y ? kXLessNegY : 0u;
  code |= v.x <= 0 ? kXNegative : 0u;
  code |= v.y <= 0 ? kYNegative : 0u;
  // Squared, so that no square root is needed; z <= 0 is below in any case.
  code |= v.z <= 0 || v.z * v.z <= kEdgeOn * kEdgeOn * glm::dot(v, v) ? kEdgeOnBit : 0u;
  return static_cast<std::uint16_t>(code);
}

/// @param all  bits set at every vertex
/// @param any  bits set at some vertex
std::uint8_t faces_reached(std::uint16_t all, std::uint16_t any) {
  const auto everywhere = [all](unsigned bits) { return (all & bits) != 0; };
  const auto nowhere = [any](unsigned bits) { return (any & bits) == 0; };
  unsigned faces = 0;
  if (!nowhere(kBelowPlusX) && !nowhere(kBelowMinusX) && !nowhere(kBelowPlusY) &&
      !nowhere(kBelowMinusY))
    faces |= 1u << static_cast<unsigned>(Face::kTop);
  // A side shows what lies beyond the top's edge, in front, and between its two neighbours.
  if (!everywhere(kBelowPlusX) && !everywhere(kXNegative) && !everywhere(kXLessY) &&
      !everywhere(kXLessNegY))
    faces |= 1u << static_cast<unsigned>(Face::kPlusX);
  if (!everywhere(kBelowMinusX) && !nowhere(kXNegative) && !nowhere(kXLessY) &&
      !nowhere(kXLessNegY))
    faces |= 1u << static_cast<unsigned>(Face::kMinusX);
  if (!everywhere(kBelowPlusY) && !everywhere(kYNegative) && !nowhere(kXLessY) &&
      !everywhere(kXLessNegY))
    faces |= 1u << static_cast<unsigned>(Face::kPlusY);
  if (!everywhere(kBelowMinusY) && !nowhere(kYNegative) && !everywhere(kXLessY) &&
      !nowhere(kXLessNegY))
    faces |= 1u << static_cast<unsigned>(Face::kMinusY);
  return static_cast<std::uint8_t>(faces);
}

std::int32_t clamp_to(double value, std::int32_t low, std::int32_t high) {
  if (!(value > low))
    return low;
  return value < high ? static_cast<std::int32_t>(value) : high;
}

/// Pixels that a polygon can cover, both ends included, one pixel more on each side than its
/// projection needs: rounding cannot move a span further.
struct PixelBounds {
  std::int32_t x0, x1, y0, y1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

PixelBounds pixel_bounds(const Polygons& polygons, const ViewSetup& setup,
                         const ViewPolygon& polygon, Face face, const PixelGrid& grid,
                         const Window& window) {
  PixelBounds bounds = {window.x, window.x + window.width - 1, window.y,
                        window.y + window.height - 1};
  const std::uint32_t begin = polygons.corner_offsets[polygon.id];
  const std::uint32_t end = polygons.corner_offsets[polygon.id + 1];
  double x_low = INFINITY, x_high = -INFINITY, y_low = INFINITY, y_high = -INFINITY;
  bool any_in_front = false, all_in_front = true;
  for (std::uint32_t c = begin; c < end; ++c) {
    const Vec3 v = to_face(face, setup.vertex(polygons.corners[c]));
    if (!(v.z > 0)) {
      all_in_front = false;
      continue;
    }
    any_in_front = true;
    const double x = (v.x / v.z - grid.x0) / grid.dx;
    const double y = (v.y / v.z - grid.y0) / grid.dy;
    x_low = x < x_low ? x : x_low;
    x_high = x > x_high ? x : x_high;
    y_low = y < y_low ? y : y_low;
    y_high = y > y_high ? y : y_high;
  }
  if (!any_in_front)
    bounds.x1 = bounds.x0 - 1;
  if (!all_in_front || !any_in_front)
    return bounds; // through the eye plane: it may reach to infinity
  const PixelBounds outer = {bounds.x0 - 1, bounds.x1 + 1, bounds.y0 - 1, bounds.y1 + 1};
  const PixelBounds projected = {
      clamp_to(std::floor(x_low), outer.x0, outer.x1 + 2),
      clamp_to(std::ceil(x_high), outer.x0 - 2, outer.x1),
      clamp_to(std::floor(y_low), outer.y0, outer.y1 + 2),
      clamp_to(std::ceil(y_high), outer.y0 - 2, outer.y1),
  };
  bounds.x0 = projected.x0 - 1 > bounds.x0 ? projected.x0 - 1 : bounds.x0;
  bounds.x1 = projected.x1 + 1 < bounds.x1 ? projected.x1 + 1 : bounds.x1;
  bounds.y0 = projected.y0 - 1 > bounds.y0 ? projected.y0 - 1 : bounds.y0;
  bounds.y1 = projected.y1 + 1 < bounds.y1 ? projected.y1 + 1 : bounds.y1;
  return bounds;
}

/// Depth as a function of the pixel, and how far rounding to float may carry it.
struct DepthPlane {
  double per_pixel, per_row, at_origin, error;

  DepthPlane(const Vec3& d, const PixelGrid& grid) {
    per_pixel = d.x * grid.dx;
    per_row = d.y * grid.dy;
    at_origin = d.z + (d.x * grid.x0 + d.y * grid.y0);
    const double x = std::fabs(d.x) * (std::fabs(grid.x0) + grid.width * std::fabs(grid.dx));
    const double y = std::fabs(d.y) * (std::fabs(grid.y0) + grid.height * std::fabs(grid.dy));
    // Three roundings of 2^-24 of numbers no larger than the sum; 2^-21 leaves some room.
    error = 0x1p-21 * (x + y + std::fabs(d.z));
  }

  double largest(const PixelBounds& b) const {
    return at_origin + per_pixel * (per_pixel > 0 ? b.x1 : b.x0) +
           per_row * (per_row > 0 ? b.y1 : b.y0);
  }
};

/// Writes where the polygon's edges cross a row: x = slope * row + offset, left bounds from the
/// front of the scratch, right bounds from its back.
void set_up_edges(const Polygons& polygons, const ViewSetup& setup, const ViewPolygon& polygon,
                  Face face, const PixelGrid& grid, EdgeScratch* scratch, RowProblem* rows) {
  const std::uint32_t begin = polygons.corner_offsets[polygon.id];
  const std::uint32_t end = polygons.corner_offsets[polygon.id + 1];
  std::int32_t left = 0;
  const auto edge_end = static_cast<std::int32_t>(scratch->slope.size());
  std::int32_t right = edge_end;
  for (std::uint32_t c = begin; c < end; ++c) {
    const Vec3 n = to_face(face, setup.edge(c));
    double a = n.x * grid.dx;
    const double b = n.y * grid.dy;
    const double k = n.z + (n.x * grid.x0 + n.y * grid.y0);
    // An edge along the rows, or nearly: tilted just enough to divide by, the same way for both of
    // its polygons.
    const double least = 0x1p-60 * (std::fabs(b) + std::fabs(k));
    if (std::fabs(a) < least)
      a = std::copysign(least, a != 0 ? a : b);
    if (a == 0)
      continue; // the edge points at the eye: it bounds nothing
    const bool is_left = (a > 0) == polygon.facing;
    const std::int32_t at = is_left ? left++ : --right;
    scratch->slope[static_cast<std::size_t>(at)] = -b / a;
    scratch->offset[static_cast<std::size_t>(at)] = -k / a;
  }
  rows->slope = scratch->slope.data();
  rows->offset = scratch->offset.data();
  rows->left_end = left;
  rows->right_begin = right;
  rows->edge_end = edge_end;
}

} // namespace

Status ViewSetup::init(const Polygons& polygons) {
  HC_TRY(vertices_.resize(polygons.vertices.size()));
  HC_TRY(outcodes_.resize(polygons.vertices.size()));
  HC_TRY(edges_.resize(polygons.corners.size()));
  return polygons_.resize(polygons.count());
}

void ViewSetup::transform_vertices(const Polygons& polygons, const View& view) {
  for (std::size_t i = 0; i < polygons.vertices.size(); ++i) {
    const Vec3 p = polygons.vertices[i] - view.eye;
    const Vec3 v(glm::dot(p, view.axis_x), glm::dot(p, view.axis_y), glm::dot(p, view.axis_z));
    vertices_[i] = v;
    outcodes_[i] = outcode(v);
  }
}

bool ViewSetup::set_up(const Polygons& polygons, const Plane& plane, const View& view,
                       std::uint32_t id, ViewPolygon* polygon) {
  const std::uint32_t begin = polygons.corner_offsets[id], end = polygons.corner_offsets[id + 1];
  std::uint16_t all = kAllOutcodes, any = 0;
  double farthest = 0; // squared
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint16_t code = outcodes_[polygons.corners[c]];
    all &= code;
    any |= code;
    const Vec3& v = vertices_[polygons.corners[c]];
    farthest = std::fmax(farthest, glm::dot(v, v));
  }
  if (view.above_horizon && (all & kEdgeOnBit) != 0)
    return false;

  const double distance = glm::dot(plane.normal, plane.point - view.eye);
  if (!(distance * distance >
        kThroughEye * kThroughEye * glm::dot(plane.normal, plane.normal) * farthest))
    return false;
  polygon->facing = (distance < 0) != plane.reversed;
  if (!polygon->facing && !view.draw_backs)
    return false;
  const Vec3 normal(glm::dot(plane.normal, view.axis_x), glm::dot(plane.normal, view.axis_y),
                    glm::dot(plane.normal, view.axis_z));
  polygon->depth = normal / distance;

  polygon->id = id;
  polygon->faces = faces_reached(all, any);
  for (std::uint32_t c = begin; c < end; ++c) {
    const Vec3& a = vertices_[polygons.corners[c]];
    const Vec3& b = vertices_[polygons.corners[c + 1 == end ? begin : c + 1]];
    edges_[c] = glm::cross(a + b, a - b); // -2 a x b, without its cancellation
  }
  return true;
}

void ViewSetup::prepare(const Polygons& polygons, std::span<const Plane> planes, const View& view) {
  transform_vertices(polygons, view);
  count_ = 0;
  for (std::uint32_t id = 0; id < polygons.count(); ++id) {
    // Also its other side, and copies of it: where it is slightly bent their planes pass the eye.
    if (view.skip < polygons.count() && same_place(planes[id], planes[view.skip]))
      continue;
    if (set_up(polygons, planes[id], view, id, &polygons_[count_]))
      ++count_;
  }
}

Status EdgeScratch::init(const Polygons& polygons) {
  std::size_t most = 0;
  for (std::uint32_t p = 0; p < polygons.count(); ++p) {
    const std::size_t corners = polygons.corner_offsets[p + 1] - polygons.corner_offsets[p];
    most = corners > most ? corners : most;
  }
  HC_TRY(slope.resize(most));
  return offset.resize(most);
}

bool set_up_in_face(const Polygons& polygons, const ViewSetup& setup, const ViewPolygon& polygon,
                    Face face, const PixelGrid& grid, const Window& window, EdgeScratch* scratch,
                    FacePolygon* result) {
  const PixelBounds bounds = pixel_bounds(polygons, setup, polygon, face, grid, window);
  if (bounds.empty())
    return false;

  const DepthPlane plane(to_face(face, polygon.depth), grid);
  // Where a facing and a back-facing polygon are equally deep up to rounding - along every
  // silhouette - the facing one must win: both are moved apart by the rounding they can suffer.
  const double towards_eye = polygon.facing ? plane.error : -plane.error;
  result->depth_per_pixel = static_cast<float>(plane.per_pixel);
  result->nearest = static_cast<float>(plane.largest(bounds) + 3 * plane.error);
  result->tiles = {(bounds.x0 - window.x) / kTileSize, (bounds.y0 - window.y) / kTileSize,
                   (bounds.x1 - window.x) / kTileSize, (bounds.y1 - window.y) / kTileSize};

  RowProblem& rows = result->rows;
  set_up_edges(polygons, setup, polygon, face, grid, scratch, &rows);
  rows.row_begin = bounds.y0;
  rows.row_end = bounds.y1 + 1;
  rows.x_begin = bounds.x0;
  rows.x_end = bounds.x1 + 1;
  rows.depth_per_row = plane.per_row;
  rows.depth_at_origin = plane.at_origin + towards_eye;
  return true;
}

} // namespace hemicube::raster
