#pragma once

#include "tests/support/looks.h"

#include <initializer_list>

namespace hemicube::test {

/// Makes looks, each at the next of some resolutions and with switches at random. The resolutions
/// are such that windows are full, or not, and are multiples of tiles and vectors, or not.
class RandomLooks {
public:
  /// @param polygon_count  for View::skip
  RandomLooks(std::uint32_t seed, std::uint32_t polygon_count)
      : random_(seed), polygon_count_(polygon_count) {}

  Random& random() { return random_; }

  void resolutions(std::initializer_list<std::uint32_t> resolutions) {
    resolutions_ = resolutions;
    next_ = 0;
  }

  /// Adds the hemicube of a view, as it is but for the switches: above_horizon, draw_backs, skip.
  void add(raster::View view);
  /// Adds a view as it is.
  void add_unchanged(const raster::View& view);
  /// Adds one grid of any field of view along axis_z of a view; mostly without a horizon.
  void add_camera(raster::View view);
  /// Adds `count` views from random points of the cube of half side `spread` about `centre`, to all
  /// sides; every third a camera's.
  void add_around(const Vec3& centre, double spread, int count);

  std::vector<Look> take() { return std::move(looks_); }

private:
  Random random_;
  std::uint32_t polygon_count_;
  std::vector<std::uint32_t> resolutions_{64, 18, 130, 34, 50, 16, 96, 258};
  std::size_t next_ = 0;
  std::vector<Look> looks_;
};

/// The view along +z from a point, in the axes of coordinates: boxes are tight in it.
raster::View straight_view(const Vec3& eye = {0, 0, 0});

/// A view from a point in a random direction.
raster::View random_view(Random& random, const Vec3& eye);

/// The same polygons in another order: polygon k of the result is polygon order[k].
PolygonSet reordered(const PolygonSet& polygons, std::span<const std::uint32_t> order);

/// 0 .. count-1 in random order.
std::vector<std::uint32_t> random_order(Random& random, std::uint32_t count);

} // namespace hemicube::test
