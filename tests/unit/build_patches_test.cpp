#include "radiosity/mesh/build_patches.h"

#include "tests/unit/mesh_scenes.h"

#include <string>

namespace hemicube::radiosity {
namespace {

using namespace mesh_scenes;

// Where the same shape must be judged the same: units, and places far from the origin.
struct Placement {
  double scale;
  Vec3 offset;
};
const Placement kPlacements[] = {
    {1, {0, 0, 0}},        {1e-6, {0, 0, 0}},       {1e6, {0, 0, 0}},  {0.1, {0, 0, 0}},
    {1, {1e6, -1e6, 1e6}}, {1e6, {1e6, 1e6, -1e6}}, {1e-6, {1, 2, 3}}, {1, {1e6 + 0.1, 0, 0.3}},
};

Built build_placed(const std::vector<Vec3>& points, const Placement& placement) {
  return build(scene_of_polygon(moved(points, placement.scale, placement.offset)));
}

#define EXPECT_PATCHES(built, count)                                                               \
  ASSERT_TRUE((built).status.ok()) << (built).status.message();                                    \
  EXPECT_EQ((built).patches.patch_count(), std::uint32_t{count})

TEST(BuildPatches, KeepsFacesAndTheirVertices) {
  const Scene scene = cube(2, Vec3(0.1, 0.2, 0.3));
  const Built built = build(scene);
  EXPECT_PATCHES(built, 6);
  EXPECT_EQ(list(built.patches.corners), list(scene.corners));
  for (std::size_t i = 0; i < scene.vertices.size(); ++i)
    EXPECT_EQ(built.patches.vertices[i], scene.vertices[i]);
  for (std::uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(built.patches.face[i], i);
    EXPECT_EQ(built.patches.parent[i], i);
    EXPECT_NEAR(built.patches.area[i], 4, 1e-14);
  }
  EXPECT_EQ(built.patches.front_count, 6u);
  EXPECT_EQ(built.report.triangulated_concave + built.report.triangulated_warped +
                built.report.dropped_zero_area + built.report.duplicate_faces,
            0u);
  EXPECT_NEAR(glm::length(built.patches.normal[0] - Vec3(0, 0, -1)), 0, 1e-15);
  EXPECT_NEAR(glm::length(built.patches.centre[4] - Vec3(2.1, 1.2, 1.3)), 0, 1e-15);
}

TEST(BuildPatches, PlanarConvexPolygonsStayWholeAtEveryScale) {
  const std::vector<Vec3> hexagon = {{2, 0, 1},  {1, 2, 2.5},    {-1, 2, 2.5},
                                     {-2, 0, 1}, {-1, -2, -0.5}, {1, -2, -0.5}};
  for (const Placement& placement : kPlacements) {
    const Built built = build_placed(hexagon, placement);
    EXPECT_PATCHES(built, 1);
    EXPECT_NEAR(built.patches.area[0], 15 * placement.scale * placement.scale,
                1e-7 * placement.scale * placement.scale);
  }
}

// More corners on every edge.
std::vector<Vec3> with_points_on_edges(const std::vector<Vec3>& corners) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (const double t : {0.0, 0.1, 0.3, 0.7})
      points.push_back(corners[i] * (1 - t) + corners[(i + 1) % corners.size()] * t);
  return points;
}

TEST(BuildPatches, PointsOnAnEdgeDoNotMakeAFaceConcave) {
  const Vec3 u = Vec3(0, 3, -2) / 7.0, w = Vec3(-13, 2, 3) / 9.0; // in the plane across (1, 2, 3)
  const std::vector<std::vector<Vec3>> shapes = {
      {{0.1, 0.2, 0.3}, {0.4, 0.5, 1.1}, {0.2, 0.9, 0.7}}, {u, u + u, u + u + w, u + w}};
  for (const std::vector<Vec3>& shape : shapes)
    for (const Placement& placement : kPlacements) {
      const Built built = build_placed(with_points_on_edges(shape), placement);
      EXPECT_PATCHES(built, 1);
      EXPECT_EQ(built.report.triangulated_concave, 0u);
    }
}

TEST(BuildPatches, ConcaveFacesAreTriangulated) {
  const std::vector<Vec3> arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  for (const Placement& placement : kPlacements) {
    const Built built = build_placed(arrow, placement);
    EXPECT_PATCHES(built, 2);
    EXPECT_EQ(built.report.triangulated_concave, 1u);
    EXPECT_EQ(built.report.triangulated_warped, 0u);
    EXPECT_EQ(list(built.patches.corners), (Face{0, 1, 3, 1, 2, 3}));
    EXPECT_EQ(list(built.patches.face), (Face{0, 0}));
    EXPECT_EQ(list(built.patches.parent), (Face{0, 1}));
  }
}

TEST(BuildPatches, SlightDentsAreConcave) { // not taken for rounding
  const Built built = build(scene_of_polygon({{0, 0, 0}, {1, 1e-9, 0}, {2, 0, 0}, {1, 1, 0}}));
  EXPECT_PATCHES(built, 2);
  EXPECT_EQ(built.report.triangulated_concave, 1u);
}

TEST(BuildPatches, WarpedQuadsAreCutAlongTheShorterDiagonal) {
  const auto quad = [](double lift) {
    return std::vector<Vec3>{{0, 0, 0}, {2, 0, lift}, {2, 1, 0}, {-0.5, 1, 0}};
  };
  for (const Placement& placement : kPlacements) {
    EXPECT_PATCHES(build_placed(quad(1e-3), placement), 1);
    const Built warped = build_placed(quad(0.5), placement);
    EXPECT_PATCHES(warped, 2);
    EXPECT_EQ(warped.report.triangulated_warped, 1u);
    EXPECT_EQ(warped.report.triangulated_concave, 0u);
    EXPECT_EQ(list(warped.patches.corners), (Face{0, 1, 2, 0, 2, 3}));
  }
  const Built tie = build(scene_of_polygon({{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}));
  EXPECT_EQ(list(tie.patches.corners), (Face{0, 1, 2, 0, 2, 3}));
  const Built other = build(scene_of_polygon({{-1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}));
  EXPECT_EQ(list(other.patches.corners), (Face{0, 1, 3, 1, 2, 3}));
}

TEST(BuildPatches, PlanarityIsAThousandthOfTheSize) {
  // Corners lifted by +-d lie d off the plane through the mean; the diagonal of the box is about
  // sqrt 2.
  const auto quad = [](double d) {
    return scene_of_polygon({{0, 0, d}, {1, 0, -d}, {1, 1, d}, {0, 1, -d}});
  };
  EXPECT_EQ(build(quad(1.40e-3)).report.triangulated_warped, 0u);
  EXPECT_EQ(build(quad(1.43e-3)).report.triangulated_warped, 1u);
}

TEST(BuildPatches, FacesWithoutAreaAreDroppedAtEveryScale) {
  const std::vector<std::vector<Vec3>> shapes = {
      {{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}},
      {{0.1, 0.7, 0.3}, {0.2, 1.4, 0.6}, {0.3, 2.1, 0.9}},
      {{0, 0, 0}, {1.0 / 3, 0.1, 0.7}, {2.0 / 3, 0.2, 1.4}, {1, 0.3, 2.1}},
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, // bow-tie
      {{1, 2, 3}, {1, 2, 3}, {4, 5, 6}},
      {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}};
  for (const std::vector<Vec3>& shape : shapes)
    for (const Placement& placement : kPlacements) {
      const Built built = build_placed(shape, placement);
      EXPECT_EQ(built.status.code(), StatusCode::kBadScene);
      EXPECT_EQ(built.report.dropped_zero_area, 1u);
    }
}

TEST(BuildPatches, SliversStayAtEveryScale) {
  for (const Placement& placement : kPlacements) {
    EXPECT_PATCHES(build_placed({{0, 0, 0}, {1, 0, 0}, {0.3, 1e-6, 0}}, placement), 1);
    EXPECT_PATCHES(build_placed({{0, 0, 0}, {1, 1, 0}, {1, 1, 1e-6}, {0, 0, 1e-6}}, placement), 1);
  }
}

TEST(BuildPatches, DroppedFacesKeepTheNumbersOfTheOthers) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  Scene scene = scene_of(v, {{0, 1, 1, 2}, {0, 1, 4}, {0, 1, 2}, {1, 2, 0, 3, 2}, {0, 2, 3}});
  scene.face_material[4] = 1;
  scene.face_group[4] = 7;
  const Built built = build(scene);
  EXPECT_PATCHES(built, 2);
  EXPECT_EQ(built.report.dropped_repeated_index, 2u);
  EXPECT_EQ(built.report.dropped_zero_area, 1u);
  EXPECT_EQ(list(built.patches.face), (Face{2, 4}));
  EXPECT_EQ(list(built.patches.parent), (Face{0, 1}));
  EXPECT_EQ(list(built.patches.material), (Face{0, 1}));
  EXPECT_EQ(list(built.patches.group), (Face{0, 7}));
}

TEST(BuildPatches, SaysWhenNothingIsLeft) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const Built built = build(scene_of(v, {{0, 1, 0}, {0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(built.status.code(), StatusCode::kBadScene);
  EXPECT_EQ(std::string(built.status.message()),
            "no face of the scene has an area: all 3 were dropped (1 repeated index, 2 zero area)");
}

TEST(BuildPatches, RefusesScenesOutOfTheRangeOfDepths) {
  for (const double size : {1e31, 1e200, 1e-31, 1e-200}) {
    const Built built = build(scene_of_polygon({{0, 0, 0}, {size, 0, 0}, {0, -size, 0}}));
    EXPECT_EQ(built.status.code(), StatusCode::kBadScene) << size;
    EXPECT_NE(built.status.message().find("largest coordinate"), std::string_view::npos) << size;
  }
  for (const double size : {1e30, 1e-30}) {
    const std::vector<Vec3> triangle = {{0, 0, 0}, {size, 0, 0}, {0, -size, 0}};
    EXPECT_PATCHES(build(scene_of_polygon(triangle)), 1);
  }
}

TEST(BuildPatches, RefusesConcaveFacesOfTooManyCorners) {
  std::vector<Vec3> comb;
  for (int i = 0; i < 33000; ++i) {
    comb.emplace_back(i, 0, 0);
    comb.emplace_back(i + 0.5, 1, 0);
  }
  comb.emplace_back(33000, 10, 0);
  comb.emplace_back(0, 10, 0);
  const Built built = build(scene_of_polygon(comb));
  EXPECT_EQ(built.status.code(), StatusCode::kBadScene);
  EXPECT_NE(built.status.message().find("65536"), std::string_view::npos);
}

TEST(BuildPatches, PentagramsAreNotConvex) { // every turn is to the left
  const std::vector<Vec3> pentagon = {{4, 0, 0}, {1, 4, 0}, {-3, 2, 0}, {-3, -2, 0}, {1, -4, 0}};
  EXPECT_PATCHES(build(scene_of_polygon(pentagon)), 1);
  for (std::size_t start = 0; start < 5; ++start) {
    std::vector<Vec3> star;
    for (std::size_t i = 0; i < 5; ++i)
      star.push_back(pentagon[(start + 2 * i) % 5]);
    const Built built = build(scene_of_polygon(star));
    ASSERT_TRUE(built.status.ok());
    EXPECT_EQ(built.report.triangulated_concave, 1u);
  }
}

TEST(BuildPatches, PolygonsThatWindTwiceAreNotConvexFromAnyCorner) {
  // A small loop inside a large one, left turns only.
  const std::vector<Vec3> loops = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1.5, 0},
                                   {4, 0, 0}, {0, 4, 0}, {-4, 0, 0}, {-1, -4, 0}};
  for (std::size_t start = 0; start < loops.size(); ++start) {
    std::vector<Vec3> turned = loops;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start), turned.end());
    EXPECT_EQ(build(scene_of_polygon(turned)).report.triangulated_concave, 1u) << start;
  }
}

TEST(BuildPatches, SpikesAreNotConvex) {
  const Built built =
      build(scene_of_polygon({{0, 0, 0}, {3, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}));
  ASSERT_TRUE(built.status.ok());
  EXPECT_EQ(built.report.triangulated_concave, 1u);
  EXPECT_NEAR(total_area(built.patches), 4, 1e-14);
}

TEST(BuildPatches, ReturningToAPlaceIsNotConvex) {
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 1, 1);
  const std::vector<std::vector<Vec3>> shapes = {
      {a, b, c, a, c}, {b, c, a, c, a}, {a, b, c, a, b, c}, {a, b, a, b, c}};
  for (const std::vector<Vec3>& shape : shapes)
    EXPECT_EQ(build(scene_of_polygon(shape)).report.triangulated_concave, 1u);
}

TEST(BuildPatches, CornersAtTheSamePlaceAreOneCorner) {
  const Built built =
      build(scene_of_polygon({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}}));
  EXPECT_PATCHES(built, 1);
  EXPECT_EQ(built.patches.corners.size(), 3u);
}

