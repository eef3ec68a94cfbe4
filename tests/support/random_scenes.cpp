#include "tests/support/random_scenes.h"

#include "radiosity/hemicube/five_views.h"
#include "tests/support/occluder_scenes.h"
#include "tests/support/office.h"
#include "tests/support/polygon_shapes.h"
#include "tests/support/random_looks.h"

#include <cmath>

namespace hemicube::test {
namespace {

using Scenes = std::vector<RandomScene>;

RandomScene looked_at(PolygonSet polygons, RandomLooks& looks) {
  return {std::move(polygons), looks.take()};
}

/// Around the sizes of batches: clusters that are full, or hold one.
Scenes soups() {
  Scenes scenes;
  std::uint32_t seed = 300;
  for (const int count : {0, 1, 2, 15, 16, 17, 31, 33, 255, 256, 257})
    for (const bool dense : {false, true}) {
      RandomLooks looks(++seed, static_cast<std::uint32_t>(count));
      if (dense)
        looks.resolutions({34, 64, 130});
      looks.add_around({0, 0, 0}, 1.5, 3);
      scenes.push_back(looked_at(dense ? polygon_soup(seed, count, 2, 0.3, 1.8)
                                       : polygon_soup(seed, count, 2, 0.02, 0.2),
                                 looks));
    }
  return scenes;
}

Scenes large_soups() {
  Scenes scenes;
  for (const double size : {0.1, 0.6}) {
    RandomLooks looks(size < 0.5 ? 31 : 32, 5000);
    looks.resolutions({130, 64, 300, 34});
    looks.add_around({0, 0, 0}, 1.5, 4);
    scenes.push_back(looked_at(polygon_soup(330, 5000, 2, 0.1 * size, size), looks));
  }
  return scenes;
}

/// More clusters at once in sight than a queue of a few thousand holds: half of them show their
/// backs, and so wait until last.
Scenes crowd() {
  Random random(34);
  PolygonSet polygons;
  for (int k = 0; k < 90000; ++k)
    polygons.add(axis_rectangle(random, 2, random.point(-1, 1), random.between(1e-3, 6e-3)));
  RandomLooks looks(34, polygons.count());
  looks.resolutions({64});
  looks.add_unchanged(straight_view({0, 0, -2.5}));
  return {looked_at(polygons, looks)};
}

Scenes slivers() {
  Scenes scenes;
  for (const double aspect : {30.0, 1e3, 1e6}) {
    RandomLooks looks(static_cast<std::uint32_t>(aspect), 200);
    looks.add_around({0, 0, 0}, 1, 5);
    scenes.push_back(looked_at(sliver_soup(350, 200, aspect), looks));
  }
  return scenes;
}

/// Corners of polygons are padded to those of the cluster's largest.
Scenes three_to_forty_corners() {
  Random random(36);
  PolygonSet polygons;
  for (int k = 0; k < 300; ++k)
    polygons.add(random_ngon(random, 3 + static_cast<int>(random.index(38)), random.point(-2, 2),
                             random.between(0.05, 0.9)));
  RandomLooks looks(36, polygons.count());
  looks.add_around({0, 0, 0}, 1.5, 6);
  return {looked_at(polygons, looks)};
}

/// Copies in one place, turned and reversed: equal depths everywhere, and skip leaves out all.
Scenes duplicates() {
  Scenes scenes;
  for (const std::uint32_t seed : {37u, 38u, 39u}) {
    Random random(seed);
    PolygonSet originals = polygon_soup(seed, 40, 2, 0.2, 1.2), copies;
    for (int k = 0; k < 12; ++k) // of constant depth on one face
      originals.add(axis_rectangle(random, k % 3, random.point(-1.5, 1.5), random.between(0.2, 2)));
    for (std::uint32_t id = 0; id < originals.count(); ++id)
      for (std::uint32_t n = 0; n < 1 + id % 5; ++n) {
        const auto corners = static_cast<int>(originals.polygon(id).size());
        const auto copy = turned(originals.polygon(id), static_cast<int>(n) % corners);
        copies.add(random.index(2) == 0 ? copy : reversed(copy));
      }
    copies = reordered(copies, random_order(random, copies.count()));
    RandomLooks looks(seed, copies.count());
    for (int k = 0; k < 2; ++k) {
      raster::View view = straight_view(random.point(-1, 1));
      view.skip = random.index(copies.count());
      looks.add_unchanged(view);
    }
    looks.add_around({0, 0, 0}, 1, 3);
    scenes.push_back(looked_at(copies, looks));
  }
  return scenes;
}

/// Nothing has the size of anything else, and the eye may be far from all, or far from 0.
Scenes all_scales() {
  Scenes scenes;
  PolygonSet nested; // sizes in proportion to distance: 1e-4 .. 1e4
  Random random(40);
  for (int k = 0; k < 250; ++k) {
    const double scale = std::pow(10.0, random.between(-4, 4));
    nested.add(random_ngon(random, 3 + k % 3, random.point(-1, 1) * scale,
                           scale * random.between(0.05, 0.5)));
  }
  RandomLooks looks(40, nested.count());
  for (const double spread : {0.0, 1e-4, 1e-2, 1.0, 1e4})
    looks.add_around({0, 0, 0}, spread, 2);
  scenes.push_back(looked_at(nested, looks));
  // Details of 1e-4, looked at from among them, in a scene of 1e4: in single precision, seen from
  // the middle of the scene, they would lie anywhere.
  PolygonSet details =
      transformed(polygon_soup(43, 240, 10, 0.2, 3), 1e-4, {4000.7, -7000.3, 6911});
  for (int k = 0; k < 20; ++k)
    details.add(random_ngon(random, 3 + k, random.point(-1e4, 1e4), 3e3));
  RandomLooks among(43, details.count());
  among.add_around({4000.7, -7000.3, 6911}, 1e-3, 9);
  scenes.push_back(looked_at(details, among));
  for (const double factor : {1e-6, 1e6, 0x1p99, 0x1p-99}) {
    RandomLooks around(41, 100);
    around.add_around({0, 0, 0}, factor, 3);
    scenes.push_back(
        looked_at(transformed(polygon_soup(41, 100, 2, 0.1, 1.5), factor, {0, 0, 0}), around));
  }
  const Vec3 offset{1e6, -3e6, 2e5};
  RandomLooks aside(42, 150);
  aside.add_around(offset, 1, 3);
  scenes.push_back(looked_at(transformed(polygon_soup(42, 150, 2, 0.1, 1.5), 1, offset), aside));
  return scenes;
}

/// Views of a scene's patches, as rows are computed and with other switches.
RandomScene room(const Scene& scene, std::uint32_t seed, std::uint32_t view_count,
                 std::initializer_list<std::uint32_t> resolutions) {
  const PatchSet patches = patches_of(scene);
  RandomLooks looks(seed, patches.patch_count());
  looks.resolutions(resolutions);
  for (std::uint32_t k = 0; k < view_count; ++k) {
    const raster::View view =
        radiosity::hemicube_view(patches, looks.random().index(patches.patch_count()));
    if (k % 3 != 2)
      looks.add_unchanged(view);
    else
      looks.add(view);
  }
  return {polygons_of(scene), looks.take()};
}

Scenes rooms() {
  return {room(cube8(), 43, 5, {258, 64, 18, 300}), room(cornell_like(8), 44, 6, {130, 64, 34}),
          room(cornell_like(16), 45, 3, {512, 64, 258}),
          room(t_vertex_room(), 46, 4, {300, 64, 16}), room(l_room(4, 0.5, 1), 47, 4, {64, 258})};
}

/// Most of it hidden behind walls: from patches, doorways, and from outside.
Scenes offices() {
  const Scene scene = office({3, 2, 1, 0.7});
  RandomScene inside = room(scene, 48, 8, {64, 130, 258, 34});
  RandomLooks looks(49, inside.polygons.count());
  looks.resolutions({130, 64});
  const raster::View through_door = radiosity::hemicube_view({4.17, 3.3, 1.1}, {1, 0.1, 0});
  looks.add_unchanged(through_door);
  looks.add_unchanged(radiosity::hemicube_view({4.17, 3.3, 1.1}, {-0.2, 0.1, 1}));
  looks.add(radiosity::hemicube_view({1.7, 5.37, 0.9}, {0, -1, 0.2}));
  looks.add_unchanged(radiosity::hemicube_view({-4, -3, 1.5}, {0.6, 0.5, 0}));
  looks.add(radiosity::hemicube_view({6, 5, 40}, {0, 0, -1}));
  looks.add(radiosity::hemicube_view({4000, 100, 3}, {-1, 0, 0}));
  looks.add_camera(through_door);
  looks.add_camera(radiosity::hemicube_view({2, 2, 1.6}, {0.3, 1, 0}));
  looks.add_camera(radiosity::hemicube_view({-14, -13, 9}, {1, 1, -0.5}));
  for (Look& look : looks.take())
    inside.looks.push_back(std::move(look));
  return {inside};
}

} // namespace

const std::vector<RandomScenes> kRandomScenes = {
    {"soups", soups},
    {"large_soups", large_soups, false},
    {"crowd", crowd, false},
    {"slivers", slivers},
    {"three_to_forty_corners", three_to_forty_corners},
    {"duplicates", duplicates},
    {"all_scales", all_scales},
    {"rooms", rooms, false},
    {"offices", offices, false},
    {"nested_walls", nested_walls},
    {"walls_with_steep_things_behind", walls_with_steep_things_behind},
    {"steep_things_at_pixel_centres", steep_things_at_pixel_centres},
    {"grazing_walls", grazing_walls},
    {"cards", cards},
    {"window_edges", window_edges},
    {"near_the_horizon", near_the_horizon},
};

} // namespace hemicube::test
