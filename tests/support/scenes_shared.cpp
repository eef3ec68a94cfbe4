#include "tests/support/scenes_shared.h"

#include "radiosity/mesh/build_patches.h"

#include <stdexcept>
#include <string>

namespace hemicube::test {

void require(const Status& status) {
  if (!status.ok())
    throw std::runtime_error(std::string(status.message()));
}

double Random::unit() {
  return static_cast<double>(engine_() >> 8) * (1.0 / 16777216.0);
}

Vec3 Random::point(double low, double high) {
  const double x = between(low, high);
  const double y = between(low, high);
  const double z = between(low, high);
  return {x, y, z};
}

std::uint32_t Random::index(std::uint32_t count) {
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(engine_()) * count) >> 32);
}

SceneBuilder::SceneBuilder(std::uint32_t bands) {
  for (std::uint32_t band = 0; band < bands; ++band) {
    const std::string numbered = "b" + std::to_string(band);
    require(scene_.bands.add(bands == 3 ? std::string_view("rgb").substr(band, 1) : numbered));
    require(scene_.space_exitance.push_back(0));
  }
  require(scene_.groups.add(""));
  require(scene_.corner_offsets.push_back(0));
}

std::uint32_t SceneBuilder::material(std::string_view name, double reflectance, double exitance) {
  const std::vector<double> rho(scene_.band_count(), reflectance);
  const std::vector<double> light(scene_.band_count(), exitance);
  return material(name, rho, light);
}

std::uint32_t SceneBuilder::material(std::string_view name, std::span<const double> reflectance,
                                     std::span<const double> exitance) {
  const std::uint32_t index = scene_.materials.size();
  require(scene_.materials.add(name));
  require(scene_.reflectance.append(reflectance));
  require(scene_.exitance.append(exitance));
  require(scene_.two_sided.push_back(0));
  return index;
}

void SceneBuilder::two_sided(std::uint32_t material) {
  scene_.two_sided[material] = 1;
}

void SceneBuilder::face(std::uint32_t material, std::span<const Vec3> corners) {
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

void SceneBuilder::face(std::uint32_t material, std::initializer_list<Vec3> corners) {
  face(material, std::span<const Vec3>(corners.begin(), corners.size()));
}

namespace {

/// The k-th of n steps from a to b: the same bits as the (n-k)-th from b to a, exact at both ends
/// and in every coordinate that a and b share. So grids meet bit for bit and lie in their planes.
Vec3 step(const Vec3& a, const Vec3& b, int k, int n) {
  if (k == 0)
    return a;
  if (k == n)
    return b;
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = a[axis] == b[axis] ? a[axis] : (a[axis] * (n - k) + b[axis] * k) / n;
  return point;
}

} // namespace

void SceneBuilder::grid(std::uint32_t material, const Vec3& a, const Vec3& b, const Vec3& c,
                        const Vec3& d, int nu, int nv) {
  grid([=](int, int) { return material; }, a, b, c, d, nu, nv);
}

void SceneBuilder::grid(const std::function<std::uint32_t(int, int)>& material_of, const Vec3& a,
                        const Vec3& b, const Vec3& c, const Vec3& d, int nu, int nv) {
  const auto point = [&](int i, int j) {
    return step(step(a, d, j, nv), step(b, c, j, nv), i, nu);
  };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      face(material_of(i, j), {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
}

void SceneBuilder::box(const std::array<std::uint32_t, 6>& materials, const Vec3& low,
                       const Vec3& high, const std::array<int, 3>& cells, bool from_inside) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      Vec3 corner = low;
      corner[axis] = side == 0 ? low[axis] : high[axis];
      Vec3 along_u = corner, along_v = corner, along_both = corner;
      along_u[u] = along_both[u] = high[u];
      along_v[v] = along_both[v] = high[v];
      const std::uint32_t wall = materials[static_cast<std::size_t>(2 * axis + side)];
      const int nu = cells[static_cast<std::size_t>(u)];
      const int nv = cells[static_cast<std::size_t>(v)];
      // u, v, axis is right-handed: this order turns the front towards +axis.
      if ((side == 0) == from_inside)
        grid(wall, corner, along_u, along_both, along_v, nu, nv);
      else
        grid(wall, corner, along_v, along_both, along_u, nv, nu);
    }
  }
}

Scene SceneBuilder::finish() {
  return std::move(scene_);
}

Scene box_enclosure(const Vec3& size, int nx, int ny, int nz, double reflectance, double exitance) {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", reflectance, exitance);
  builder.box({wall, wall, wall, wall, wall, wall}, {0, 0, 0}, size, {nx, ny, nz}, true);
  return builder.finish();
}

Scene furnace_cube(int n, double reflectance, double exitance) {
  return box_enclosure({1, 1, 1}, n, n, n, reflectance, exitance);
}

Scene cube8() {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  const std::uint32_t ceiling = builder.material("ceiling", 0.5, 1);
  builder.box({wall, wall, wall, wall, wall, ceiling}, {0, 0, 0}, {1, 1, 1}, {8, 8, 8}, true);
  return builder.finish();
}

