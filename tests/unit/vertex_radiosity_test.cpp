#include "radiosity/output/vertex_radiosity.h"

#include "tests/support/graded_mesh.h"
#include "tests/unit/output_support.h"

#include <cmath>
#include <map>
#include <tuple>

namespace hemicube::radiosity::test {
namespace {

/// Corner values of a mesh with the light value(centre) on its patches, one band.
template <typename Value> std::vector<float> corner_values(const PatchSet& patches, Value&& value) {
  std::vector<double> radiosity;
  for (const Vec3& centre : patches.centre)
    radiosity.push_back(value(centre));
  Buffer<float> corners;
  require(vertex_radiosities(patches, radiosity, 1, &corners));
  EXPECT_EQ(corners.size(), patches.corners.size());
  return {corners.begin(), corners.end()};
}

Vec3 position(const PatchSet& patches, std::size_t corner) {
  return patches.vertices[patches.corners[corner]];
}

TEST(VertexRadiosity, ALinearFieldOnAGridIsExactAlsoAtItsBorder) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.grid(grey, {0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {0, 3, 0}, 5, 3);
  const PatchSet patches = patches_of(builder.finish());
  const auto field = [](const Vec3& p) { return 20 + 2 * p.x - 3 * p.y; };
  const auto corners = corner_values(patches, field);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec3 p = position(patches, c);
    EXPECT_NEAR(corners[c], field(p), 1e-5) << p.x << " " << p.y;
  }
}

TEST(VertexRadiosity, AConstantFieldStaysConstantOnAnyMesh) {
  const PatchSet patches = patches_of(hemicube::test::t_vertex_room());
  for (const float value : corner_values(patches, [](const Vec3&) { return 7.0; }))
    EXPECT_NEAR(value, 7, 1e-5);
}

TEST(VertexRadiosity, NothingCrossesMaterialsOrSidesOfAPatch) {
  SceneBuilder builder(1);
  const std::uint32_t red = builder.material("red", 0.5, 0),
                      blue = builder.material("blue", 0.5, 0);
  builder.grid([&](int i, int) { return i < 2 ? red : blue; }, {0, 0, 0}, {4, 0, 0}, {4, 2, 0},
               {0, 2, 0}, 4, 2);
  builder.face(red, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}); // the back of a red one
  const PatchSet patches = patches_of(builder.finish());
  const auto value = [&](std::uint32_t patch) {
    return patches.normal[patch].z < 0 ? 9.0 : patches.material[patch] == 0 ? 1.0 : 5.0;
  };
  std::vector<double> radiosity;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    radiosity.push_back(value(patch));
  Buffer<float> corners;
  require(vertex_radiosities(patches, radiosity, 1, &corners));
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1];
         ++c)
      EXPECT_EQ(corners[c], value(patch)) << patch;
}

TEST(VertexRadiosity, ExtrapolationStaysBetweenZeroAndTwiceTheLargestPatch) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.grid(grey, {0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, 6, 6);
  const PatchSet patches = patches_of(builder.finish());
  hemicube::test::Random random(1);
  for (const float value : corner_values(patches, [&](const Vec3&) {
         const double u = random.unit();
         return u * u * u * u * 100;
       })) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 200);
  }
  // A dark border row beside a bright inside would go below zero.
  for (const float value :
       corner_values(patches, [](const Vec3& p) { return p.x < 1 ? 0.0 : 10.0; }))
    EXPECT_GE(value, 0);
}

TEST(VertexRadiosity, EqualPositionsAreOneVertexWhateverTheirIndices) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.face(grey, {{1, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}});
  PatchSet patches = patches_of(builder.finish());
  for (std::uint32_t c = 4; c < 8; ++c) { // the second face gets vertices of its own
    require(patches.vertices.push_back(patches.vertices[patches.corners[c]]));
    patches.corners[c] = static_cast<std::uint32_t>(patches.vertices.size() - 1);
  }
  const auto corners = corner_values(patches, [](const Vec3& p) { return p.x < 1 ? 8.0 : 4.0; });
  for (std::size_t c = 0; c < 8; ++c) {
    const double x = position(patches, c).x; // areas 1 and 3: the shared edge has 5
    EXPECT_FLOAT_EQ(corners[c], x == 1 ? 5.f : x < 1 ? 8.f : 4.f);
  }
}

