#include "radiosity/hemicube/five_views.h"

#include "radiosity/elementary.h"
#include "radiosity/mesh/polygon_shape.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

// The constant turn of the frame about the normal: 22.5 degrees, as far from the axes of a
// right-angled room as from its diagonals. Its tangent, sqrt(2) - 1, is hard to approximate by
// fractions: with 3/4, or any simple slope, edges between points at simple coordinates run through
// pixel centres again and again, where only rounding decides who owns them, and a T-vertex on such
// an edge opens gaps (furnace_boxes lost 8e-5 of a hemisphere at resolution 512 with 3/4).
constexpr double kTurnCosine = 0x1.d906bcf328d46p-1;
constexpr double kTurnSine = 0x1.87de2a6aea963p-2;

/// @param along  any direction not parallel to the normal
raster::View turned_view(const Vec3& eye, const Vec3& normal, const Vec3& along) {
  const Vec3 tangent = unit(along - normal * glm::dot(normal, along));
  const Vec3 across = glm::cross(normal, tangent);
  raster::View view;
  view.eye = eye;
  view.axis_z = normal;
  view.axis_x = tangent * kTurnCosine + across * kTurnSine;
  view.axis_y = glm::cross(normal, view.axis_x);
  return view;
}

Vec3 first_edge(const PatchSet& patches, std::uint32_t patch) {
  const auto corners = patches.corners_of(patch);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 edge =
        patches.vertices[corners[(k + 1) % corners.size()]] - patches.vertices[corners[k]];
    if (edge != Vec3(0, 0, 0))
      return edge / glm::length(edge);
  }
  return {1, 0, 0};
}

Vec3 least_aligned_axis(const Vec3& normal) {
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  if (x <= y && x <= z)
    return {1, 0, 0};
  return y <= z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
}

} // namespace

raster::Polygons polygons_of(const PatchSet& patches) noexcept {
  return {patches.vertices.span(), patches.corner_offsets.span(), patches.corners.span()};
}

raster::View hemicube_view(const PatchSet& patches, std::uint32_t patch) noexcept {
  raster::View view =
      turned_view(patches.centre[patch], patches.normal[patch], first_edge(patches, patch));
  view.skip = patch;
  return view;
}

raster::View hemicube_view(const PatchSet& patches, std::uint32_t patch,
                           std::span<const Vec3> part) noexcept {
  const Vec3 edge = part[1] - part[0];
  raster::View view = turned_view(centroid(part, measure_polygon(part)), patches.normal[patch],
                                  edge / glm::length(edge));
  view.skip = patch;
  return view;
}

raster::View hemicube_view(const Vec3& point, const Vec3& normal) noexcept {
  // Divided by its largest component first: its square may be out of range.
  const double largest =
      max_number(std::fabs(normal.x), max_number(std::fabs(normal.y), std::fabs(normal.z)));
  const Vec3 direction = unit(normal / largest);
  return turned_view(point, direction, least_aligned_axis(direction));
}

} // namespace hemicube::radiosity
