#include "tests/support/occluder_scenes.h"

#include "tests/support/polygon_shapes.h"
#include "tests/support/random_looks.h"

#include <cmath>
#include <cstdlib>

namespace hemicube::test {
namespace {

/// An axis permutation, with a sign: side 0..5 of a cube for what was made for +z.
Vec3 to_side(int side, const Vec3& v) {
  const double sign = side < 3 ? 1 : -1;
  switch (side % 3) {
  case 0:
    return {v.x, v.y * sign, v.z * sign};
  case 1:
    return {v.z * sign, v.x, v.y * sign};
  default:
    return {v.y * sign, v.z * sign, v.x};
  }
}

std::vector<Vec3> to_side(int side, std::vector<Vec3> polygon) {
  for (Vec3& corner : polygon)
    corner = to_side(side, corner);
  return polygon;
}

PolygonSet shuffled(const PolygonSet& polygons, Random& random) {
  return reordered(polygons, random_order(random, polygons.count()));
}

/// One wall of n x n cards at z, over the square of half side `half`, bent towards the eye by
/// `tilt` over its width.
void add_wall(PolygonSet* polygons, int side, double z, double half, int n, double tilt,
              bool backs) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      auto cell = card(-half + 2 * half * i / n, -half + 2 * half * (i + 1) / n,
                       -half + 2 * half * j / n, -half + 2 * half * (j + 1) / n, z);
      for (Vec3& corner : cell)
        corner.z += tilt * corner.x;
      polygons->add(to_side(side, backs ? reversed(cell) : cell));
    }
}

} // namespace

std::vector<RandomScene> nested_walls() {
  static constexpr double kGaps[6] = {1e-3, 1e-5, 1e-6, 7e-7, 3e-7, 1e-7};
  std::vector<RandomScene> scenes;
  for (const std::uint32_t seed : {60u, 61u, 62u}) {
    Random random(seed);
    PolygonSet polygons;
    for (int side = 0; side < 6; ++side)
      for (int k = 0; k < 8; ++k) {
        const double z = 1 + kGaps[side] * k;
        const int cells = 1 + static_cast<int>(random.index(3));
        const double tilt = seed == 60 ? 0 : seed == 61 ? 0.3 : 0.3 * (1 + kGaps[side] * k);
        add_wall(&polygons, side, z, z * random.between(0.7, 1), cells, tilt, random.index(3) == 0);
      }
    polygons = shuffled(polygons, random);
    RandomLooks looks(seed, polygons.count());
    looks.resolutions({64, 130, 50});
    looks.add_unchanged(straight_view());
    raster::View turned = straight_view();
    turned.axis_x = {0.8, 0.6, 0};
    turned.axis_y = {-0.6, 0.8, 0};
    looks.add_unchanged(turned);
    turned.axis_y = {0, 0, -1};
    turned.axis_z = {-0.6, 0.8, 0};
    looks.add_unchanged(turned);
    looks.add_unchanged(straight_view({0, 0, -0.2}));
    looks.add_around({0, 0, 0}, 0.3, 2);
    scenes.push_back({polygons, looks.take()});
  }
  return scenes;
}

std::vector<RandomScene> walls_with_steep_things_behind() {
  std::vector<RandomScene> scenes;
  for (const bool meshed : {false, true}) {
    Random random(meshed ? 63 : 64);
    PolygonSet polygons;
    for (int side = 0; side < 6; ++side) {
      add_wall(&polygons, side, 1, 1, meshed ? 5 : 1, 0, side % 2 == 1);
      for (int k = 0; k < 40; ++k) {
        // From just behind the wall away from the eye, turned by so much that it can be seen.
        const double gap = std::pow(10.0, random.between(-7, -2));
        const Vec3 near = Vec3(random.between(-0.95, 0.95), random.between(-0.95, 0.95), 1) *
                          (1 + gap * (random.index(4) == 0 ? -1 : 1));
        const Vec3 aside(random.between(-1, 1), random.between(-1, 1), 0);
        const Vec3 along = near * random.between(0.05, 0.5) + aside * random.between(0.003, 0.1);
        const Vec3 across =
            unit(glm::cross(near, aside)) * std::pow(10.0, random.between(-2.5, -0.5));
        std::vector<Vec3> strip = {near, near + along, near + along + across, near + across};
        if (k % 2 == 0)
          strip.pop_back();
        polygons.add(to_side(side, k % 4 < 2 ? strip : reversed(strip)));
      }
    }
    polygons = shuffled(polygons, random);
    RandomLooks looks(63, polygons.count());
    looks.resolutions({130, 64, 258});
    looks.add_unchanged(straight_view());
    raster::View down = straight_view();
    down.axis_y = {0, -1, 0};
    down.axis_z = {0, 0, -1};
    looks.add_unchanged(down);
    looks.add_unchanged(straight_view({1e-4, -1e-4, 1e-5}));
    looks.add_around({0, 0, 0}, 0.01, 2);
    scenes.push_back({polygons, looks.take()});
  }
  return scenes;
}

