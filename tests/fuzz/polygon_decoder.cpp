#include "tests/fuzz/polygon_decoder.h"

#include "radiosity/mesh/polygon_shape.h"
#include "tests/support/polygon_shapes.h"

#include <cmath>

namespace hemicube::test {

Polygon decode_polygon(ByteReader* bytes) {
  const double size = std::ldexp(1.0, -static_cast<int>(bytes->below(11)));
  const Vec3 at = bytes->point();
  const std::uint32_t kind = bytes->below(6);
  if (kind == 0) { // axis-parallel
    Random random(bytes->byte());
    return axis_rectangle(random, static_cast<int>(bytes->below(3)), at, size);
  }
  if (kind == 1) { // with many corners
    Random random(bytes->byte());
    return random_ngon(random, 3 + static_cast<int>(bytes->below(12)), at, size);
  }
  const Vec3 u = bytes->point() * size;
  const Vec3 v = (kind == 2 ? bytes->tiny_point() : bytes->point()) * size; // 2: a sliver
  if (kind == 3)
    return {at, at + u, at + v};
  const double top = kind == 4 ? bytes->share() : 1; // 4: a trapezoid
  return {at, at + u, at + u * top + v, at + v};
}

Polygon decode_neighbour(ByteReader* bytes, const Polygon& of) {
  const std::size_t k = bytes->byte() % of.size(), next = (k + 1) % of.size();
  const Vec3 &a = of[k], &b = of[next];
  switch (bytes->below(5)) {
  case 0: { // across an edge
    const Vec3 v = bytes->point();
    return {b, a, a + v, b + v};
  }
  case 1: // at a corner
    return {a, a + bytes->point(), a + bytes->point()};
  case 2: { // in its plane
    const Vec3 shift = (b - a) * (4 * bytes->share());
    Polygon moved = of;
    for (Vec3& corner : moved)
      corner += shift;
    return moved;
  }
  case 3: { // over it
    const Vec3 shift = bytes->tiny_point();
    Polygon moved = reversed(of);
    for (Vec3& corner : moved)
      corner += shift;
    return moved;
  }
  default:
    return reversed(of);
  }
}

std::optional<PatchSet> patches_if_kept(const PolygonList& polygons) {
  for (const Polygon& polygon : polygons) {
    const radiosity::PolygonShape shape = radiosity::measure_polygon(polygon);
    for (std::size_t k = 0; k < polygon.size(); ++k)
      if (polygon[k] == polygon[(k + 1) % polygon.size()])
        return {};
    if (!has_area(polygon, shape) || !is_planar(polygon, shape) || !is_convex(polygon, shape))
      return {};
  }
  if (polygons.empty())
    return {};
  return patches_of(polygons);
}

} // namespace hemicube::test