TEST(BuildPatches, CountsDuplicateFacesByPlace) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, -0.0}};
  const Built built = build(
      scene_of(v, {{0, 1, 2, 3}, {0, 1, 2}, {7, 6, 5, 4}, {5, 6, 7, 4}, {1, 2, 3}, {2, 5, 0}}));
  EXPECT_PATCHES(built, 6);
  EXPECT_EQ(built.report.duplicate_faces, 3u);
}

TEST(BuildPatches, CentreIsTheAreaCentroid) {
  const Built built = build(scene_of_polygon({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 3, 0}}));
  EXPECT_PATCHES(built, 1);
  // A 4 x 1 rectangle and a triangle of area 4 above it.
  EXPECT_NEAR(built.patches.area[0], 8, 1e-14);
  EXPECT_NEAR(built.patches.centre[0].x, (4 * 2 + 4 * (4.0 / 3)) / 8, 1e-14);
  EXPECT_NEAR(built.patches.centre[0].y, (4 * 0.5 + 4 * (1 + 2.0 / 3)) / 8, 1e-14);
  const Built far = build(scene_of_polygon(
      moved({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 3, 0}}, 1, Vec3(1e6, 1e6, 1e6))));
  EXPECT_NEAR(far.patches.area[0], 8, 1e-13);
  EXPECT_NEAR(far.patches.centre[0].x - 1e6, (4 * 2 + 4 * (4.0 / 3)) / 8, 1e-9);
}

