#include "radiosity/mesh/triangulate.h"

#include "tests/unit/mesh_scenes.h"

#include <set>

namespace hemicube::radiosity {
namespace {

using mesh_scenes::moved;

std::vector<std::uint32_t> triangles_of(const std::vector<Vec3>& points) {
  Buffer<std::uint32_t> triangles;
  EXPECT_TRUE(clip_ears(points, measure_polygon(points), &triangles).ok());
  EXPECT_EQ(triangles.size() % 3, 0u);
  return {triangles.begin(), triangles.end()};
}

// Every triangle has the polygon's orientation and an area, the areas sum to the polygon's, every
// corner is used, and every edge that is not the polygon's own is shared by two triangles: so they
// cover it.
void expect_exact_cover(const std::vector<Vec3>& points) {
  const PolygonShape shape = measure_polygon(points);
  const std::vector<std::uint32_t> corners = triangles_of(points);
  ASSERT_EQ(corners.size(), 3 * (points.size() - 2));
  double sum = 0;
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const Vec3 triangle[3] = {points[corners[t]], points[corners[t + 1]], points[corners[t + 2]]};
    const PolygonShape part = measure_polygon(triangle);
    EXPECT_TRUE(has_area(triangle, part));
    EXPECT_GT(glm::dot(part.area_vector, shape.area_vector), 0);
    EXPECT_LT(corners[t], std::min(corners[t + 1], corners[t + 2]));
    sum += part.area;
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert({corners[t + k], corners[t + (k + 1) % 3]});
  }
  EXPECT_NEAR(sum, shape.area, 1e-9 * shape.area);
  for (const auto& [a, b] : edges) {
    EXPECT_EQ(edges.count({a, b}), 1u);
    EXPECT_EQ(edges.count({b, a}), b == (a + 1) % points.size() ? 0u : 1u);
  }
}

const std::vector<Vec3> kL = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};

TEST(Triangulate, CoversAnLAtEveryScaleAndOrientation) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(1e6 * scale, -3e5 * scale, 0.1 * scale)}) {
      std::vector<Vec3> points = moved(kL, scale, offset);
      expect_exact_cover(points);
      std::reverse(points.begin(), points.end());
      expect_exact_cover(points);
      for (Vec3& point : points)
        point = Vec3(point.z, point.x, point.y);
      expect_exact_cover(points);
    }
}

TEST(Triangulate, CutDoesNotDependOnTheStartingCorner) {
  std::vector<Vec3> points = {{0, 0, 0},   {5, 0.3, 0}, {4, 3, 0},
                              {2.5, 1, 0}, {1, 3.5, 0}, {1.2, 1, 0}};
  const auto places = [&] {
    std::set<std::vector<std::pair<double, double>>> result;
    const std::vector<std::uint32_t> corners = triangles_of(points);
    for (std::size_t t = 0; t < corners.size(); t += 3) {
      std::vector<std::pair<double, double>> triangle;
      for (std::size_t k = 0; k < 3; ++k)
        triangle.emplace_back(points[corners[t + k]].x, points[corners[t + k]].y);
      std::sort(triangle.begin(), triangle.end());
      result.insert(triangle);
    }
    return result;
  };
  const auto expected = places();
  for (std::size_t start = 1; start < points.size(); ++start) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    EXPECT_EQ(places(), expected);
  }
}

TEST(Triangulate, PointsOnEdgesStayCorners) {
  expect_exact_cover({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 1, 0}});
  expect_exact_cover({{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.2, 0.7, 0.1}});
  expect_exact_cover({{0, 0, 0},
                      {1, 0, 0},
                      {2, 0, 0},
                      {2, 1, 0},
                      {1.5, 1, 0},
                      {1, 1, 0},
                      {1, 1.5, 0},
                      {1, 2, 0},
                      {0, 2, 0}});
}

