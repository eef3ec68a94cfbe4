#include "tests/support/raster_cases.h"

#include <algorithm>

namespace hemicube::test {

namespace {

std::vector<raster::View> random_views(std::uint32_t seed, int count, double spread,
                                       const Vec3& centre = {0, 0, 0}) {
  Random random(seed);
  std::vector<raster::View> views;
  for (int i = 0; i < count; ++i) {
    raster::View view;
    view.eye = centre + random.point(-spread, spread);
    const auto frame = random_frame(random);
    view.axis_x = frame[0];
    view.axis_y = frame[1];
    view.axis_z = frame[2];
    views.push_back(view);
  }
  return views;
}

/// Views from some patches of a scene, spread over all.
std::vector<raster::View> patch_views(const Scene& scene, std::uint32_t count) {
  const PatchSet patches = patches_of(scene);
  std::vector<raster::View> views;
  for (std::uint32_t k = 0; k < count; ++k)
    views.push_back(
        radiosity::hemicube_view(patches, (2 * k + 1) * patches.patch_count() / (2 * count)));
  return views;
}

RasterCase soup() {
  return {"soup", polygon_soup(1, 150, 2, 0.1, 1.5), random_views(101, 4, 1), true};
}

// Many polygons pass through, behind and beside the eye; the plane of each face cuts most of them.
RasterCase through_the_eye_plane() {
  return {"through_the_eye_plane", polygon_soup(2, 60, 1, 2, 8), random_views(102, 4, 0.5), true};
}

// A patch in the middle of a floor of large polygons that all touch or cross its plane.
RasterCase touching_the_eye_plane() {
  PolygonSet polygons;
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const double x = random.between(-2, 2), y = random.between(-2, 2);
    const double dx = random.between(-1, 1), dy = random.between(-1, 1);
    polygons.add({{x, y, 0}, {x + dx, y + dy, 0}, {x + dx, y + dy, 1}, {x, y, 1}}); // walls
    polygons.add({{x, y, 0}, {x + dx, y, 0}, {x, y + dy, random.unit()}}); // one edge in it
    polygons.add({{y, x, 0}, {y + dx, x, 0.5}, {y, x + dy, -0.5}});        // a corner in it
  }
  RasterCase scene{"touching_the_eye_plane", polygons, {{}}, true};
  raster::View turned;
  turned.axis_x = {0.8, 0.6, 0};
  turned.axis_y = {-0.6, 0.8, 0};
  scene.views.push_back(turned);
  return scene;
}

RasterCase behind() {
  PolygonSet polygons = polygon_soup(4, 100, 2, 0.1, 1);
  double highest = 0;
  for (const Vec3& vertex : polygons.vertices)
    highest = std::max(highest, vertex.z);
  for (Vec3& vertex : polygons.vertices) // together: polygons stay flat
    vertex.z -= highest + 0.01;
  return {"behind", polygons, {{}}, true};
}

RasterCase slivers() {
  return {"slivers", sliver_soup(5, 200, 1e4), random_views(105, 4, 1), true};
}

RasterCase huge_coordinates() {
  RasterCase scene{"huge_coordinates",
                   transformed(polygon_soup(6, 100, 2, 0.1, 1.5), 1e6, {0, 0, 0}),
                   random_views(106, 3, 1e6), true};
  return scene;
}

RasterCase tiny_coordinates() {
  return {"tiny_coordinates", transformed(polygon_soup(7, 100, 2, 0.1, 1.5), 1e-6, {0, 0, 0}),
          random_views(107, 3, 1e-6), true};
}

// Far from the origin: positions are kept to 1e-10 of their size only, the eye among them.
RasterCase far_from_the_origin() {
  const Vec3 offset{1e6, -1e6, 5e5};
  return {"far_from_the_origin", transformed(polygon_soup(8, 100, 2, 0.1, 1.5), 1, offset),
          random_views(108, 3, 1, offset), true};
}

RasterCase cube() {
  return {"cube", polygons_of(cube8()), patch_views(cube8(), 6)};
}

RasterCase cornell() {
  const Scene scene = cornell_like(8);
  return {"cornell", polygons_of(scene), patch_views(scene, 6)};
}

RasterCase t_room() {
  const Scene scene = t_vertex_room();
  return {"t_room", polygons_of(scene), patch_views(scene, 6)};
}

ClosedScene closed_cube() {
  return {"cube", cube8()};
}
ClosedScene closed_box() {
  return {"box", box_enclosure({3.1, 0.7, 0.13}, 9, 5, 2, 0.5, 1)};
}
ClosedScene closed_l_room() {
  return {"l_room", l_room(4, 0.5, 1)};
}
ClosedScene single_quads() {
  return {"six_quads", furnace_cube(1, 0.5, 1)};
}

/// A box whose walls are cut into triangles, diagonals in both directions, far from the origin.
ClosedScene triangle_box() {
  const PolygonSet quads = polygons_of(box_enclosure({1, 0.3, 0.7}, 5, 4, 3, 0.5, 1));
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", 0.5, 1);
  for (std::uint32_t id = 0; id < quads.count(); ++id) {
    auto q = quads.polygon(id);
    for (Vec3& corner : q)
      corner = corner * 17.3 + Vec3{1234.5, -777.7, 0.1};
    const std::size_t k = id % 2;
    builder.face(wall, {q[k], q[k + 1], q[k + 2]});
    builder.face(wall, {q[k], q[k + 2], q[(k + 3) % 4]});
  }
  return {"triangle_box", builder.finish()};
}

/// A block that floats in a box, seen from outside, in a box seen from inside.
ClosedScene block_in_a_box() {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", 0.5, 1);
  builder.box({wall, wall, wall, wall, wall, wall}, {0, 0, 0}, {1, 1, 1}, {4, 5, 6}, true);
  builder.box({wall, wall, wall, wall, wall, wall}, {0.31, 0.22, 0.13}, {0.61, 0.72, 0.83},
              {3, 3, 3}, false);
  return {"block_in_a_box", builder.finish()};
}

} // namespace

RasterCase (*const kRasterCases[11])() = {soup,
                                          through_the_eye_plane,
                                          touching_the_eye_plane,
                                          behind,
                                          slivers,
                                          huge_coordinates,
                                          tiny_coordinates,
                                          far_from_the_origin,
                                          cube,
                                          cornell,
                                          t_room};

ClosedScene (*const kClosedScenes[6])() = {closed_cube,  closed_box,   closed_l_room,
                                           single_quads, triangle_box, block_in_a_box};

} // namespace hemicube::test
