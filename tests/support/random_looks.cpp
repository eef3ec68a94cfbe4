#include "tests/support/random_looks.h"

#include <utility>

namespace hemicube::test {

void RandomLooks::add(raster::View view) {
  const std::uint32_t switches = random_.index(16);
  view.above_horizon = (switches & 1) == 0;
  view.draw_backs = (switches & 2) == 0;
  if (switches >= 12 && polygon_count_ > 0)
    view.skip = random_.index(polygon_count_);
  add_unchanged(view);
}

void RandomLooks::add_unchanged(const raster::View& view) {
  looks_.push_back({view, hemicube_drawings(resolutions_[next_++ % resolutions_.size()])});
}

void RandomLooks::add_camera(raster::View view) {
  static constexpr double kHalfHeights[] = {0.05, 0.2, 0.58, 1, 2.5, 11};
  view.above_horizon = random_.index(4) == 0;
  view.draw_backs = random_.index(3) == 0;
  const int width = 1 + static_cast<int>(random_.index(300));
  const int height = 1 + static_cast<int>(random_.index(280));
  looks_.push_back(
      {view,
       {camera_drawing(width, height, kHalfHeights[random_.index(6)], random_.index(2) == 0)}});
}

void RandomLooks::add_around(const Vec3& centre, double spread, int count) {
  for (int k = 0; k < count; ++k) {
    const raster::View view = random_view(random_, centre + random_.point(-spread, spread));
    if (k % 3 == 2)
      add_camera(view);
    else
      add(view);
  }
}

raster::View straight_view(const Vec3& eye) {
  raster::View view;
  view.eye = eye;
  return view;
}

raster::View random_view(Random& random, const Vec3& eye) {
  const auto frame = random_frame(random);
  raster::View view = straight_view(eye);
  view.axis_x = frame[0];
  view.axis_y = frame[1];
  view.axis_z = frame[2];
  return view;
}

PolygonSet reordered(const PolygonSet& polygons, std::span<const std::uint32_t> order) {
  PolygonSet result;
  for (const std::uint32_t id : order)
    result.add(polygons.polygon(id));
  return result;
}

std::vector<std::uint32_t> random_order(Random& random, std::uint32_t count) {
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i)
    order[i] = i;
  for (std::uint32_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[random.index(i)]);
  return order;
}

} // namespace hemicube::test
