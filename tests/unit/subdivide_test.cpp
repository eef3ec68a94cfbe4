#include "radiosity/mesh/openmesh_subdivide.h"

#include "tests/unit/mesh_scenes.h"

#include <array>
#include <limits>
#include <map>

namespace hemicube::radiosity {
namespace {

using namespace mesh_scenes;

struct Subdivided {
  PatchSet coarse, fine;
  MeshReport report;
  Status status;
};

Subdivided cut(const Scene& scene, const std::vector<double>& max_edge) {
  Subdivided result;
  EXPECT_TRUE(build_patches(scene, &result.coarse, &result.report).ok());
  result.status = subdivide(result.coarse, max_edge, &result.fine, &result.report);
  return result;
}

Subdivided cut(const Scene& scene, double max_edge) {
  return cut(scene, std::vector<double>(scene.face_count(), max_edge));
}

using Place = std::array<double, 3>;
Place place(const Vec3& v) {
  return {v.x, v.y, v.z};
}

double longest_edge(const PatchSet& patches) {
  double longest = 0;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    const auto corners = patches.corners_of(i);
    for (std::size_t k = 0; k < corners.size(); ++k)
      longest = std::max(longest, glm::length(patches.vertices[corners[(k + 1) % corners.size()]] -
                                              patches.vertices[corners[k]]));
  }
  return longest;
}

// How often each edge is used, by the indices of its ends or by their places.
template <typename Key, typename KeyOf>
std::map<std::pair<Key, Key>, int> edge_uses(const PatchSet& patches, KeyOf key_of) {
  std::map<std::pair<Key, Key>, int> uses;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    const auto corners = patches.corners_of(i);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Key a = key_of(corners[k]), b = key_of(corners[(k + 1) % corners.size()]);
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  }
  return uses;
}

std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses_by_index(const PatchSet& patches) {
  return edge_uses<std::uint32_t>(patches, [](std::uint32_t vertex) { return vertex; });
}

std::map<std::pair<Place, Place>, int> uses_by_place(const PatchSet& patches) {
  return edge_uses<Place>(patches,
                          [&](std::uint32_t vertex) { return place(patches.vertices[vertex]); });
}

template <typename Uses> void expect_all_used(const Uses& uses, int times) {
  for (const auto& [edge, count] : uses)
    EXPECT_EQ(count, times);
}

// No middle of an edge is a corner of some patch: halving leaves T-vertices nowhere else.
void expect_no_t_vertices(const PatchSet& patches) {
  std::map<Place, int> corners;
  for (const std::uint32_t corner : patches.corners)
    ++corners[place(patches.vertices[corner])];
  for (const auto& [edge, count] : uses_by_place(patches)) {
    const Vec3 a(edge.first[0], edge.first[1], edge.first[2]);
    const Vec3 b(edge.second[0], edge.second[1], edge.second[2]);
    EXPECT_EQ(corners.count(place(0.5 * (a + b))), 0u);
  }
}

// A patch may be slightly warped; its pieces then have other normals and a little more area.
void expect_sound(const Subdivided& result, double warp = 0) {
  ASSERT_TRUE(result.status.ok()) << result.status.message();
  const PatchSet& fine = result.fine;
  EXPECT_EQ(fine.front_count, fine.patch_count());
  EXPECT_NEAR(total_area(fine), total_area(result.coarse),
              (1e-12 + warp * warp) * total_area(result.coarse));
  for (std::size_t i = 0; i < result.coarse.vertices.size(); ++i)
    EXPECT_EQ(fine.vertices[i], result.coarse.vertices[i]);
  for (std::uint32_t i = 0; i < fine.patch_count(); ++i) {
    const std::uint32_t parent = fine.parent[i];
    EXPECT_LE(i == 0 ? 0 : fine.parent[i - 1], parent);
    EXPECT_EQ(fine.face[i], result.coarse.face[parent]);
    EXPECT_EQ(fine.material[i], result.coarse.material[parent]);
    EXPECT_EQ(fine.group[i], result.coarse.group[parent]);
    EXPECT_NEAR(glm::length(fine.normal[i] - result.coarse.normal[parent]), 0, 1e-9 + 10 * warp);
  }
  expect_no_t_vertices(fine);
}

