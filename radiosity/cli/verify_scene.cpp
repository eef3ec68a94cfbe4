#include "radiosity/cli/verify_scene.h"

#include <array>
#include <cmath>
#include <new>

namespace hemicube::radiosity::cli {
namespace {

using Triangle = std::array<Vec3, 3>;

/// All that can fail in memory is memory.
void require(const Status& status) {
  if (!status.ok())
    throw std::bad_alloc();
}

/// The faces of an icosahedron, counter-clockwise seen from outside.
std::array<Triangle, 20> icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vec3, 12> v = {Vec3{-1, g, 0}, Vec3{1, g, 0}, Vec3{-1, -g, 0}, Vec3{1, -g, 0},
                                  Vec3{0, -1, g}, Vec3{0, 1, g}, Vec3{0, -1, -g}, Vec3{0, 1, -g},
                                  Vec3{g, 0, -1}, Vec3{g, 0, 1}, Vec3{-g, 0, -1}, Vec3{-g, 0, 1}};
  constexpr std::size_t kFaces[20][3] = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  std::array<Triangle, 20> triangles;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    triangles[k] = {v[kFaces[k][0]], v[kFaces[k][1]], v[kFaces[k][2]]};
  return triangles;
}

Vec3 on_sphere(const Vec3& point) {
  return point / std::sqrt(glm::dot(point, point));
}

} // namespace

VerifyScene::VerifyScene() {
  require(scene_.bands.add("grey"));
  require(scene_.groups.add(""));
  require(scene_.space_exitance.push_back(0));
  require(scene_.corner_offsets.push_back(0));
}

std::uint32_t VerifyScene::material(double reflectance, double exitance) {
  const std::uint32_t number = scene_.materials.size();
  require(scene_.materials.add(""));
  require(scene_.reflectance.push_back(reflectance));
  require(scene_.exitance.push_back(exitance));
  require(scene_.two_sided.push_back(0));
  return number;
}

void VerifyScene::face(std::uint32_t material, std::span<const Vec3> corners) {
  for (const Vec3& corner : corners) {
    const auto next = static_cast<std::uint32_t>(scene_.vertices.size());
    const auto found = vertex_of_.try_emplace({corner.x, corner.y, corner.z}, next);
    if (found.second)
      require(scene_.vertices.push_back(corner));
    require(scene_.corners.push_back(found.first->second));
  }
  require(scene_.corner_offsets.push_back(scene_.corners.size()));
  require(scene_.face_material.push_back(material));
  require(scene_.face_group.push_back(0));
}

void VerifyScene::box(std::uint32_t material, const Vec3& low, const Vec3& high, int cells,
                      bool from_inside) {
  // The same bits on both sides of an edge, and the box's own at its ends.
  const auto at = [&](int axis, int k) {
    return k == cells ? high[axis] : low[axis] + (high[axis] - low[axis]) * k / cells;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3; // u, v, axis: right-handed
    for (int side = 0; side < 2; ++side)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
          const auto corner = [&](int du, int dv) {
            Vec3 point;
            point[axis] = side == 0 ? low[axis] : high[axis];
            point[u] = at(u, i + du);
            point[v] = at(v, j + dv);
            return point;
          };
          if ((side == 0) == from_inside) // the front looks along +axis
            face(material, {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)});
          else
            face(material, {corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)});
        }
  }
}

void VerifyScene::sphere(const std::function<std::uint32_t(const Vec3& centre)>& material_of,
                         int level) {
  const std::function<void(const Triangle&, int)> add = [&](const Triangle& t, int halvings) {
    if (halvings == 0) {
      face(material_of((t[0] + t[1] + t[2]) / 3.0), {t[0], t[2], t[1]});
      return;
    }
    const Vec3 a = on_sphere(t[0] + t[1]), b = on_sphere(t[1] + t[2]), c = on_sphere(t[2] + t[0]);
    add({t[0], a, c}, halvings - 1);
    add({t[1], b, a}, halvings - 1);
    add({t[2], c, b}, halvings - 1);
    add({a, b, c}, halvings - 1);
  };
  for (const Triangle& t : icosahedron())
    add({on_sphere(t[0]), on_sphere(t[1]), on_sphere(t[2])}, level);
}

} // namespace hemicube::radiosity::cli
