#include "tests/support/polygon_lists.h"

#include <algorithm>
#include <cmath>

namespace hemicube::test {

PatchSet patches_of(const PolygonList& polygons) {
  Scene scene;
  require(scene.two_sided.push_back(0));
  require(scene.corner_offsets.push_back(0));
  for (const Polygon& polygon : polygons) {
    for (const Vec3& point : polygon) {
      require(scene.corners.push_back(static_cast<std::uint32_t>(scene.vertices.size())));
      require(scene.vertices.push_back(point));
    }
    require(scene.corner_offsets.push_back(scene.corners.size()));
    require(scene.face_material.push_back(0));
    require(scene.face_group.push_back(0));
  }
  return patches_of(scene);
}

PolygonList list_of(const PatchSet& patches) {
  PolygonList list;
  for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
    list.emplace_back();
    for (const std::uint32_t corner : patches.corners_of(p))
      list.back().push_back(patches.vertices[corner]);
  }
  return list;
}

PolygonList moved(PolygonList polygons, double scale, const Vec3& offset) {
  for (Polygon& polygon : polygons)
    for (Vec3& point : polygon)
      point = scale * point + offset;
  return polygons;
}

PolygonList turned(PolygonList polygons, const std::array<Vec3, 3>& frame) {
  for (Polygon& polygon : polygons)
    for (Vec3& point : polygon)
      point = frame[0] * point.x + frame[1] * point.y + frame[2] * point.z;
  return polygons;
}

PolygonList shuffled(PolygonList polygons, std::uint32_t seed) {
  Random random(seed);
  for (std::size_t k = polygons.size(); k > 1; --k)
    std::swap(polygons[k - 1], polygons[random.index(static_cast<std::uint32_t>(k))]);
  return polygons;
}

PolygonList reversed(PolygonList polygons) {
  for (Polygon& polygon : polygons)
    std::reverse(polygon.begin(), polygon.end());
  return polygons;
}

PolygonList without(const PolygonList& polygons, std::initializer_list<int> removed) {
  PolygonList left;
  for (int k = 0; k < static_cast<int>(polygons.size()); ++k)
    if (std::find(removed.begin(), removed.end(), k) == removed.end())
      left.push_back(polygons[static_cast<std::size_t>(k)]);
  return left;
}

void append(PolygonList* polygons, PolygonList more) {
  for (Polygon& polygon : more)
    polygons->push_back(std::move(polygon));
}

PolygonList rectangle_grid(double low_x, double low_y, double high_x, double high_y, int nx,
                           int ny) {
  const auto x = [&](int i) { return i == nx ? high_x : low_x + (high_x - low_x) * i / nx; };
  const auto y = [&](int j) { return j == ny ? high_y : low_y + (high_y - low_y) * j / ny; };
  PolygonList grid;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      grid.push_back(
          {{x(i), y(j), 0}, {x(i + 1), y(j), 0}, {x(i + 1), y(j + 1), 0}, {x(i), y(j + 1), 0}});
  return grid;
}

PolygonList in_triangles(const PolygonList& polygons, std::uint32_t seed) {
  Random random(seed);
  PolygonList triangles;
  for (const Polygon& quad : polygons) {
    if (quad.size() != 4) {
      triangles.push_back(quad);
      continue;
    }
    const std::size_t first = random.index(2);
    for (const std::size_t start : {first, first + 2})
      triangles.push_back({quad[start], quad[(start + 1) % 4], quad[(start + 2) % 4]});
  }
  return triangles;
}

Polygon regular(int corners) {
  Polygon polygon;
  for (int k = 0; k < corners; ++k)
    polygon.push_back({2 + std::cos(2 * M_PI * k / corners), std::sin(2 * M_PI * k / corners), 1});
  return polygon;
}

} // namespace hemicube::test
