#include "radiosity/output/unfolded_hemicube.h"

namespace hemicube::radiosity {

FacePixel unfolded_pixel(std::uint32_t resolution, std::uint32_t column,
                         std::uint32_t row) noexcept {
  using raster::Face;
  // Looking along +Z with X to the right, Y points down. A side's window has its horizon at y = 0
  // and meets the top in its last row; raster::to_face says which way its x runs along that edge.
  const auto full = static_cast<std::int32_t>(resolution), half = full / 2;
  const std::int32_t x = static_cast<std::int32_t>(column) - half; // in pixels of the top
  const std::int32_t y = static_cast<std::int32_t>(row) - half;
  const bool is_across = x >= 0 && x < full, is_along = y >= 0 && y < full;
  if (is_across && is_along)
    return {true, Face::kTop, x, y};
  if (is_along && x >= full)
    return {true, Face::kPlusX, y, full + half - 1 - x};
  if (is_along)
    return {true, Face::kMinusX, full - 1 - y, half + x};
  if (is_across && y >= full)
    return {true, Face::kPlusY, full - 1 - x, full + half - 1 - y};
  if (is_across)
    return {true, Face::kMinusY, x, half + y};
  return {};
}

} // namespace hemicube::radiosity
