#include "radiosity/output/mesh_lines.h"

namespace hemicube::radiosity {

MeshLines::MeshLines(std::uint32_t samples, std::int32_t width, std::int32_t height) noexcept
    : samples_(static_cast<std::int32_t>(samples)), width_(width), height_(height) {
  // A disc of the diameter of a pixel: around the sample, or, for odd numbers, around the corner
  // between it and the next ones; either way a line takes `samples` of them across.
  const std::int32_t n = samples_, odd = n % 2;
  for (std::int32_t y = -n; y <= n; ++y)
    for (std::int32_t x = -n; x <= n; ++x) {
      const std::int32_t across = 2 * x - odd, down = 2 * y - odd;
      if (across * across + down * down <= n * n + odd && (x != 0 || y != 0))
        offsets_[offset_count_++] = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)};
    }
}

bool MeshLines::is_on_edge(const raster::ItemBuffer& buffer, std::int32_t x,
                           std::int32_t y) const noexcept {
  const std::int32_t left = buffer.window().x;
  const raster::Item own = buffer.items(y)[x - left];
  for (std::int32_t k = 0; k < offset_count_; ++k) {
    const std::int32_t other_x = x + offsets_[k].x, other_y = y + offsets_[k].y;
    if (other_x >= 0 && other_x < width_ && other_y >= 0 && other_y < height_ &&
        buffer.items(other_y)[other_x - left] != own)
      return true;
  }
  return false;
}

std::uint8_t MeshLines::count(const raster::ItemBuffer& buffer, std::int32_t x,
                              std::int32_t y) const noexcept {
  std::uint8_t count = 0;
  for (std::int32_t sy = y * samples_; sy < (y + 1) * samples_; ++sy)
    for (std::int32_t sx = x * samples_; sx < (x + 1) * samples_; ++sx)
      if (is_on_edge(buffer, sx, sy))
        ++count;
  return count;
}

void draw_mesh_lines(const Picture& picture, ColorImage* image) noexcept {
  // Strong enough to see, weak enough to leave the colour visible where lines are dense.
  constexpr std::uint32_t kStrength = 1, kFull = 2;
  const std::uint32_t samples = picture.samples * picture.samples;
  for (std::size_t i = 0; i < picture.lines.size(); ++i) {
    std::uint8_t* rgb = image->rgb.data() + 3 * i;
    const std::uint32_t brightness = (2 * rgb[0] + 7 * rgb[1] + rgb[2]) / 10u;
    const std::uint32_t ink = brightness < 128 ? 255 : 0;
    const std::uint32_t share = kStrength * picture.lines[i], whole = kFull * samples;
    for (int channel = 0; channel < 3; ++channel)
      rgb[channel] = static_cast<std::uint8_t>(
          (rgb[channel] * (whole - share) + ink * share + whole / 2) / whole);
  }
}

} // namespace hemicube::radiosity
