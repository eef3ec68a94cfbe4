#include "tests/support/ladder_scenes.h"

#include "tests/support/polygon_shapes.h"

namespace hemicube::test {

PolygonList open_scene() {
  PolygonList scene = rectangle_grid(0, 0, 2, 2, 4, 4);
  const auto stand_up = [](PolygonList polygons) {
    return turned(std::move(polygons), {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}});
  };
  append(&scene, stand_up(rectangle_grid(0, 0, 2, 1, 3, 2)));
  append(&scene, reversed(moved(rectangle_grid(0.5, 0.5, 1, 1.1, 2, 2), 1, {0, 0, 1.5})));
  append(&scene, {{{0.4, 0.4, 0.7}, {1.1, 0.4, 0.8}, {1.1, 1.1, 0.8}, {0.4, 1.1, 0.7}}});
  append(&scene, {{{9, 9, 9}, {10, 9, 9}, {9, 10, 9}}});
  return scene;
}

PolygonList tiny_scene() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          {{0.1, 0, 1}, {0.1, 0.8, 1}, {1, 0.8, 1}, {1, 0, 1}},
          {{0.4, 0.4, 0.5}, {0.5, 0.4, 0.5}, {0.5, 0.5, 0.5}, {0.4, 0.5, 0.5}}};
}

PolygonList l_shaped() {
  return list_of(patches_of(l_room(1, 0.5, 1)));
}

PolygonList t_vertices() {
  return list_of(patches_of(t_vertex_room()));
}

PolygonList random_soup() {
  Random random(3);
  PolygonList polygons;
  for (int k = 0; k < 24; ++k)
    polygons.push_back(random_ngon(random, 3 + static_cast<int>(random.index(6)),
                                   random.point(-1, 1), random.between(0.05, 0.7)));
  return polygons;
}

} // namespace hemicube::test
