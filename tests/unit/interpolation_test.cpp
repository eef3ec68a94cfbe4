#include "radiosity/output/interpolation.h"

#include "radiosity/mesh/straight_corners.h"
#include "tests/support/graded_mesh.h"
#include "tests/unit/output_support.h"

#include <map>
#include <tuple>

namespace hemicube::radiosity::test {
namespace {

using hemicube::test::Random;

/// A sheet of squares of 1/4 to 1/64 with hanging vertices, in general position.
struct GradedSheet : ::testing::Test {
  GradedSheet() {
    SceneBuilder builder(1);
    const std::uint32_t grey = builder.material("grey", 0.5, 0);
    add_graded_sheet(&builder, {{0.3, -0.7, 0.2}, {0.8, 0.36, 0.48}, {-0.6, 0.48, 0.64}},
                     hemicube::test::splits_at_random(3),
                     [&](double, double, double) { return grey; });
    patches = patches_of(builder.finish());
    require(find_straight_corners(patches, &is_straight));
  }

  std::vector<double> weights(std::uint32_t patch, const Vec3& point) const {
    std::vector<double> w(patches.corners_of(patch).size());
    interpolation_weights(patches, is_straight.span(), patch, point, w.data());
    return w;
  }

  /// What a patch shows at a point if light(k) is the value at vertex k.
  template <typename Light>
  double shown(std::uint32_t patch, const Vec3& point, Light&& light) const {
    const std::vector<double> w = weights(patch, point);
    double sum = 0;
    for (std::size_t k = 0; k < w.size(); ++k)
      sum += w[k] * light(patches.corners_of(patch)[k]);
    return sum;
  }

  PatchSet patches;
  Buffer<std::uint8_t> is_straight;
};

// Catches: hanging vertices off their side by rounding taken for turning corners, and the other way
// round.
TEST_F(GradedSheet, FourCornersOfEverySquareTurn) {
  std::size_t straight = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    std::size_t turning = 0;
    for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1];
         ++c)
      turning += !is_straight[c];
    EXPECT_EQ(turning, 4u);
    straight += patches.corners_of(patch).size() - turning;
  }
  EXPECT_GT(straight, 50u);
}

// Catches: a large patch that shows its side as one line where its neighbours show a bend
// (Wachspress's coordinates give a hanging vertex no weight), and corners that are passed over.
TEST_F(GradedSheet, BothSidesOfEveryEdgeShowTheSame) {
  const auto light = [](std::uint32_t vertex) { return 1.0 + vertex * 7919 % 101; };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> patch_on; // left of a -> b
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const auto corners = patches.corners_of(patch);
    for (std::size_t k = 0; k < corners.size(); ++k)
      patch_on[{corners[k], corners[(k + 1) % corners.size()]}] = patch;
  }
  std::size_t shared = 0;
  for (const auto& [edge, patch] : patch_on) {
    const auto other = patch_on.find({edge.second, edge.first});
    if (other == patch_on.end())
      continue;
    ++shared;
    const Vec3 a = patches.vertices[edge.first], b = patches.vertices[edge.second];
    for (const double t : {0.0, 1e-12, 0.3, 0.5, 0.999999, 1.0}) {
      const Vec3 point = a + t * (b - a);
      const double expected = light(edge.first) + t * (light(edge.second) - light(edge.first));
      EXPECT_NEAR(shown(patch, point, light), expected, 1e-8) << t;
      EXPECT_NEAR(shown(other->second, point, light), expected, 1e-8) << t;
    }
  }
  EXPECT_GT(shared, 400u);
}

TEST_F(GradedSheet, WeightsMakeUpThePointAndAreNeverNegative) {
  Random random(2);
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (int trial = 0; trial < 20; ++trial) {
      Vec3 point{0, 0, 0}; // a random convex combination of the corners
      double sum = 0;
      for (const std::uint32_t vertex : patches.corners_of(patch)) {
        const double share = random.unit() * random.unit();
        point += share * patches.vertices[vertex];
        sum += share;
      }
      point /= sum;
      const std::vector<double> w = weights(patch, point);
      Vec3 again{0, 0, 0};
      double total = 0;
      for (std::size_t k = 0; k < w.size(); ++k) {
        EXPECT_GE(w[k], 0);
        total += w[k];
        again += w[k] * patches.vertices[patches.corners_of(patch)[k]];
      }
      EXPECT_NEAR(total, 1, 1e-12);
      EXPECT_LT(glm::length(again - point), 1e-12);
    }
}

// Catches: negative weights, or light from the far side, where a pixel's centre lies beside the
// patch that it shows.
TEST_F(GradedSheet, PointsSlightlyOutsideCountAsOnTheEdge) {
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const auto corners = patches.corners_of(patch);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 a = patches.vertices[corners[k]];
      const Vec3 b = patches.vertices[corners[(k + 1) % corners.size()]];
      const Vec3 outwards = glm::cross(b - a, patches.normal[patch]);
      const std::vector<double> w = weights(patch, a + 0.25 * (b - a) + 1e-5 * outwards);
      EXPECT_NEAR(w[k], 0.75, 1e-4);
      EXPECT_NEAR(w[(k + 1) % corners.size()], 0.25, 1e-4);
      for (const double weight : w)
        EXPECT_GE(weight, 0);
    }
  }
}

