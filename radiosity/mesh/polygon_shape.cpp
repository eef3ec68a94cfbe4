#include "radiosity/mesh/polygon_shape.h"

#include <cfloat>
#include <cstddef>

namespace hemicube::radiosity {
namespace {

constexpr double kPlanarity = 1e-3; // of the size: real data is rarely exact

// In units of the last place of the largest coordinate: a coordinate is off by half of one, a
// difference by one, and a cross product sums a few of those.
constexpr double kRoundings = 8;

double larger(double a, double b) {
  return a > b ? a : b;
}
double magnitude(double a) {
  return a < 0 ? -a : a;
}

Vec3 axis_most_across(const Vec3& normal) {
  const double x = magnitude(normal.x), y = magnitude(normal.y), z = magnitude(normal.z);
  return x <= y && x <= z ? Vec3(1, 0, 0) : y <= z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
}

// Whether the way around a polygon reverses at most twice along a direction (a unit vector). Steps
// below the resolution do not count: points on an edge across it wander by that much.
bool goes_and_returns_once(std::span<const Vec3> points, const Vec3& direction, double resolution) {
  int reversals = 0;
  int first_sign = 0, sign = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double step = glm::dot(direction, points[(i + 1) % points.size()] - points[i]);
    if (magnitude(step) <= resolution)
      continue;
    const int new_sign = step > 0 ? 1 : -1;
    reversals += sign != 0 && new_sign != sign;
    first_sign = first_sign != 0 ? first_sign : new_sign;
    sign = new_sign;
  }
  return reversals + (sign != first_sign) <= 2;
}

} // namespace

PolygonShape measure_polygon(std::span<const Vec3> points) {
  PolygonShape shape;
  const Vec3 base = points[0];
  Vec3 low = base, high = base;
  double largest = 0;
  for (const Vec3& point : points)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = point[axis] < low[axis] ? point[axis] : low[axis];
      high[axis] = larger(high[axis], point[axis]);
      largest = larger(largest, magnitude(point[axis]));
    }
  for (std::size_t i = 2; i < points.size(); ++i)
    shape.area_vector += 0.5 * glm::cross(points[i - 1] - base, points[i] - base);
  shape.area = glm::length(shape.area_vector);
  shape.size = glm::length(high - low);
  shape.resolution = kRoundings * DBL_EPSILON * largest;
  return shape;
}

bool has_area(std::span<const Vec3> points, const PolygonShape& shape) {
  const double fan_triangles = static_cast<double>(points.size()) - 2; // each rounds on its own
  return 2 * shape.area > fan_triangles * shape.resolution * shape.size;
}

bool is_planar(std::span<const Vec3> points, const PolygonShape& shape) {
  if (points.size() == 3)
    return true;
  Vec3 mean(0, 0, 0); // relative to the first point
  for (const Vec3& point : points)
    mean += point - points[0];
  mean /= static_cast<double>(points.size());
  const Vec3 normal = shape.area_vector / shape.area;
  for (const Vec3& point : points)
    if (!(magnitude(glm::dot(normal, point - points[0] - mean)) <= kPlanarity * shape.size))
      return false;
  return true;
}

// A polygon is convex if it never turns right and turns about once. Left turns alone do not tell a
// pentagram from a pentagon.
bool is_convex(std::span<const Vec3> points, const PolygonShape& shape) {
  const Vec3 normal = shape.area_vector / shape.area;
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& middle = points[(i + 1) % count];
    if (turn_side(normal, shape.resolution, middle - points[i], points[(i + 2) % count] - middle) <
        0)
      return false;
  }
  const Vec3 along = unit(glm::cross(normal, axis_most_across(normal)));
  return goes_and_returns_once(points, along, shape.resolution) &&
         goes_and_returns_once(points, glm::cross(normal, along), shape.resolution);
}

Vec3 centroid(std::span<const Vec3> points, const PolygonShape& shape) {
  const Vec3 base = points[0];
  Vec3 sum(0, 0, 0);
  double weights = 0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Vec3 a = points[i - 1] - base;
    const Vec3 b = points[i] - base;
    const double weight = glm::dot(shape.area_vector / shape.area, glm::cross(a, b));
    sum += weight * (a + b);
    weights += weight;
  }
  return base + sum / (3 * weights);
}

int turn_side(const Vec3& normal, double resolution, const Vec3& u, const Vec3& v) {
  const double turn = glm::dot(normal, glm::cross(u, v));
  const double rounding = resolution * (glm::length(u) + glm::length(v));
  return turn > rounding ? 1 : turn < -rounding ? -1 : 0;
}

} // namespace hemicube::radiosity
