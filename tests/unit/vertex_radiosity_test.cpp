#include "radiosity/output/vertex_radiosity.h"

#include "tests/unit/output_support.h"

#include <cmath>

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

TEST(VertexRadiosity, NothingCrossesAnEdgeOfARoom) {
  // The floor is lit, the walls are dark.
  const PatchSet patches = patches_of(hemicube::test::furnace_cube(4, 0.5, 1));
  std::vector<double> radiosity;
  for (const Vec3& normal : patches.normal)
    radiosity.push_back(normal.y > 0.5 ? 1 : 0);
  Buffer<float> corners;
  require(vertex_radiosities(patches, radiosity, 1, &corners));
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1];
         ++c)
      EXPECT_EQ(corners[c], radiosity[patch]);
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
