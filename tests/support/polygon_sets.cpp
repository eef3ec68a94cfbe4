#include "tests/support/scenes_shared.h"

namespace hemicube::test {

void PolygonSet::add(std::span<const Vec3> polygon) {
  for (const Vec3& corner : polygon) {
    corners.push_back(static_cast<std::uint32_t>(vertices.size()));
    vertices.push_back(corner);
  }
  corner_offsets.push_back(static_cast<std::uint32_t>(corners.size()));
}

void PolygonSet::add(std::initializer_list<Vec3> polygon) {
  add(std::span<const Vec3>(polygon.begin(), polygon.size()));
}

std::vector<Vec3> PolygonSet::polygon(std::uint32_t id) const {
  std::vector<Vec3> result;
  for (std::uint32_t k = corner_offsets[id]; k < corner_offsets[id + 1]; ++k)
    result.push_back(vertices[corners[k]]);
  return result;
}

PolygonSet polygons_of(const Scene& scene) {
  PolygonSet set;
  set.vertices.assign(scene.vertices.begin(), scene.vertices.end());
  set.corners.assign(scene.corners.begin(), scene.corners.end());
  set.corner_offsets.clear();
  for (const std::uint64_t offset : scene.corner_offsets)
    set.corner_offsets.push_back(static_cast<std::uint32_t>(offset));
  return set;
}

std::array<Vec3, 3> random_frame(Random& random) {
  // A quaternion of integers / 64: the columns of its rotation matrix.
  double q[4];
  double norm = 0;
  while (norm < 0.25) {
    norm = 0;
    for (double& part : q) {
      part = random.between(-1, 1);
      norm += part * part;
    }
  }
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const Vec3 a{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
  const Vec3 b{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
  const Vec3 c{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
  return {unit(a), unit(b), unit(c)};
}

PolygonSet polygon_soup(std::uint32_t seed, int count, double spread, double size_low,
                        double size_high, const Vec3& centre) {
  // The corners of a regular-ish hexagon with rational coordinates; convex.
  static constexpr double kHexagon[6][2] = {{1, 0},  {0.5, 0.875},   {-0.5, 0.875},
                                            {-1, 0}, {-0.5, -0.875}, {0.5, -0.875}};
  Random random(seed);
  PolygonSet set;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = centre + random.point(-spread, spread);
    const auto frame = random_frame(random);
    const Vec3 u = frame[0] * random.between(size_low, size_high);
    const Vec3 v = frame[1] * random.between(size_low, size_high);
    switch (i % 3) {
    case 0:
      set.add({at, at + u, at + v});
      break;
    case 1:
      set.add({at, at + u, at + u + v, at + v});
      break;
    default: {
      std::vector<Vec3> hexagon;
      for (const auto& corner : kHexagon)
        hexagon.push_back(at + u * corner[0] + v * corner[1]);
      set.add(hexagon);
    }
    }
  }
  return set;
}

PolygonSet sliver_soup(std::uint32_t seed, int count, double aspect) {
  Random random(seed);
  PolygonSet set;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random.point(-1, 1);
    const auto frame = random_frame(random);
    const double length = random.between(0.5, 2);
    const Vec3 u = frame[0] * length;
    const Vec3 v = frame[1] * (length / aspect);
    if (i % 2 == 0)
      set.add({at, at + u, at + v});
    else
      set.add({at, at + u, at + u + v, at + v});
  }
  return set;
}

PolygonSet transformed(const PolygonSet& polygons, double factor, const Vec3& offset) {
  PolygonSet set = polygons;
  for (Vec3& vertex : set.vertices)
    vertex = vertex * factor + offset;
  return set;
}

} // namespace hemicube::test
