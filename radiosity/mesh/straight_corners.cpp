#include "radiosity/mesh/straight_corners.h"

#include "radiosity/mesh/polygon_shape.h"

namespace hemicube::radiosity {

Status find_straight_corners(const PatchSet& patches, Buffer<std::uint8_t>* is_straight) {
  is_straight->clear();
  HC_TRY(is_straight->resize(patches.corners.size()));
  Buffer<Vec3> points;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const auto corners = patches.corners_of(patch);
    const std::size_t count = corners.size();
    if (count == 3)
      continue;
    points.clear();
    for (const std::uint32_t vertex : corners)
      HC_TRY(points.push_back(patches.vertices[vertex]));
    const double resolution = measure_polygon(points.span()).resolution;
    const auto straight = is_straight->span().subspan(patches.corner_offsets[patch], count);
    std::size_t turning = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 arriving = points[k] - points[(k + count - 1) % count];
      const Vec3 leaving = points[(k + 1) % count] - points[k];
      const bool turns = turn_side(patches.normal[patch], resolution, arriving, leaving) != 0;
      straight[k] = !turns;
      turning += turns;
    }
    if (turning < 3)
      for (std::uint8_t& flag : straight)
        flag = 0;
  }
  return {};
}

} // namespace hemicube::radiosity
