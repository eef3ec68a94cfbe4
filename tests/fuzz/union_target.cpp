// Patches of a plane or two, joined to few large convex polygons: each must cover its patches, and
// nothing else.

#include "radiosity/form_factor/occluder_faces.h"
#include "tests/fuzz/polygon_decoder.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hemicube::test {
namespace {

using radiosity::OccluderFaces;

/// What OccluderFaces calls rounding, in units of the largest coordinate.
constexpr double kRounding = 8 * 0x1p-52;

/// Rectangles of a grid, some missing, some twice, some cut: in quarters, in triangles, unevenly.
PolygonList decode_cells(ByteReader* bytes) {
  const int nx = 1 + static_cast<int>(bytes->below(6)), ny = 1 + static_cast<int>(bytes->below(6));
  PolygonList cells;
  for (const Polygon& cell : rectangle_grid(0, 0, nx, ny, nx, ny)) {
    const Vec3 &a = cell[0], &b = cell[1], &c = cell[2], &d = cell[3];
    switch (bytes->below(12)) {
    case 0: // missing
      break;
    case 1: // twice
      append(&cells, {cell, cell});
      break;
    case 2:
      append(&cells, {{a, b, c}, {a, c, d}});
      break;
    case 3:
      append(&cells, rectangle_grid(a.x, a.y, c.x, c.y, 2, 2));
      break;
    case 4: { // two trapezoids
      const double s = bytes->share(), t = bytes->share();
      const Vec3 low = a + (b - a) * s, high = d + (c - d) * t;
      append(&cells, {{a, low, high, d}, {low, b, c, high}});
      break;
    }
    case 5: // seen from the other side
      append(&cells, {{d, c, b, a}});
      break;
    case 6: // a little out of the plane
      append(&cells, {{a, b, c, d}});
      for (Vec3& corner : cells.back())
        corner.z += bytes->tiny() * bytes->tiny();
      break;
    default:
      append(&cells, {cell});
    }
  }
  return cells;
}

double largest_coordinate(const PatchSet& patches, std::span<const std::uint32_t> of) {
  double largest = 0;
  for (const std::uint32_t patch : of)
    for (const std::uint32_t corner : patches.corners_of(patch))
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::fabs(patches.vertices[corner][axis]));
  return largest;
}

/// How far a point is inside of a convex outline; < 0 outside.
double depth(std::span<const Vec3> outline, const Vec3& normal, const Vec3& point) {
  double least = INFINITY;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec3 edge = outline[(k + 1) % outline.size()] - outline[k];
    const Vec3 inwards = glm::cross(normal, edge);
    least = std::min(least, glm::dot(inwards, point - outline[k]) / glm::length(inwards));
  }
  return least;
}

/// A face of several patches: convex; around all its patches; as large as they are together.
std::string face_problem(const PatchSet& patches, const OccluderFaces& faces, std::uint32_t f) {
  const auto outline = faces.corners_of(f);
  const auto members = faces.patches_of(f);
  const Vec3& normal = faces.normal[f];
  const double rounding = 2 * kRounding * largest_coordinate(patches, members);
  if (outline.size() < 3 || outline.size() > OccluderFaces::kMostCorners)
    return "corners";
  for (const Vec3& corner : outline)
    if (depth(outline, normal, corner) < -rounding)
      return "not convex";
  double sum = 0, area = 0, perimeter = 0;
  for (const std::uint32_t patch : members) {
    sum += patches.area[patch];
    for (const std::uint32_t corner : patches.corners_of(patch)) {
      const Vec3& point = patches.vertices[corner];
      if (depth(outline, normal, point) < -rounding ||
          std::fabs(glm::dot(normal, point - outline[0])) > 2 * rounding)
        return "patch " + std::to_string(patch) + " reaches out of its face";
    }
  }
  for (std::size_t k = 0; k < outline.size(); ++k)
    perimeter += glm::length(outline[(k + 1) % outline.size()] - outline[k]);
  for (std::size_t k = 2; k < outline.size(); ++k)
    area += glm::dot(normal, glm::cross(outline[k - 1] - outline[0], outline[k] - outline[0])) / 2;
  // Patches on each other would make the sum larger, holes smaller.
  if (std::fabs(sum - area) <= 0x1p-40 * area + rounding * perimeter)
    return "";
  std::ostringstream text;
  text.precision(17);
  text << "an area of " << area << ", of its patches " << sum;
  return text.str();
}

std::string faces_problem(const PatchSet& patches, const OccluderFaces& faces) {
  std::vector<int> listed(patches.patch_count());
  for (std::uint32_t f = 0; f < faces.face_count(); ++f) {
    const auto members = faces.patches_of(f);
    for (const std::uint32_t patch : members) {
      if (patch >= patches.patch_count() || faces.face_of_patch[patch] != f)
        return "patch " + std::to_string(patch) + " in a face that it does not name";
      ++listed[patch];
      if (!(glm::dot(faces.normal[f], patches.normal[patch]) > 0))
        return "patch " + std::to_string(patch) + " faces the other way";
    }
    const std::string problem = members.size() > 1 ? face_problem(patches, faces, f) : "";
    if (!problem.empty())
      return "face " + std::to_string(f) + ": " + problem;
  }
  return std::all_of(listed.begin(), listed.end(), [](int times) { return times == 1; })
             ? ""
             : "a patch in no face or in two";
}

} // namespace

Verdict judge_union(Bytes bytes) {
  ByteReader reader(bytes);
  const std::uint32_t place = reader.byte();
  PolygonList cells = decode_cells(&reader);
  if (place % 3 == 1)
    append(&cells, moved(decode_cells(&reader), 1, reader.point()));
  if (place % 5 >= 3) {
    Random random(place);
    cells = turned(cells, random_frame(random));
  }
  if (place % 7 >= 4)
    cells = moved(cells, 1, reader.point() * 100.0);
  if (place % 2 == 1)
    cells = shuffled(cells, place);
  const auto patches = patches_if_kept(cells);
  if (!patches)
    return {"", false};
  OccluderFaces faces;
  require(faces.build(*patches));
  return {faces_problem(*patches, faces)};
}

} // namespace hemicube::test