TEST(Subdivide, ACubeStaysClosed) {
  Scene scene = cube(1, Vec3(0.1, 0.2, 0.3));
  for (std::uint32_t i = 0; i < 6; ++i) {
    scene.face_material[i] = i % 2;
    scene.face_group[i] = 10 + i;
  }
  for (const double max_edge : {0.5001, 0.3, 0.1}) {
    const Subdivided result = cut(scene, max_edge);
    expect_sound(result);
    EXPECT_LE(longest_edge(result.fine), max_edge);
    const std::uint32_t n = max_edge > 0.5 ? 2 : max_edge > 0.25 ? 4 : 16;
    EXPECT_EQ(result.fine.patch_count(), 6 * n * n);
    EXPECT_EQ(result.fine.vertices.size(), 6 * n * n + 2);
    expect_all_used(uses_by_index(result.fine), 2);
    EXPECT_EQ(result.report.non_manifold_faces, 0u);
  }
}

TEST(Subdivide, AnEdgeAsLongAsItMayBeStays) {
  EXPECT_EQ(cut(cube(1), 1.0).fine.patch_count(), 6u);
  EXPECT_EQ(cut(cube(1), 0.5).fine.patch_count(), 24u);
}

TEST(Subdivide, WithoutLimitsNothingChanges) {
  const Subdivided result = cut(cube(1), 0.0);
  expect_sound(result);
  EXPECT_EQ(list(result.fine.corners), list(result.coarse.corners));
  EXPECT_EQ(list(result.fine.parent), (Face{0, 1, 2, 3, 4, 5}));
}

TEST(Subdivide, PiecesFollowTheCornersOfAQuad) {
  const Subdivided both = cut(scene_of_polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}), 1.5);
  expect_sound(both);
  ASSERT_EQ(both.fine.patch_count(), 4u);
  for (std::uint32_t k = 0; k < 4; ++k)
    EXPECT_EQ(both.fine.corners_of(k)[k], k); // the corner it keeps, in its place
  EXPECT_EQ(both.fine.vertices[both.fine.corners_of(0)[2]], Vec3(1, 1, 0));

  const Subdivided wide = cut(scene_of_polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}), 1.5);
  ASSERT_EQ(wide.fine.patch_count(), 2u);
  EXPECT_EQ(list(wide.fine.corners), (Face{0, 4, 5, 3, 4, 1, 2, 5}));
  const Subdivided tall = cut(scene_of_polygon({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}), 1.5);
  ASSERT_EQ(tall.fine.patch_count(), 2u);
  EXPECT_EQ(list(tall.fine.corners), (Face{0, 1, 4, 5, 5, 4, 2, 3}));
}

TEST(Subdivide, PiecesFollowTheCornersOfATriangle) {
  const Subdivided result = cut(scene_of_polygon({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}), 1.9);
  expect_sound(result);
  EXPECT_EQ(list(result.fine.corners), (Face{0, 3, 5, 3, 1, 4, 5, 4, 2, 4, 5, 3}));
}

TEST(Subdivide, LargerPolygonsBecomeConvexQuads) {
  const Subdivided result =
      cut(scene_of_polygon(
              {{0, 0, 0}, {9, 0, 0}, {9.5, 0.2, 0}, {9.6, 0.5, 0}, {9, 1, 0}, {0, 0.3, 0}}),
          5.0);
  expect_sound(result);
  EXPECT_LE(longest_edge(result.fine), 5.0);
  EXPECT_EQ(list(result.fine.corners_of(0)).front(), 0u);
  for (std::uint32_t i = 0; i < result.fine.patch_count(); ++i) {
    std::vector<Vec3> points;
    for (const std::uint32_t corner : result.fine.corners_of(i))
      points.push_back(result.fine.vertices[corner]);
    EXPECT_EQ(points.size(), 4u);
    EXPECT_EQ(build(scene_of_polygon(points)).report.triangulated_concave, 0u);
  }
}

// A quad, a triangle and a pentagon around one corner; only one of them has a limit.
TEST(Subdivide, NeighboursWithoutALimitFollow) {
  const std::vector<Vec3> v = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {4, 1, 0}, {4, 3, 0},
                               {3, 4, 0}, {1, 4, 0}, {9, 9, 9}, {9, 9, 8}, {9, 8, 9}};
  const Scene scene =
      scene_of(v, {{0, 1, 2, 3}, {1, 4, 2}, {2, 4, 5, 6, 7}, {3, 2, 7}, {8, 9, 10}});
  for (std::size_t limited = 0; limited < 4; ++limited) {
    std::vector<double> max_edge(5, 0.0);
    max_edge[limited] = 0.6;
    const Subdivided result = cut(scene, max_edge);
    expect_sound(result);
    EXPECT_GT(result.fine.patch_count(), 20u);
    EXPECT_EQ(result.fine.parent[result.fine.patch_count() - 1], 4u);
    EXPECT_EQ(result.fine.parent[result.fine.patch_count() - 2], 3u); // the lone triangle is whole
  }
}