// Catches: rectangles, which most meshes are made of, shown with other bits than before.
TEST_F(GradedSheet, RectanglesKeepTheBitsOfWachspress) {
  std::size_t rectangles = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    if (patches.corners_of(patch).size() != 4)
      continue;
    ++rectangles;
    const Vec3 point =
        0.7 * patches.centre[patch] + 0.3 * patches.vertices[patches.corners_of(patch)[1]];
    std::vector<double> expected(4);
    wachspress_weights(patches, patch, point, expected.data());
    EXPECT_EQ(weights(patch, point), expected);
  }
  EXPECT_GT(rectangles, 50u);
}

TEST(MeanValues, WorkAtAnyScale) {
  for (const double scale : {1e-30, 1.0, 1e29}) {
    SceneBuilder builder(1);
    builder.face(builder.material("grey", 0.5, 0),
                 {{0, 0, 0}, {scale, 0, 0}, {2 * scale, 0, 0}, {0, scale, 0}});
    const PatchSet patches = patches_of(builder.finish());
    double w[4];
    mean_value_weights(patches, 0, Vec3{0.5, 0, 0} * scale, w);
    EXPECT_NEAR(w[0], 0.5, 1e-9);
    EXPECT_NEAR(w[1], 0.5, 1e-9);
    mean_value_weights(patches, 0, Vec3{1, 0, 0} * scale, w);
    EXPECT_EQ(w[1], 1);
    mean_value_weights(patches, 0, Vec3{0.5, 0.5, 0} * scale, w);
    EXPECT_NEAR(w[0] * 0 + w[1] + 2 * w[2], 0.5, 1e-12);
    EXPECT_NEAR(w[3], 0.5, 1e-12);
  }
}

TEST(StraightCorners, ATriangleWithAHangingVertexHasOne) {
  SceneBuilder builder(1);
  builder.face(builder.material("grey", 0.5, 0), {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 1, 0}});
  const PatchSet patches = patches_of(builder.finish());
  Buffer<std::uint8_t> is_straight;
  require(find_straight_corners(patches, &is_straight));
  EXPECT_EQ(std::vector<std::uint8_t>(is_straight.begin(), is_straight.end()),
            (std::vector<std::uint8_t>{0, 1, 0, 0}));
}

// Catches: a search for the ends of a side that has none, which would not end.
TEST(StraightCorners, APatchThatIsAllButALineHasNone) {
  SceneBuilder builder(1);
  builder.face(builder.material("grey", 0.5, 0), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  PatchSet patches = patches_of(builder.finish());
  for (Vec3& vertex : patches.vertices)
    vertex.y *= 1e-300;
  Buffer<std::uint8_t> is_straight;
  require(find_straight_corners(patches, &is_straight));
  for (const std::uint8_t flag : is_straight)
    EXPECT_EQ(flag, 0);
}

TEST(Wachspress, IsBilinearOnARectangle) {
  SceneBuilder builder(1);
  builder.face(builder.material("grey", 0.5, 0), {{1, 0, 5}, {5, 0, 5}, {5, 2, 5}, {1, 2, 5}});
  const PatchSet patches = patches_of(builder.finish());
  for (const double u : {0.0, 0.25, 0.5, 0.9, 1.0})
    for (const double v : {0.0, 0.3, 1.0}) {
      double w[4];
      wachspress_weights(patches, 0, {1 + 4 * u, 2 * v, 5}, w);
      const double expected[] = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(w[k], expected[k], 1e-6) << u << " " << v;
    }
}

TEST(Wachspress, ReproducesLinearFieldsAndIsNeverNegative) {
  SceneBuilder builder(1);
  // A pentagon with a sixth corner in the middle of its first edge.
  builder.face(builder.material("grey", 0.5, 0),
               {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 1}, {0, 1, 3}, {0, -1, 1}});
  const PatchSet patches = patches_of(builder.finish());
  ASSERT_EQ(patches.patch_count(), 1u);
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    Vec3 point{0, 0, 0}; // a random convex combination of the corners
    double sum = 0;
    for (const std::uint32_t vertex : patches.corners) {
      const double share = random.unit();
      point += share * patches.vertices[vertex];
      sum += share;
    }
    point /= sum;
    double w[6];
    wachspress_weights(patches, 0, point, w);
    Vec3 again{0, 0, 0};
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_GE(w[k], 0);
      again += w[k] * patches.vertices[patches.corners[k]];
    }
    EXPECT_LT(glm::length(again - point), 1e-12);
  }
}

TEST(Wachspress, WorksAtAnyScaleAndOutsideThePatch) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    SceneBuilder builder(1);
    builder.face(builder.material("grey", 0.5, 0),
                 {{0, 0, 0}, {scale, 0, 0}, {scale, scale, 0}, {0, scale, 0}});
    const PatchSet patches = patches_of(builder.finish());
    double w[4];
    wachspress_weights(patches, 0, Vec3{0.5, -1e-9, 0} * scale, w);
    EXPECT_NEAR(w[0], 0.5, 1e-6);
    EXPECT_NEAR(w[1], 0.5, 1e-6);
    wachspress_weights(patches, 0, Vec3{0, 0, 0}, w);
    EXPECT_NEAR(w[0], 1, 1e-6);
  }
}

} // namespace
} // namespace hemicube::radiosity::test
