#include "tests/support/polygon_shapes.h"

#include <algorithm>

namespace hemicube::test {

std::vector<Vec3> reversed(std::vector<Vec3> polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

std::vector<Vec3> turned(std::vector<Vec3> polygon, int corners) {
  std::rotate(polygon.begin(), polygon.begin() + corners, polygon.end());
  return polygon;
}

std::vector<Vec3> random_ngon(Random& random, int corners, const Vec3& centre, double size) {
  const auto frame = random_frame(random);
  const Vec3 u = frame[0] * size, v = frame[1] * (size * random.between(0.2, 1));
  std::vector<Vec3> polygon;
  for (int k = 0; k < corners; ++k) {
    // The parametrised circle on each of its four quarters: points in convex position without a
    // sine, the same on every machine.
    const int quarter = 4 * k / corners;
    const double t = 4.0 * k / corners - quarter, d = 1 + t * t;
    double x = (1 - t * t) / d, y = 2 * t / d;
    for (int q = 0; q < quarter; ++q) {
      const double old_x = x;
      x = -y;
      y = old_x;
    }
    polygon.push_back(centre + u * x + v * y);
  }
  return polygon;
}

std::vector<Vec3> axis_rectangle(Random& random, int axis, const Vec3& corner, double size) {
  Vec3 u(0, 0, 0), v(0, 0, 0);
  u[(axis + 1) % 3] = size;
  v[(axis + 2) % 3] = size;
  if (random.index(2) == 0)
    std::swap(u, v);
  return {corner, corner + u, corner + u + v, corner + v};
}

std::vector<Vec3> card(double x0, double x1, double y0, double y1, double z, int corners) {
  std::vector<Vec3> polygon = {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}};
  for (int k = 0; k <= corners - 4; ++k) // the last side is cut
    polygon.push_back({x1 + (x0 - x1) * k / (corners - 3), y0, z});
  return polygon;
}

std::array<std::vector<Vec3>, 2> halves(const std::vector<Vec3>& polygon, double at) {
  const std::size_t other = polygon.size() / 2;
  const Vec3 a = polygon[0] + (polygon[1] - polygon[0]) * at;
  const Vec3& next = polygon[other + 1 == polygon.size() ? 0 : other + 1];
  const Vec3 b = polygon[other] + (next - polygon[other]) * at;
  std::array<std::vector<Vec3>, 2> parts;
  parts[0] = {a};
  parts[0].insert(parts[0].end(), polygon.begin() + 1,
                  polygon.begin() + static_cast<std::ptrdiff_t>(other) + 1);
  parts[0].push_back(b);
  parts[1] = {b};
  parts[1].insert(parts[1].end(), polygon.begin() + static_cast<std::ptrdiff_t>(other) + 1,
                  polygon.end());
  parts[1].push_back(polygon[0]);
  parts[1].push_back(a);
  return parts;
}

} // namespace hemicube::test