TEST(BuildPatches, AddsBacksAfterAllFronts) {
  Scene scene = cube(1);
  scene.face_material[1] = 1;
  scene.face_material[4] = 1;
  Built built = build(scene);
  ASSERT_TRUE(add_back_sides(scene, &built.patches).ok());
  const PatchSet& p = built.patches;
  EXPECT_EQ(p.patch_count(), 8u);
  EXPECT_EQ(p.front_count, 6u);
  EXPECT_EQ(list(p.face), (Face{0, 1, 2, 3, 4, 5, 1, 4}));
  EXPECT_EQ(list(p.parent), (Face{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(list(p.material), (Face{0, 1, 0, 0, 1, 0, 1, 1}));
  EXPECT_EQ(list(p.corners_of(6)), (Face{4, 7, 6, 5}));
  EXPECT_EQ(p.normal[7], -p.normal[4]);
  EXPECT_EQ(p.centre[7], p.centre[4]);
  EXPECT_EQ(p.area[7], p.area[4]);
}

TEST(BuildPatches, OneSidedScenesHaveNoBacks) {
  const Scene scene = cube(1);
  Built built = build(scene);
  ASSERT_TRUE(add_back_sides(scene, &built.patches).ok());
  EXPECT_EQ(built.patches.patch_count(), 6u);
  EXPECT_EQ(built.patches.front_count, 6u);
}

// Whatever a reader lets through: no crash, and every patch usable.
TEST(BuildPatches, RandomFacesGiveUsablePatches) {
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec3> vertices;
    const std::uint32_t count = 3 + random(12);
    const std::uint32_t places = 1 + random(6);
    const double lift = round % 3 == 0 ? 0 : round % 3 == 1 ? 1 : 1e-8;
    for (std::uint32_t i = 0; i < count; ++i)
      vertices.emplace_back(random(places), random(places), lift * (random(places)));
    std::vector<Face> faces;
    for (int i = 0; i < 20; ++i) {
      Face face(2 + random(9));
      for (std::uint32_t& corner : face)
        corner = random(count);
      faces.push_back(face);
    }
    const Built built = build(scene_of(vertices, faces));
    if (!built.status.ok()) {
      EXPECT_EQ(built.status.code(), StatusCode::kBadScene);
      continue;
    }
    for (std::uint32_t i = 0; i < built.patches.patch_count(); ++i) {
      EXPECT_GT(built.patches.area[i], 0);
      EXPECT_NEAR(glm::length(built.patches.normal[i]), 1, 1e-12);
      EXPECT_GE(built.patches.corners_of(i).size(), 3u);
    }
  }
}

} // namespace
} // namespace hemicube::radiosity
