#include "tests/support/shadow_rooms.h"

#include "tests/support/polygon_of.h"

#include <cmath>

namespace hemicube::test {

void add_box(SceneBuilder* builder, std::uint32_t material, const Vec3& corner,
             const std::array<Vec3, 3>& edges) {
  const auto& [x, y, z] = edges;
  const Vec3& o = corner;
  builder->face(material, {o, o + y, o + x + y, o + x});
  builder->face(material, {o + z, o + x + z, o + x + y + z, o + y + z});
  builder->face(material, {o, o + x, o + x + z, o + z});
  builder->face(material, {o + y, o + y + z, o + x + y + z, o + x + y});
  builder->face(material, {o, o + z, o + y + z, o + y});
  builder->face(material, {o + x, o + x + y, o + x + y + z, o + x + z});
}

Scene scaled(Scene scene, double factor) {
  for (Vec3& vertex : scene.vertices)
    vertex *= factor;
  return scene;
}

Scene crooked_sheet(std::uint32_t seed) {
  constexpr int kCells = 4;
  Random random(seed);
  const auto frame = random_frame(random);
  Vec3 points[kCells + 1][kCells + 1];
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      points[i][j] =
          (i + random.between(-0.2, 0.2)) * frame[0] + (j + random.between(-0.2, 0.2)) * frame[1];
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const Vec3 &a = points[i][j], &b = points[i + 1][j], &c = points[i + 1][j + 1],
                 &d = points[i][j + 1];
      if (random.index(2) == 0) {
        builder.face(grey, {a, b, c, d});
      } else {
        builder.face(grey, {a, b, c});
        builder.face(grey, {a, c, d});
      }
    }
  return builder.finish();
}

Scene random_box_room(std::uint32_t seed) {
  Random random(seed);
  SceneBuilder builder(1);
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.2, 10);
  const std::uint32_t box = builder.material("box", 0.4, 0);
  builder.box({wall, wall, wall, wall, wall, wall}, {0, 0, 0}, {4, 3, 2.5}, {3, 3, 2}, true);
  const Vec3 at(random.between(1, 2.5), random.between(0.8, 1.7), 2.375);
  const double size = random.between(0.1, 0.6);
  builder.face(lamp, {at, at + Vec3(0, size, 0), at + Vec3(size, size, 0), at + Vec3(size, 0, 0)});
  const std::uint32_t count = 1 + random.index(4);
  for (std::uint32_t k = 0; k < count; ++k) {
    const double height = random.between(0.2, 1);
    std::array<Vec3, 3> edges = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const std::uint32_t kind = random.index(3);
    if (kind == 1) {
      const Vec3 along = unit(Vec3(random.between(-1, 1), random.between(0.1, 1), 0));
      edges = {along, Vec3(-along.y, along.x, 0), Vec3(0, 0, 1)};
    } else if (kind == 2) {
      edges = random_frame(random);
    }
    edges[0] *= random.between(0.1, 0.8);
    edges[1] *= random.between(0.1, 0.8);
    edges[2] *= height;
    Vec3 corner(random.between(0.9, 3), random.between(0.9, 2), 0);
    if (kind == 2 || random.index(2) == 0)
      corner.z = random.between(0.9, 1.1);
    add_box(&builder, box, corner, edges);
  }
  return builder.finish();
}

bool is_hidden(const PatchSet& patches, const Vec3& from, const Vec3& to, double doubt) {
  for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
    const Vec3 &normal = patches.normal[p], &origin = patches.centre[p];
    const double side_from = glm::dot(normal, from - origin);
    const double side_to = glm::dot(normal, to - origin);
    if (!(side_from * side_to < 0) || std::fabs(side_from) < doubt || std::fabs(side_to) < doubt)
      continue;
    const Vec3 at = from + (to - from) * (side_from / (side_from - side_to));
    bool is_inside = true;
    const std::vector<Vec3> points = polygon_of(patches, p);
    for (std::size_t k = 0; k < points.size() && is_inside; ++k)
      is_inside = glm::dot(normal, glm::cross(points[(k + 1) % points.size()] - points[k],
                                              at - points[k])) > 0;
    if (is_inside)
      return true;
  }
  return false;
}

std::vector<Vec3> inner_points(const std::vector<Vec3>& polygon, const Vec3& normal, double margin,
                               Random* random) {
  std::vector<Vec3> points;
  for (int tries = 0; tries < 40 && points.size() < 6; ++tries) {
    Vec3 sum(0);
    double weights = 0;
    for (const Vec3& corner : polygon) {
      const double weight = random->unit() * random->unit();
      sum += weight * corner;
      weights += weight;
    }
    const Vec3 point = sum / weights;
    bool is_inner = true;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
      is_inner = is_inner && glm::dot(glm::cross(normal, edge), point - polygon[k]) >
                                 margin * glm::length(edge);
    }
    if (is_inner)
      points.push_back(point);
  }
  return points;
}

} // namespace hemicube::test