using hemicube::test::add_graded_sheet;
using hemicube::test::SheetPlace;

/// A sheet in general position, so that hanging vertices are off their sides by rounding.
const SheetPlace kSheet{{0.3, -0.7, 0.2}, {0.8, 0.36, 0.48}, {-0.6, 0.48, 0.64}};

PatchSet graded_patches(const std::function<bool(double, double, double)>& splits) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  add_graded_sheet(&builder, kSheet, splits, [&](double, double, double) { return grey; });
  return patches_of(builder.finish());
}

double linear_field(const Vec3& p) {
  return 10 + 3 * glm::dot(p - kSheet.origin, kSheet.u) + 4 * glm::dot(p - kSheet.origin, kSheet.v);
}

bool is_on_border(const Vec3& p) {
  const double x = glm::dot(p - kSheet.origin, kSheet.u), y = glm::dot(p - kSheet.origin, kSheet.v);
  return std::fmin(std::fmin(x, 1 - x), std::fmin(y, 1 - y)) < 1e-9;
}

/// Expects one value at every position of a mesh that is a single surface.
void expect_one_value_per_position(const PatchSet& patches, const std::vector<float>& corners) {
  std::map<std::tuple<double, double, double>, float> value_at;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec3 p = position(patches, c);
    EXPECT_EQ(value_at.try_emplace({p.x, p.y, p.z}, corners[c]).first->second, corners[c]);
  }
}

// Catches: weights by area alone, which let the larger patch pull the mean away from a hanging
// vertex (by 0.26 and 0.39 of a field that spans 7).
TEST(VertexRadiosity, ALinearFieldIsExactWhereLargeAndSmallPatchesMeet) {
  for (const auto& splits : {hemicube::test::splits_gently, hemicube::test::splits_steeply}) {
    const PatchSet patches = graded_patches(splits);
    const auto corners = corner_values(patches, linear_field);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Vec3 p = position(patches, c);
      EXPECT_NEAR(corners[c], linear_field(p), is_on_border(p) ? 0.1 : 1e-5) << p.x << " " << p.y;
    }
    expect_one_value_per_position(patches, corners);
  }
}

// Catches: balanced weights that turn negative where sizes differ sixteenfold.
TEST(VertexRadiosity, MeansStayWithinThePatchesAroundThem) {
  const PatchSet patches = graded_patches(hemicube::test::splits_at_random(3));
  const auto step = [](const Vec3& p) { return linear_field(p) < 13 ? 0.0 : 10.0; };
  const auto corners = corner_values(patches, step);
  std::map<std::tuple<double, double, double>, std::pair<double, double>> range_at;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (const std::uint32_t vertex : patches.corners_of(patch)) {
      const Vec3& p = patches.vertices[vertex];
      const double value = step(patches.centre[patch]);
      auto& [low, high] = range_at.try_emplace({p.x, p.y, p.z}, value, value).first->second;
      low = std::fmin(low, value);
      high = std::fmax(high, value);
    }
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec3 p = position(patches, c);
    const auto [low, high] = range_at[{p.x, p.y, p.z}];
    if (is_on_border(p)) {
      EXPECT_GE(corners[c], 0);
      EXPECT_LE(corners[c], 2 * high);
    } else {
      EXPECT_GE(corners[c], low);
      EXPECT_LE(corners[c], high);
    }
    if (high == 0) {
      EXPECT_EQ(corners[c], 0) << "dark stays dark";
    }
  }
  expect_one_value_per_position(patches, corners);
}

