#include "tests/support/face_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hemicube::test {

using radiosity::OccluderFaces;

namespace {

constexpr double kRounding = 8 * 0x1p-52;

Polygon points_of(const PatchSet& patches, std::uint32_t patch) {
  Polygon points;
  for (const std::uint32_t corner : patches.corners_of(patch))
    points.push_back(patches.vertices[corner]);
  return points;
}

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points)
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return largest;
}

Vec3 area_vector(std::span<const Vec3> points) {
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 2; k < points.size(); ++k)
    sum += glm::cross(points[k - 1] - points[0], points[k] - points[0]) * 0.5;
  return sum;
}

double perimeter(std::span<const Vec3> points) {
  double sum = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    sum += glm::length(points[(k + 1) % points.size()] - points[k]);
  return sum;
}

/// How far inside of the nearest edge a point is, seen along the normal; < 0 outside.
double depth(std::span<const Vec3> points, const Vec3& normal, const Vec3& point) {
  double least = INFINITY;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 edge = points[(k + 1) % points.size()] - points[k];
    const Vec3 inwards = glm::cross(normal, edge);
    least = std::min(least, glm::dot(inwards, point - points[k]) / glm::length(inwards));
  }
  return least;
}

/// Not uniform, but everywhere.
Vec3 random_point(std::span<const Vec3> points, Random& random) {
  double sum = 0;
  Vec3 point(0, 0, 0);
  for (const Vec3& corner : points) {
    const double unit = random.unit();
    const double weight = 1e-6 + unit * unit * unit;
    sum += weight;
    point += weight * (corner - points[0]);
  }
  return points[0] + point / sum;
}

void expect_partition(const PatchSet& patches, const OccluderFaces& faces) {
  const std::uint32_t face_count = faces.face_count();
  ASSERT_EQ(faces.corner_offsets.size(), face_count + 1u);
  ASSERT_EQ(faces.patch_offsets.size(), face_count + 1u);
  ASSERT_EQ(faces.face_of_patch.size(), patches.patch_count());
  ASSERT_EQ(faces.corner_offsets[face_count], faces.corners.size());
  ASSERT_EQ(faces.patch_offsets[face_count], faces.patches.size());
  std::vector<int> listed(patches.patch_count());
  for (std::uint32_t f = 0; f < face_count; ++f) {
    const auto members = faces.patches_of(f);
    ASSERT_FALSE(members.empty());
    EXPECT_TRUE(std::is_sorted(members.begin(), members.end()));
    for (const std::uint32_t patch : members) {
      const bool first = faces.face_of_patch[patch] == f;
      const bool further_piece =
          members.size() == 1 && f > 0 && faces.patches_of(f - 1)[0] == patch;
      EXPECT_TRUE(first || further_piece) << "patch " << patch << " face " << f;
      listed[patch] += first;
    }
  }
  EXPECT_EQ(std::count(listed.begin(), listed.end(), 1), patches.patch_count());
}

void expect_shape(const PatchSet& patches, const OccluderFaces& faces, std::uint32_t f) {
  const auto corners = faces.corners_of(f);
  const Vec3 normal = faces.normal[f];
  const double rounding = 1.05 * kRounding * largest_coordinate(corners);
  ASSERT_GE(corners.size(), 3u);
  EXPECT_LE(corners.size(), OccluderFaces::kMostCorners);
  EXPECT_NEAR(glm::length(normal), 1, 1e-15);
  double lowest = INFINITY, highest = -INFINITY;
  for (const std::uint32_t patch : faces.patches_of(f)) {
    EXPECT_GT(glm::dot(patches.normal[patch], normal), 0);
    if (faces.patches_of(f).size() == 1)
      return; // as the patch was
    for (const Vec3& point : points_of(patches, patch)) {
      const double height = glm::dot(normal, point - corners[0]);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
      EXPECT_GE(depth(corners, normal, point), -rounding);
    }
  }
  EXPECT_LE(highest - lowest, 2 * rounding);
  for (const Vec3& corner : corners)
    EXPECT_GE(depth(corners, normal, corner), -2 * rounding) << "not convex";
}

void expect_area(const PatchSet& patches, const OccluderFaces& faces, std::uint32_t f) {
  double expected = 0, actual = 0, rounding = 0;
  for (const std::uint32_t patch : faces.patches_of(f))
    expected += patches.area[patch];
  const std::uint32_t first = faces.face_of_patch[faces.patches_of(f)[0]];
  for (std::uint32_t piece = first; piece < faces.face_count(); ++piece) {
    if (faces.patches_of(piece)[0] != faces.patches_of(first)[0])
      break;
    const auto corners = faces.corners_of(piece);
    actual += glm::length(area_vector(corners));
    rounding += kRounding * largest_coordinate(corners) * perimeter(corners);
  }
  EXPECT_NEAR(actual, expected, 0x1p-40 * expected + rounding) << "face " << f;
}

} // namespace

OccluderFaces faces_of(const PatchSet& patches) {
  OccluderFaces faces;
  require(faces.build(patches));
  return faces;
}

void expect_faces_cover(const PatchSet& patches, const OccluderFaces& faces, int points) {
  ASSERT_NO_FATAL_FAILURE(expect_partition(patches, faces));
  Random random(7);
  for (std::uint32_t f = 0; f < faces.face_count(); ++f) {
    const auto corners = faces.corners_of(f);
    ASSERT_NO_FATAL_FAILURE(expect_shape(patches, faces, f));
    expect_area(patches, faces, f);
    if (faces.patches_of(f).size() == 1)
      continue;
    const double rounding = 2 * kRounding * largest_coordinate(corners);
    for (int k = 0; k < points; ++k) {
      const Vec3 point = random_point(corners, random);
      int inside = 0, near = 0;
      for (const std::uint32_t patch : faces.patches_of(f)) {
        const double d = depth(points_of(patches, patch), faces.normal[f], point);
        inside += d > rounding;
        near += d >= -rounding;
      }
      EXPECT_LE(inside, 1) << "face " << f;
      EXPECT_GE(near, 1) << "face " << f;
    }
  }
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const std::uint32_t f = faces.face_of_patch[patch];
    const auto corners = faces.corners_of(f);
    if (faces.patches_of(f).size() == 1)
      continue;
    const Polygon own = points_of(patches, patch);
    for (int k = 0; k < points; ++k)
      EXPECT_GE(depth(corners, faces.normal[f], random_point(own, random)),
                -2 * kRounding * largest_coordinate(corners));
  }
}

std::uint32_t checked_count(const PatchSet& patches) {
  const OccluderFaces faces = faces_of(patches);
  expect_faces_cover(patches, faces);
  return faces.face_count();
}

std::uint32_t checked_count(const PolygonList& polygons) {
  const PatchSet patches = patches_of(polygons);
  EXPECT_EQ(patches.patch_count(), polygons.size());
  return checked_count(patches);
}

} // namespace hemicube::test