TEST(Subdivide, AQuadWithoutALimitIsCutOneWayOnly) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const Subdivided result = cut(scene_of(v, {{0, 1, 2, 3}, {1, 4, 5, 2}}), {0.3, 0});
  expect_sound(result);
  EXPECT_EQ(result.fine.patch_count(), 16u + 4u);
}

// Every face with vertices of its own, as many programs write them.
TEST(Subdivide, UnweldedFacesGetTheSameMidpoints) {
  const Scene welded = cube(0.7, Vec3(0.1, 0.3, 0.9));
  std::vector<Vec3> vertices;
  std::vector<Face> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    faces.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      faces.back().push_back(static_cast<std::uint32_t>(vertices.size()));
      vertices.push_back(welded.vertices[welded.corners[4 * f + k]]);
    }
  }
  std::vector<double> max_edge(6, 0.0);
  max_edge[0] = 0.05;
  const Subdivided result = cut(scene_of(vertices, faces), max_edge);
  expect_sound(result);
  EXPECT_EQ(result.fine.patch_count(), 2 * 16u * 16 + 4 * 16); // through to the opposite face
  EXPECT_EQ(result.report.non_manifold_faces, 0u);
  expect_all_used(uses_by_place(result.fine), 2);
  for (const auto& [edge, count] : uses_by_index(result.fine)) // faces share no vertex
    EXPECT_LE(count, 2);
  const Subdivided all = cut(scene_of(vertices, faces), 0.2);
  EXPECT_EQ(all.fine.vertices.size(), 6u * 25);
}

TEST(Subdivide, ThreeQuadsOnOneEdge) {
  const std::vector<Vec3> v = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0},  {1, 0, 1},
                               {0, 1, 0}, {0, 1, 1}, {-1, 0, 0}, {-1, 0, 1}};
  const Scene scene = scene_of(v, {{0, 2, 3, 1}, {4, 0, 1, 5}, {6, 0, 1, 7}});
  for (std::size_t limited = 0; limited < 3; ++limited) {
    std::vector<double> max_edge(3, 0.0);
    max_edge[limited] = 0.3;
    const Subdivided result = cut(scene, max_edge);
    expect_sound(result);
    EXPECT_EQ(result.report.non_manifold_faces, 1u);
    EXPECT_EQ(result.fine.patch_count(), 16u + 4 + 4);
    int shared_by_three = 0;
    for (const auto& [edge, count] : uses_by_index(result.fine))
      shared_by_three += count == 3;
    EXPECT_EQ(shared_by_three, 4);
  }
}

TEST(Subdivide, DuplicateAndOppositeFaces) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Subdivided result =
      cut(scene_of(v, {{0, 1, 2, 3}, {0, 1, 2, 3}, {3, 2, 1, 0}}), {0, 0, 0.3});
  expect_sound(result);
  EXPECT_EQ(result.report.non_manifold_faces, 1u);
  EXPECT_EQ(result.fine.patch_count(), 3 * 16u);
}

TEST(Subdivide, AMoebiusStrip) {
  // A triangulated strip of 5 vertices closed with a twist: its last triangles disagree in
  // orientation.
  const std::vector<Vec3> v = {{4, 0, 0}, {1, 4, 1}, {-3, 2, 0}, {-3, -2, 1}, {1, -4, 0}};
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < 5; ++i)
    faces.push_back(i % 2 == 0 ? Face{i, (i + 1) % 5, (i + 2) % 5}
                               : Face{i, (i + 2) % 5, (i + 1) % 5});
  const Subdivided result = cut(scene_of(v, faces), {1, 0, 0, 0, 0});
  expect_sound(result);
  EXPECT_GE(result.report.non_manifold_faces, 1u);
  EXPECT_EQ(result.fine.patch_count(), 5u * 64);
}

TEST(Subdivide, ABowTieVertex) { // two fans that touch in one vertex
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  const Subdivided result = cut(scene_of(v, {{0, 1, 2}, {0, 3, 4}}), {0.5, 0});
  expect_sound(result);
  EXPECT_EQ(result.fine.patch_count(), 16u + 1);
  EXPECT_EQ(result.report.non_manifold_faces, 0u);
}

