#include "tests/support/lambert.h"

#include "tests/support/drawn_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hemicube::test {

namespace {

using Vector = glm::vec<3, long double>;

struct Interval {
  double low = 0, high = 0;

  double nearest_to_zero() const {
    return low <= 0 && high >= 0 ? 0 : std::min(std::fabs(low), std::fabs(high));
  }
  Interval magnitudes() const {
    return {nearest_to_zero(), std::max(std::fabs(low), std::fabs(high))};
  }
};

/// The largest weight of a pixel anywhere in a rectangle of a face (coordinates -1 .. 1; y up from
/// the horizon on a side).
double largest_weight(bool top, const Interval& x, const Interval& y, double step) {
  const double near_x = x.nearest_to_zero();
  const Interval heights = y.magnitudes();
  // On a side y / (x^2 + y^2 + 1)^2 rises up to y = sqrt((x^2 + 1) / 3), then falls.
  const double best_y =
      top ? heights.low
          : std::clamp(std::sqrt((near_x * near_x + 1) / 3), heights.low, heights.high);
  const double d = near_x * near_x + best_y * best_y + 1;
  return (top ? 1 : best_y) / (std::numbers::pi * d * d) * step * step;
}

/// Calls f with each row (or column) of pixels that an interval touches.
template <typename Function> void for_each_line(const Interval& range, double step, Function f) {
  for (double at = std::floor(range.low / step) * step; at < range.high; at += step)
    f(Interval{at, at + step});
}

/// One pixel of the largest weight for every row, and one for every column, of a rectangle.
double outline_weight(bool top, const Interval& x, const Interval& y, std::uint32_t resolution) {
  const double step = 2.0 / resolution;
  const Interval wide_x{x.low - step,
                        x.high + step}; // the pixel an end falls in may begin before it
  double sum = 0;
  for_each_line(y, step,
                [&](const Interval& row) { sum += largest_weight(top, wide_x, row, step); });
  for_each_line(x, step,
                [&](const Interval& column) { sum += largest_weight(top, column, y, step); });
  return sum;
}

} // namespace

std::vector<Vec3> clipped(std::span<const Vec3> polygon, const Vec3& origin, const Vec3& normal) {
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& a = polygon[k];
    const Vec3& b = polygon[(k + 1) % polygon.size()];
    const double height_a = glm::dot(a - origin, normal);
    const double height_b = glm::dot(b - origin, normal);
    if (height_a >= 0)
      result.push_back(a);
    if ((height_a > 0 && height_b < 0) || (height_a < 0 && height_b > 0))
      result.push_back(a + (b - a) * (height_a / (height_a - height_b)));
  }
  return result;
}

double lambert_form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
  const std::vector<Vec3> visible = clipped(polygon, point, normal);
  if (visible.size() < 3)
    return 0;
  long double sum = 0;
  const Vector n = glm::normalize(Vector(normal));
  for (std::size_t k = 0; k < visible.size(); ++k) {
    const Vector a = Vector(visible[k]) - Vector(point);
    const Vector b = Vector(visible[(k + 1) % visible.size()]) - Vector(point);
    const Vector across = glm::cross(a, b);
    const long double size = glm::length(across);
    if (size > 0)
      sum += std::atan2(size, glm::dot(a, b)) * glm::dot(across, n) / size;
  }
  // Counter-clockwise from its front means clockwise seen from the point: the sum is negative.
  const long double form_factor = -sum / (2 * std::numbers::pi_v<long double>);
  return form_factor > 0 ? static_cast<double>(form_factor) : 0;
}

double blocked_form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon,
                           std::span<const std::vector<Vec3>> blockers) {
  double visible = lambert_form_factor(point, normal, polygon);
  for (const std::vector<Vec3>& blocker : blockers) {
    const std::vector<Vec3> outline = clipped(blocker, point, normal);
    if (outline.size() < 3)
      continue;
    // The part of the polygon inside the blocker's cone: on one side of all planes through its
    // edges.
    Vec3 middle{0, 0, 0};
    for (const Vec3& corner : outline)
      middle += (corner - point) / static_cast<double>(outline.size());
    std::vector<Vec3> hidden(polygon.begin(), polygon.end());
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec3 a = outline[k] - point, b = outline[(k + 1) % outline.size()] - point;
      const Vec3 plane = glm::cross(a, b);
      hidden = clipped(hidden, point, glm::dot(plane, middle) > 0 ? plane : -plane);
    }
    visible -= lambert_form_factor(point, normal, hidden);
  }
  return visible;
}

double aliasing_bound(const raster::View& view, std::span<const Vec3> polygon,
                      std::uint32_t resolution) {
  double sum = 0;
  for (const raster::Face face : kFaces) {
    std::vector<Vec3> part;
    for (const Vec3& corner : polygon) {
      const Vec3 v = corner - view.eye;
      part.push_back(raster::to_face(
          face, {glm::dot(v, view.axis_x), glm::dot(v, view.axis_y), glm::dot(v, view.axis_z)}));
    }
    const bool top = face == raster::Face::kTop;
    const Vec3 eye{0, 0, 0};
    part = clipped(part, eye, {1, 0, 1});
    part = clipped(part, eye, {-1, 0, 1});
    part = clipped(part, eye, {0, -1, 1});
    part = clipped(part, eye, top ? Vec3{0, 1, 1} : Vec3{0, 1, 0});
    Interval x{2, -2}, y{2, -2};
    for (const Vec3& v : part) {
      if (v.z <= 0)
        continue;
      x = {std::min(x.low, v.x / v.z), std::max(x.high, v.x / v.z)};
      y = {std::min(y.low, v.y / v.z), std::max(y.high, v.y / v.z)};
    }
    if (x.low <= x.high)
      sum += outline_weight(top, x, y, resolution);
  }
  return sum;
}

double largest_aliasing_bound(std::uint32_t resolution) {
  return outline_weight(true, {-1, 1}, {-1, 1}, resolution) +
         4 * outline_weight(false, {-1, 1}, {0, 1}, resolution);
}

} // namespace hemicube::test