TEST(Triangulate, CombsAndSpirals) {
  std::vector<Vec3> comb;
  for (int i = 0; i < 50; ++i) {
    comb.emplace_back(i, 0, 0);
    comb.emplace_back(i + 0.5, 40, 0);
  }
  comb.emplace_back(50, 0, 0);
  comb.emplace_back(50, -1, 0);
  comb.emplace_back(0, -1, 0);
  std::reverse(comb.begin(), comb.end());
  expect_exact_cover(comb);
  std::vector<Vec3> spiral;
  const double directions[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (int turn = 12; turn-- > 0;) // outer arm, inwards
    spiral.emplace_back((turn + 2) * directions[turn % 4][0] - (turn + 2) * directions[turn % 4][1],
                        (turn + 2) * directions[turn % 4][1] + (turn + 2) * directions[turn % 4][0],
                        0);
  for (int turn = 0; turn < 12; ++turn) // and back a little further in
    spiral.emplace_back(
        (turn + 1.6) * directions[turn % 4][0] - (turn + 1.6) * directions[turn % 4][1],
        (turn + 1.6) * directions[turn % 4][1] + (turn + 1.6) * directions[turn % 4][0], 0);
  if (measure_polygon(spiral).area_vector.z < 0)
    std::reverse(spiral.begin(), spiral.end());
  expect_exact_cover(spiral);
}

// Star-shaped polygons of random radii about the origin: simple by construction.
TEST(Triangulate, RandomStars) {
  mesh_scenes::Random random(11);
  const std::vector<Vec3> circle = {{4, 0, 0},   {4, 3, 0},  {3, 4, 0},  {0, 4, 0},
                                    {-3, 4, 0},  {-4, 3, 0}, {-4, 0, 0}, {-4, -3, 0},
                                    {-3, -4, 0}, {0, -4, 0}, {3, -4, 0}, {4, -3, 0}};
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec3> points = circle;
    for (Vec3& point : points) {
      point *= 0.05 + random(1000) / 1000.0;
      point.z = point.x + 2 * point.y; // a slanted plane
    }
    expect_exact_cover(points);
  }
}

TEST(Triangulate, AHoleOnABridge) { // a ring: outer square, bridge to a hole, back over the bridge
  const std::vector<Vec3> points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                    {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  const std::vector<std::uint32_t> corners = triangles_of(points);
  double sum = 0;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const Vec3 triangle[3] = {points[corners[t]], points[corners[t + 1]], points[corners[t + 2]]};
    const PolygonShape part = measure_polygon(triangle);
    EXPECT_GT(part.area_vector.z, 0);
    sum += part.area;
    const Vec3 mean = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    EXPECT_FALSE(mean.x > 1 && mean.x < 3 && mean.y > 1 && mean.y < 3);
  }
  EXPECT_NEAR(sum, 12, 1e-12);
}

TEST(Triangulate, SpikesAddNothing) {
  const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0},
                                    {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<std::uint32_t> corners = triangles_of(points);
  double sum = 0;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const Vec3 triangle[3] = {points[corners[t]], points[corners[t + 1]], points[corners[t + 2]]};
    EXPECT_GT(measure_polygon(triangle).area_vector.z, 0);
    sum += measure_polygon(triangle).area;
  }
  EXPECT_NEAR(sum, 4, 1e-12);
  EXPECT_EQ(std::count(corners.begin(), corners.end(), 3u), 0);
}

// A bent antenna without area from the first corner into the polygon changes nothing.
TEST(Triangulate, AntennasAreInNobodysWay) {
  mesh_scenes::Random random(13);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec3> points = {{4, 0, 0},  {3, 3, 0},   {0, 4, 0},  {-3, 3, 0},
                                {-4, 0, 0}, {-3, -3, 0}, {0, -4, 0}, {3, -3, 0}};
    for (Vec3& point : points)
      point *= 0.2 + random(1000) / 1000.0;
    const Vec3 knee = 0.5 * points[0];
    const Vec3 tip(0.05, random(2) == 0 ? 0.05 : -0.05, 0);
    const double area = measure_polygon(points).area;
    points.insert(points.begin() + 1, {knee, tip, knee, points[0]});
    const std::vector<std::uint32_t> corners = triangles_of(points);
    double sum = 0;
    for (std::size_t t = 0; t < corners.size(); t += 3) {
      const Vec3 triangle[3] = {points[corners[t]], points[corners[t + 1]], points[corners[t + 2]]};
      sum += measure_polygon(triangle).area;
    }
    EXPECT_NEAR(sum, area, 1e-12 * area);
  }
}

TEST(Triangulate, SelfIntersectionsEnd) {
  mesh_scenes::Random random(3);
  for (int round = 0; round < 500; ++round) {
    std::vector<Vec3> points(4 + random(30));
    const std::uint32_t places = 2 + random(10);
    for (Vec3& point : points)
      point = Vec3(random(places), random(places), 0);
    const PolygonShape shape = measure_polygon(points);
    if (!has_area(points, shape))
      continue;
    const std::vector<std::uint32_t> corners = triangles_of(points);
    for (std::size_t t = 0; t < corners.size(); t += 3) {
      ASSERT_LT(corners[t + 2], points.size());
      const Vec3 triangle[3] = {points[corners[t]], points[corners[t + 1]], points[corners[t + 2]]};
      EXPECT_GT(glm::dot(measure_polygon(triangle).area_vector, shape.area_vector), 0);
    }
  }
}

} // namespace
} // namespace hemicube::radiosity