TEST(Subdivide,
     CrowdedVerticesStayConforming) { // more patches than are connected around one vertex
  std::vector<Vec3> v = {{0, 0, 0}};
  std::vector<Face> faces;
  const std::uint32_t count = 1500;
  for (std::uint32_t i = 0; i < count; ++i)
    v.emplace_back(count + i, 2.0 * i, i * i * 1e-3);
  for (std::uint32_t i = 1; i < count; ++i)
    faces.push_back({0, i, i + 1});
  std::vector<double> max_edge(faces.size(), 0.0);
  max_edge.back() = 3000;
  const Subdivided result = cut(scene_of(v, faces), max_edge);
  expect_sound(result);
  EXPECT_EQ(result.fine.patch_count(), 4 * (count - 1));
}

TEST(Subdivide, TwoSidedPiecesHaveBacksOfTheirOwn) {
  Scene scene = cube(1);
  scene.face_material[1] = scene.face_material[4] = 1;
  Subdivided result = cut(scene, 0.5);
  ASSERT_TRUE(add_back_sides(scene, &result.fine).ok());
  const PatchSet& fine = result.fine;
  ASSERT_EQ(fine.patch_count(), 32u);
  EXPECT_EQ(fine.front_count, 24u);
  for (std::uint32_t k = 0; k < 8; ++k) { // six fronts, then the backs of 1 and 4
    EXPECT_EQ(fine.parent[24 + k], k < 4 ? 6u : 7u);
    EXPECT_EQ(fine.face[24 + k], k < 4 ? 1u : 4u);
    const std::uint32_t front = (k < 4 ? 4 : 16) + k % 4;
    EXPECT_EQ(fine.centre[24 + k], fine.centre[front]);
    EXPECT_EQ(fine.normal[24 + k], -fine.normal[front]);
  }
}

TEST(Subdivide, RefusesBadArguments) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, nan, infinity}) {
    const Subdivided result = cut(cube(1), {0, 0, bad, 0, 0, 0});
    EXPECT_EQ(result.status.code(), StatusCode::kInvalidArgument);
    EXPECT_NE(result.status.message().find("max_edge of patch 2"), std::string_view::npos);
  }
  EXPECT_EQ(cut(cube(1), std::vector<double>(5, 0.0)).status.code(), StatusCode::kInvalidArgument);
  Scene scene = cube(1);
  scene.face_material[0] = 1;
  Built built = build(scene);
  ASSERT_TRUE(add_back_sides(scene, &built.patches).ok());
  PatchSet fine;
  EXPECT_EQ(subdivide(built.patches, std::vector<double>(7, 1.0), &fine, &built.report).code(),
            StatusCode::kInvalidArgument);
}

TEST(Subdivide, RefusesMoreThanCanBeNumbered) {
  for (const double max_edge : {1e-6, 1e-300, 5e-324}) {
    const Subdivided result = cut(cube(1), max_edge);
    EXPECT_EQ(result.status.code(), StatusCode::kBadScene);
    EXPECT_NE(result.status.message().find("max_edge"), std::string_view::npos);
  }
}

TEST(Subdivide, RefusesPiecesBelowTheResolutionOfTheCoordinates) {
  const Subdivided result = cut(cube(2e-8, Vec3(1e6, 1e6, 1e6)), 1e-9);
  EXPECT_EQ(result.status.code(), StatusCode::kBadScene);
  EXPECT_NE(result.status.message().find("max_edge"), std::string_view::npos);
}

TEST(Subdivide, PrintsNothing) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  cut(scene_of(v, {{0, 1, 2, 3}, {0, 1, 2, 3}}), 0.5);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Subdivide, RandomSoups) {
  Random random(5);
  for (std::uint32_t round = 0; round < 300; ++round) {
    const std::uint32_t count = 4 + random(20);
    std::vector<Vec3> vertices;
    for (std::uint32_t i = 0; i < count; ++i) // some places twice; planar every other time
      vertices.push_back(i > 0 && random(4) == 0
                             ? vertices[random(i)]
                             : Vec3(random(1000), random(1000), round % 2 * random(1000)) / 250.0);
    std::vector<Face> faces(1 + random(15));
    for (Face& face : faces)
      for (std::uint32_t k = 3 + random(4); k-- > 0;)
        face.push_back(random(count));
    const Scene scene = scene_of(vertices, faces);
    Subdivided result;
    if (!build_patches(scene, &result.coarse, &result.report).ok())
      continue;
    std::vector<double> max_edge;
    for (std::uint32_t i = 0; i < result.coarse.patch_count(); ++i)
      max_edge.push_back(random(3) == 0 ? 0.4 + random(100) / 100.0 : 0);
    result.status = subdivide(result.coarse, max_edge, &result.fine, &result.report);
    expect_sound(result, 1e-3);
  }
}

} // namespace
} // namespace hemicube::radiosity