// Catches: extrapolation through the centre of the one patch at a hanging vertex, which lies beside
// the way from any inside vertex.
TEST(VertexRadiosity, AStraightCornerOnABorderLiesBetweenTheEndsOfItsSide) {
  SceneBuilder builder(1);
  const std::uint32_t coarse = builder.material("coarse", 0.5, 0),
                      fine = builder.material("fine", 0.5, 0);
  add_graded_sheet(
      &builder, kSheet,
      [](double x, double, double size) { return size > 0.25 || (size > 0.0625 && x >= 0.5); },
      [&](double x, double, double) { return x >= 0.5 ? fine : coarse; });
  const PatchSet patches = patches_of(builder.finish());
  const auto corners = corner_values(patches, linear_field);
  std::size_t straight = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    straight += patches.corners_of(patch).size() - 4;
    for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1];
         ++c)
      EXPECT_NEAR(corners[c], linear_field(position(patches, c)), 1e-5);
  }
  EXPECT_EQ(straight, 12u);
}

// Catches: a mean over the patches within 8 degrees of one's own, which differs from patch to patch
// around a vertex: edges within a smooth surface then show.
TEST(VertexRadiosity, TheTwoSidesOfAnEdgeOfABentSurfaceAgree) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  const auto at = [](int i, int j) { // a part of a sphere, its normals 7 degrees apart
    const Vec3 p{0.125 * i, 0.125 * j, 1};
    return p / glm::length(p);
  };
  for (int j = -3; j < 3; ++j)
    for (int i = -3; i < 3; ++i) {
      builder.face(grey, {at(i, j), at(i + 1, j), at(i, j + 1)});
      builder.face(grey, {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const PatchSet patches = patches_of(builder.finish());
  const auto corners = corner_values(patches, [](const Vec3& p) { return 2 + p.x * p.y; });
  expect_one_value_per_position(patches, corners);
}

// Catches: patches whose area times light overflows a double, shown black at their borders.
TEST(VertexRadiosity, HugeAreasWithHugeLightStayBright) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.grid(grey, {0, 0, 0}, {3e10, 0, 0}, {3e10, 3e10, 0}, {0, 3e10, 0}, 3, 3);
  for (const float value :
       corner_values(patches_of(builder.finish()), [](const Vec3&) { return 1e300; }))
    EXPECT_GT(value, 3e38f);
}

// Catches: a hub of more patches than are averaged, extrapolated all the same.
TEST(VertexRadiosity, WhereTooManyPatchesMeetEachKeepsItsOwnValue) {
  const std::uint32_t count = 600;
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  for (std::uint32_t k = 0; k < count; ++k) { // two rows of patches around the origin
    const double a = k, b = k + 1;
    builder.face(grey, {{0, 0, 0}, {1, a, 0}, {1, b, 0}});
    builder.face(grey, {{1, a, 0}, {2, 2 * a, 0}, {2, 2 * b, 0}, {1, b, 0}});
  }
  const PatchSet patches = patches_of(builder.finish());
  const auto value = [](const Vec3& p) { return p.y; };
  const auto corners = corner_values(patches, value);
  for (std::size_t c = 0; c < corners.size(); ++c)
    if (position(patches, c) == Vec3{0, 0, 0}) {
      std::uint32_t patch = 0;
      while (patches.corner_offsets[patch + 1] <= c)
        ++patch;
      EXPECT_EQ(corners[c], static_cast<float>(value(patches.centre[patch])));
    }
}

TEST(VertexRadiosity, ManyPatchesAtOneVertexStayFinite) {
  const std::uint32_t count = 2000;
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const double a = 1.0 + k, b = 2.0 + k;
    builder.face(grey, {{0, 0, 0}, {1, a, 0}, {1, b, 0}});
  }
  const PatchSet fan = patches_of(builder.finish());
  for (const float value : corner_values(fan, [](const Vec3& p) { return p.y; }))
    EXPECT_TRUE(std::isfinite(value) && value >= 0);
}

TEST(VertexRadiosity, LightBeyondFloatStaysFinite) {
  const PatchSet patches = patches_of(hemicube::test::furnace_cube(3, 0.5, 1));
  for (const float value : corner_values(patches, [](const Vec3&) { return 1e300; }))
    EXPECT_TRUE(std::isfinite(value));
}

} // namespace
} // namespace hemicube::radiosity::test