std::vector<RandomScene> steep_things_at_pixel_centres() {
  constexpr std::uint32_t kResolution = 64;
  Random random(70);
  std::vector<RandomScene> scenes;
  for (int round = 0; round < 60; ++round) {
    PolygonSet polygons;
    Look look{straight_view(),
              {{raster::Face::kTop, raster::hemicube_grid(raster::Face::kTop, kResolution)}}};
    // Its 1/z is no round number: sums of floats, which are, can come out on either side of it.
    const double front = random.between(0.7, 1.3), z = 1 / front;
    const auto wall = card(-1.02 * z, 1.02 * z, -1.02 * z, 1.02 * z, z, round % 3 == 0 ? 4 : 40);
    polygons.add(round % 4 == 3 ? reversed(wall) : wall);
    for (int k = 0; k < 8; ++k) {
      // 1/z falls from `inverse` at the left edge, `inside` before the centre of a column, by
      // `slope`. What it is at the centre comes out within `off` of the wall's: after the 2^-21 of
      // the coefficients by which fronts are moved nearer, and cut off at the nearest corner.
      const int column = 2 + static_cast<int>(random.index(kResolution - 4));
      const double centre = -1 + (2.0 * column + 1) / kResolution;
      const double slope = std::pow(10.0, random.between(0.5, 3.5));
      const double inside = std::pow(10.0, random.between(-7, -3));
      const double off =
          std::pow(10.0, random.between(-8.5, -4.5)) * (random.index(2) == 0 ? -1 : 1);
      const bool facing = random.index(4) != 0;
      const double x = centre - inside;
      const double nudge = 0x1p-21 * (3 * slope + std::fabs(front + slope * x)) * (facing ? 1 : -1);
      const double inverse = random.index(2) == 0 ? (front + off) * (1 - 0x1p-16)
                                                  : front + off + slope * inside - nudge;
      const double near = 1 / inverse, far = 1.25 * z, end = x + (inverse - 1 / far) / slope;
      const int row = static_cast<int>(random.index(kResolution - 6));
      const double y0 = -1 + 2.0 * row / kResolution;
      const double y1 = y0 + 2.0 * (1 + random.index(6)) / kResolution;
      for (std::uint32_t copies = 1 + random.index(2); copies > 0; --copies) {
        std::vector<Vec3> strip = {Vec3(x * near, y0 * near, near), Vec3(x * near, y1 * near, near),
                                   Vec3(end * far, y1 * far, far)};
        const int cuts = static_cast<int>(random.index(36));
        for (int cut = 1; cut <= cuts; ++cut)
          strip.push_back({end * far, (y1 + (y0 - y1) * cut / (cuts + 1)) * far, far});
        strip.push_back({end * far, y0 * far, far});
        polygons.add(facing ? strip : reversed(strip));
      }
      if (k < 2) // a few pixels so close to the edge that all of them are cut off
        look.drawings.push_back(
            {raster::Face::kTop, {16, 16, x + 1e-9, 1e-9, 0.5 * (y0 + y1), 1e-9}});
    }
    scenes.push_back({shuffled(polygons, random), {look}});
  }
  return scenes;
}

std::vector<RandomScene> grazing_walls() {
  std::vector<RandomScene> scenes;
  for (const std::uint32_t seed : {65u, 66u}) {
    Random random(seed);
    PolygonSet polygons = polygon_soup(seed, 100, 2, 0.02, 0.4);
    for (int k = 0; k < 24; ++k) {
      const auto frame = random_frame(random);
      const Vec3 close = frame[2] * std::pow(10.0, random.between(-6, -0.5));
      const Vec3 away = frame[2] * std::pow(10.0, random.between(-7, -2));
      const Vec3 u = frame[0] * random.between(1, 20), v = frame[1] * random.between(1, 20);
      const Vec3 corner = close + frame[0] * random.between(-1, 0.5) - v * random.unit();
      const std::vector<Vec3> wall = {corner, corner + u, corner + u + v, corner + v};
      polygons.add(random.index(2) == 0 ? wall : reversed(wall));
      std::vector<Vec3> behind = wall;
      for (Vec3& point : behind)
        point = point + away;
      polygons.add(random.index(2) == 0 ? behind : reversed(behind));
    }
    polygons = shuffled(polygons, random);
    RandomLooks looks(seed, polygons.count());
    looks.resolutions({64, 130, 34});
    looks.add_unchanged(straight_view());
    for (int k = 0; k < 5; ++k)
      looks.add(random_view(random, {0, 0, 0}));
    looks.add_camera(random_view(random, {0, 0, 0}));
    scenes.push_back({polygons, looks.take()});
  }
  return scenes;
}