namespace {

/// A block on the floor z = 0: its four sides and its top, cells of equal counts.
void add_block(SceneBuilder& builder, std::uint32_t material, const Vec3& corner, const Vec3& along,
               double depth, double height, int cells, int cells_up) {
  const Vec3 across{-along.y * depth, along.x * depth, 0};
  const Vec3 up{0, 0, height};
  const std::array<Vec3, 4> foot{corner, corner + along, corner + along + across, corner + across};
  for (std::size_t side = 0; side < 4; ++side) {
    const Vec3& a = foot[side];
    const Vec3& b = foot[(side + 1) % 4];
    builder.grid(material, a, b, b + up, a + up, cells, cells_up);
  }
  builder.grid(material, foot[0] + up, foot[1] + up, foot[2] + up, foot[3] + up, cells, cells);
}

} // namespace

Scene cornell_like(int cells) {
  SceneBuilder builder;
  const double white[3] = {0.73, 0.73, 0.7}, red[3] = {0.58, 0.09, 0.06};
  const double green[3] = {0.13, 0.35, 0.12}, light[3] = {17, 12, 4}, dark[3] = {0, 0, 0};
  const std::uint32_t white_wall = builder.material("white", white, dark);
  const std::uint32_t red_wall = builder.material("red", red, dark);
  const std::uint32_t green_wall = builder.material("green", green, dark);
  const std::uint32_t lamp = builder.material("light", white, light);
  const double s = 0.5625;
  const int n = cells;
  builder.grid(white_wall, {0, 0, 0}, {s, 0, 0}, {s, s, 0}, {0, s, 0}, n, n); // floor
  builder.grid(red_wall, {0, s, 0}, {0, s, s}, {0, 0, s}, {0, 0, 0}, n, n);
  builder.grid(green_wall, {s, 0, 0}, {s, 0, s}, {s, s, s}, {s, s, 0}, n, n);
  builder.grid(white_wall, {0, s, 0}, {s, s, 0}, {s, s, s}, {0, s, s}, n, n); // back
  const auto lit = [&](int i, int j) { // 1/4 .. 3/4 across, 1/2 .. 3/4 deep
    return 4 * j >= n && 4 * j < 3 * n && 2 * i >= n && 4 * i < 3 * n;
  };
  builder.grid([&](int i, int j) { return lit(i, j) ? lamp : white_wall; }, {0, 0, s}, {0, s, s},
               {s, s, s}, {s, 0, s}, n, n); // ceiling
  const int block = n * 3 / 10;
  add_block(builder, white_wall, {0.125, 0.25, 0}, {0.8 * 0.16, 0.6 * 0.16, 0}, 1, 0.33, block,
            2 * block);
  add_block(builder, white_wall, {0.3125, 0.0625, 0}, {0.16 * 12 / 13, -0.16 * 5 / 13, 0}, 1, 0.165,
            block, block);
  return builder.finish();
}

Scene t_vertex_room(double scale, const Vec3& origin) {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", 0.5, 1);
  const Vec3 size{1.3, 1, 0.9};
  const auto at = [&](int x, int y, int z) {
    return origin + scale * Vec3{x * size.x, y * size.y, z * size.z};
  };
  builder.grid(wall, at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), 7, 7);
  builder.grid(wall, at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1), 4, 6);
  builder.grid(wall, at(0, 1, 0), at(0, 1, 1), at(0, 0, 1), at(0, 0, 0), 5, 5);
  builder.grid(wall, at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0), 5, 5);
  builder.grid(wall, at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0), 5, 5);
  builder.grid(wall, at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1), 5, 5);
  return builder.finish();
}

Scene l_room(int cells_per_metre, double reflectance, double exitance) {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", reflectance, exitance);
  const int n = cells_per_metre;
  const std::array<Vec3, 6> outline{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 1, 0},
                                    Vec3{1, 1, 0}, Vec3{1, 2, 0}, Vec3{0, 2, 0}};
  const Vec3 up{0, 0, 1};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& a = outline[i];
    const Vec3& b = outline[(i + 1) % outline.size()];
    const int along = static_cast<int>(glm::length(b - a)) * n;
    builder.grid(wall, a, a + up, b + up, b, n, along);
  }
  for (const Vec3& cell : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
    const Vec3 x{1, 0, 0}, y{0, 1, 0};
    builder.grid(wall, cell, cell + x, cell + x + y, cell + y, n, n);
    const Vec3 top = cell + up;
    builder.grid(wall, top, top + y, top + x + y, top + x, n, n);
  }
  return builder.finish();
}

PatchSet patches_of(const Scene& scene) {
  PatchSet patches;
  radiosity::MeshReport report;
  require(radiosity::build_patches(scene, &patches, &report));
  require(radiosity::add_back_sides(scene, &patches));
  return patches;
}

} // namespace hemicube::test
