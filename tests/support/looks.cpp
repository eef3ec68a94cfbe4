#include "tests/support/looks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>

namespace hemicube::test {

using raster::kNoItem;

std::vector<Drawing> hemicube_drawings(std::uint32_t resolution) {
  std::vector<Drawing> drawings;
  for (const raster::Face face : kFaces)
    drawings.push_back({face, raster::hemicube_grid(face, resolution)});
  return drawings;
}

Drawing camera_drawing(int width, int height, double half_height, bool downwards) {
  const double step = 2 * half_height / height;
  raster::PixelGrid grid{width, height, -0.5 * step * (width - 1), step, 0, step};
  if (downwards)
    grid.dy = -step;
  grid.y0 = -0.5 * grid.dy * (height - 1);
  return {raster::Face::kTop, grid};
}

std::vector<DrawnFace> draw_look(Drawer* drawer, const Look& look, int window_width,
                                 int window_height) {
  drawer->begin(look.view);
  std::vector<DrawnFace> drawn;
  for (const Drawing& drawing : look.drawings)
    drawn.push_back(drawer->draw(drawing.face, drawing.grid, window_width, window_height));
  return drawn;
}

namespace {

/// Puts a polygon that was drawn alone into the whole, as number `id`.
void put(const DrawnFace& part, std::uint32_t id, bool backs, DrawnFace* whole) {
  for (std::size_t i = 0; i < part.items.size(); ++i) {
    if (part.items[i] == kNoItem || (raster::is_back_facing(part.items[i]) && !backs))
      continue;
    const raster::Item item = part.items[i] + id;
    if (part.depths[i] > whole->depths[i] ||
        (part.depths[i] == whole->depths[i] && item < whole->items[i])) {
      whole->items[i] = item;
      whole->depths[i] = part.depths[i];
    }
  }
}

/// The vertices of a polygon, whatever its first corner and its direction.
std::vector<Vec3> sorted_vertices(std::vector<Vec3> polygon) {
  std::sort(polygon.begin(), polygon.end(), [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  return polygon;
}

enum class Horizon : std::uint8_t { kAbove, kBelow, kTooCloseToSay };

/// Whether a vertex rises above the plane axis_z = 0 by more than 2^-20 of its distance.
Horizon side_of_horizon(const std::vector<Vec3>& polygon, const raster::View& view) {
  Horizon found = Horizon::kBelow;
  for (const Vec3& vertex : polygon) {
    long double height = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const long double d =
          static_cast<long double>(vertex[axis]) - static_cast<long double>(view.eye[axis]);
      height += d * static_cast<long double>(view.axis_z[axis]);
      square += d * d;
    }
    const long double least = 0x1p-20L * std::sqrt(square);
    if (height > least * (1 + 1e-8L))
      return Horizon::kAbove;
    if (height >= least * (1 - 1e-8L))
      found = Horizon::kTooCloseToSay;
  }
  return found;
}

} // namespace

std::vector<DrawnFace> composed_look(const PolygonSet& polygons, const Look& look) {
  std::vector<DrawnFace> whole;
  for (const Drawing& drawing : look.drawings) {
    const auto size = static_cast<std::size_t>(drawing.grid.width) *
                      static_cast<std::size_t>(drawing.grid.height);
    whole.push_back({drawing.grid.width, drawing.grid.height,
                     std::vector<raster::Item>(size, kNoItem), std::vector<float>(size, 0.0f)});
  }
  std::vector<Vec3> skipped;
  if (look.view.skip < polygons.count())
    skipped = sorted_vertices(polygons.polygon(look.view.skip));
  for (std::uint32_t id = 0; id < polygons.count(); ++id) {
    const std::vector<Vec3> corners = polygons.polygon(id);
    if (sorted_vertices(corners) == skipped)
      continue;
    Look lone_look = look;
    lone_look.view.skip = kNoItem;
    lone_look.view.draw_backs = true;
    if (look.view.above_horizon) {
      const Horizon horizon = side_of_horizon(corners, look.view);
      if (horizon == Horizon::kBelow)
        continue;
      lone_look.view.above_horizon = horizon == Horizon::kTooCloseToSay;
    }
    PolygonSet lone;
    lone.add(corners);
    Drawer drawer(lone.view(), *raster::kernels_by_name("scalar"), raster::Culling::kOff);
    const std::vector<DrawnFace> parts = draw_look(&drawer, lone_look);
    for (std::size_t k = 0; k < parts.size(); ++k)
      put(parts[k], id, look.view.draw_backs, &whole[k]);
  }
  return whole;
}

std::string difference(const DrawnFace& expected, const DrawnFace& actual) {
  if (same_bits(expected, actual))
    return "";
  std::size_t count = 0, first = 0;
  for (std::size_t i = expected.items.size(); i-- > 0;)
    if (expected.items[i] != actual.items[i] ||
        std::bit_cast<std::uint32_t>(expected.depths[i]) !=
            std::bit_cast<std::uint32_t>(actual.depths[i])) {
      ++count;
      first = i;
    }
  const auto width = static_cast<std::size_t>(expected.width);
  std::ostringstream text;
  text << count << " pixels differ, first (" << first % width << ", " << first / width
       << "): expected item " << std::hex << expected.items[first] << ", 1/z " << std::hexfloat
       << expected.depths[first] << "; actual item " << actual.items[first] << ", 1/z "
       << actual.depths[first];
  return text.str();
}

std::string difference(const Look& look, const std::vector<DrawnFace>& expected,
                       const std::vector<DrawnFace>& actual) {
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const std::string what = difference(expected[k], actual[k]);
    if (what.empty())
      continue;
    const raster::View& v = look.view;
    const raster::PixelGrid& grid = look.drawings[k].grid;
    std::ostringstream text;
    text << what << std::hexfloat << "\n  face " << static_cast<int>(look.drawings[k].face)
         << ", grid " << grid.width << " x " << grid.height << ", x " << grid.x0 << " + i "
         << grid.dx << ", y " << grid.y0 << " + j " << grid.dy << "\n  eye " << v.eye.x << " "
         << v.eye.y << " " << v.eye.z;
    for (const Vec3& axis : {v.axis_x, v.axis_y, v.axis_z})
      text << "; axis " << axis.x << " " << axis.y << " " << axis.z;
    text << "\n  skip " << std::hex << v.skip << (v.above_horizon ? ", above the horizon" : "")
         << (v.draw_backs ? ", with backs" : "");
    return text.str();
  }
  return "";
}

} // namespace hemicube::test