std::vector<RandomScene> cards() {
  static constexpr int kResolutions[] = {16, 18, 34, 64, 130};
  Random random(67);
  std::vector<RandomScene> scenes;
  for (int round = 0; round < 150; ++round) {
    const int resolution = kResolutions[random.index(5)];
    const auto side = [&](int pixel) { return -1 + 2.0 * pixel / resolution; };
    const auto any = [&](int from, int to) {
      return from + static_cast<int>(random.index(static_cast<std::uint32_t>(to - from)));
    };
    const auto looks_out = [&] { return any(0, 3) - (random.index(4) == 0 ? 6 : 0); };
    const auto add = [&](PolygonSet* set, int x0, int x1, int y0, int y1, double z) {
      // Different numbers of corners, so that each is in a cluster of its own.
      auto corners = card(side(x0) * z, side(x1) * z, side(y0) * z, side(y1) * z, z, any(4, 40));
      set->add(random.index(4) == 0 ? reversed(corners) : corners);
    };
    PolygonSet polygons;
    if (random.index(3) != 0)
      add(&polygons, -1, resolution + 1, -1, resolution + 1, 2 + random.unit());
    for (int k = 0; k < 3; ++k) {
      const int x0 = any(-3, resolution - 2), x1 = any(x0 + 2, resolution + 3);
      const int y0 = any(-3, resolution - 2), y1 = any(y0 + 2, resolution + 3);
      add(&polygons, x0, x1, y0, y1, random.between(1, 1.2));
      for (int n = 0; n < 3; ++n) // what looks out on one side or several, or not at all
        add(&polygons, x0 - looks_out(), x1 + looks_out(), y0 - looks_out(), y1 + looks_out(),
            random.between(1.2, 1.9));
      // A short one over the border.
      add(&polygons, x1 - 3, x1 + looks_out(), y0, y0 + any(1, 6), random.between(1.2, 1.9));
    }
    polygons = shuffled(polygons, random);
    Look look{straight_view(), {}};
    look.view.draw_backs = random.index(3) != 0;
    look.drawings.push_back(
        {raster::Face::kTop,
         raster::hemicube_grid(raster::Face::kTop, static_cast<std::uint32_t>(resolution))});
    scenes.push_back({polygons, {look}});
  }
  return scenes;
}

std::vector<RandomScene> window_edges() {
  Random random(68);
  std::vector<RandomScene> scenes;
  for (int round = 0; round < 60; ++round) {
    const int resolution = round % 4 == 0 ? 300 : round % 4 == 1 ? 258 : round % 4 == 2 ? 34 : 16;
    const int columns[] = {
        0, 1, 3, 4, 7, 8, 15, 16, 17, 31, 255, 256, 257, 299, resolution - 2, resolution - 1};
    PolygonSet polygons;
    for (int k = 0; k < 12; ++k) {
      const auto at = [&] {
        const int column = columns[random.index(16)];
        return -1 + 2.0 * (column % resolution + random.between(0.3, 0.7)) / resolution;
      };
      const double z = std::pow(10.0, random.between(-1, 3));
      const Vec3 centre = Vec3(at(), at(), 1) * z;
      polygons.add(random_ngon(random, 3 + static_cast<int>(random.index(38)), centre,
                               z * random.between(0.2, 2) / resolution));
    }
    Look look{straight_view(), hemicube_drawings(static_cast<std::uint32_t>(resolution))};
    scenes.push_back({polygons, {look}});
    if (round % 4 == 3) // the same of a camera, rows downwards
      scenes.back().looks.push_back(
          {straight_view(), {camera_drawing(resolution, resolution, 1, true)}});
  }
  return scenes;
}

std::vector<RandomScene> near_the_horizon() {
  std::vector<RandomScene> scenes;
  for (const double reach : {1.0, 1e4}) {
    Random random(69);
    PolygonSet polygons;
    for (int k = 0; k < 330; ++k) {
      // Its highest corner stands around 2^-20 of its distance above the plane z = 0.
      const double distance = std::pow(10.0, random.between(-2, 0)) * (k < 10 ? reach : 1);
      const double angle_x = random.between(-1, 1), angle_y = random.between(-1, 1);
      const Vec3 top = unit(Vec3(angle_x, angle_y, 0) + Vec3(1e-3, 0, 0)) * distance +
                       Vec3(0, 0, distance * 0x1p-20 * random.between(0.5, 4));
      const Vec3 wide = Vec3(-angle_y, angle_x, 0) * distance * random.between(0.05, 0.5);
      const Vec3 low(0, 0, -distance * random.between(1e-7, 1e-3));
      std::vector<Vec3> polygon = {top, top + low + wide, top + low - wide};
      if (k % 3 == 0)
        polygon = {top, top + low, top + low + wide, top + wide};
      polygons.add(k % 2 == 0 ? polygon : reversed(polygon));
    }
    // A tower: the middle of the scene is far from the plane, too.
    polygons.add({{reach, 0, 0}, {reach, 0.1, 0}, {reach, 0, reach}});
    Look look{straight_view(), {}};
    for (const raster::Face face : kFaces) {
      raster::PixelGrid grid = raster::hemicube_grid(face, 64);
      if (face != raster::Face::kTop) {
        grid.dy = 1e-7;
        grid.y0 = 0.5 * grid.dy;
      }
      look.drawings.push_back({face, grid});
    }
    RandomScene scene{polygons, {look}};
    look.view.axis_x = {0.8, 0.6, 0};
    look.view.axis_y = {-0.6, 0.8, 0};
    look.view.draw_backs = false;
    scene.looks.push_back(look);
    scenes.push_back(scene);
  }
  return scenes;
}

} // namespace hemicube::test
