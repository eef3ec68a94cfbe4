#include "tests/support/drawn_face.h"

#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cstring>

namespace hemicube::test {

bool same_bits(const DrawnFace& a, const DrawnFace& b) {
  return a.width == b.width && a.height == b.height && a.items == b.items &&
         a.depths.size() == b.depths.size() &&
         (a.depths.empty() ||
          std::memcmp(a.depths.data(), b.depths.data(), a.depths.size() * sizeof(float)) == 0);
}

Drawer::Drawer(const raster::Polygons& polygons, const raster::Kernels& kernels,
               raster::Culling culling) {
  require(tree_.build(polygons));
  require(rasterizer_.init(tree_, kernels, culling));
  require(buffer_.init());
}

DrawnFace Drawer::draw(raster::Face face, const raster::PixelGrid& grid, int window_width,
                       int window_height) {
  DrawnFace drawn{grid.width, grid.height, {}, {}};
  const auto count = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  drawn.items.resize(count);
  drawn.depths.resize(count);
  for (int y = 0; y < grid.height; y += window_height)
    for (int x = 0; x < grid.width; x += window_width) {
      const raster::Window window{x, y, std::min(window_width, grid.width - x),
                                  std::min(window_height, grid.height - y)};
      buffer_.begin(window);
      rasterizer_.draw(face, grid, &buffer_);
      for (int row = y; row < y + window.height; ++row) {
        const auto at = drawn.index(x, row);
        std::copy_n(buffer_.items(row), window.width, drawn.items.data() + at);
        std::copy_n(buffer_.depths(row), window.width, drawn.depths.data() + at);
      }
    }
  return drawn;
}

std::vector<std::string> kernels_here() {
  std::vector<std::string> names;
  for (const char* name : {"scalar", "sse41", "avx2", "avx512", "neon", "wasm"})
    if (raster::kernels_by_name(name) != nullptr)
      names.emplace_back(name);
  return names;
}

} // namespace hemicube::test
