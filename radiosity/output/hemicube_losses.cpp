#include "radiosity/output/hemicube_losses.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

constexpr double kUnit = 0x1p-48; ///< of weights

/// The direction of a pixel in the axes of the scene, of length 1.
Vec3 direction_of(raster::Face face, std::int32_t x, std::int32_t y, std::uint32_t resolution,
                  const raster::View& view) {
  const raster::PixelGrid grid = raster::hemicube_grid(face, resolution);
  const Vec3 v = raster::from_face(face, {grid.x0 + x * grid.dx, grid.y0 + y * grid.dy, 1});
  return glm::normalize(view.axis_x * v.x + view.axis_y * v.y + view.axis_z * v.z);
}

} // namespace

Status find_losses(const HemicubeImage& hemicube, const DeltaFormFactors& weights,
                   const raster::View& view, HemicubeLosses* losses) {
  *losses = {};
  Buffer<std::uint64_t> backs; // [patch]
  std::uint64_t space = 0, heaviest = 0;
  for (std::size_t f = 0; f < hemicube.faces.size(); ++f) {
    const auto face = static_cast<raster::Face>(f);
    const raster::PixelGrid grid = raster::hemicube_grid(face, hemicube.resolution);
    std::size_t at = 0;
    for (std::int32_t y = 0; y < grid.height; ++y)
      for (std::int32_t x = 0; x < grid.width; ++x, ++at) {
        const raster::Item item = hemicube.faces[f].items[at];
        const std::uint64_t weight = weights.weight(face, x, y);
        if (item == raster::kNoItem) {
          space += weight;
          if (weight > heaviest) {
            heaviest = weight;
            losses->space_towards = direction_of(face, x, y, hemicube.resolution, view);
          }
        } else if (raster::is_back_facing(item)) {
          const std::size_t patch = raster::item_id(item);
          if (patch >= backs.size())
            HC_TRY(backs.resize(patch + 1, 0));
          backs[patch] += weight;
        }
      }
  }
  losses->space = static_cast<double>(space) * kUnit;
  for (std::uint32_t patch = 0; patch < backs.size(); ++patch)
    if (backs[patch] != 0)
      HC_TRY(losses->backs.push_back({patch, static_cast<double>(backs[patch]) * kUnit}));
  std::sort(losses->backs.begin(), losses->backs.end(), [](const auto& a, const auto& b) {
    return a.fraction != b.fraction ? a.fraction > b.fraction : a.patch < b.patch;
  });
  return {};
}

} // namespace hemicube::radiosity
