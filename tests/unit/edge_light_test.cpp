// Edges across which light jumps or bends: kept by refinement, never averaged across.
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/output/vertex_radiosity.h"
#include "radiosity/refine/variation.h"
#include "tests/analytic/adaptive_support.h"
#include "tests/support/shadow_rooms.h"
#include "tests/support/sound_mesh.h"

namespace hemicube::test {
namespace {

using radiosity::EdgeLight;

PatchSet cut(const Scene& scene) {
  PatchSet elements;
  radiosity::DiscontinuityReport report;
  std::vector<radiosity::DiscontinuityLine> lines;
  require(radiosity::cut_discontinuities(scene, fronts_of(scene), {}, &elements, &lines, &report));
  require(radiosity::add_back_sides(scene, &elements));
  return elements;
}

/// Of all edges of fronts of one kind, each counted from both sides.
double length_of(const PatchSet& mesh, EdgeLight light) {
  double sum = 0;
  for (std::uint32_t p = 0; p < mesh.front_count; ++p) {
    const auto corners = mesh.corners_of(p);
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (mesh.light_across(mesh.corner_offsets[p] + k) == light)
        sum += glm::length(mesh.vertices[corners[(k + 1) % corners.size()]] -
                           mesh.vertices[corners[k]]);
  }
  return sum;
}

// Catches: hanging vertices of cut patches that refinement takes for corners or loses; pieces that
// are not convex where an edge is not cut in its middle; light across edges that children forget.
TEST(EdgeLight, RefinementKeepsIt) {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = random_box_room(seed);
    const PatchSet patches = cut(scene);
    radiosity::ElementTree tree;
    require(tree.init(scene, patches));
    PatchSet mesh;
    require(tree.make_mesh(&mesh));
    ASSERT_EQ(mesh.corners.size(), patches.corners.size());
    for (std::size_t k = 0; k < mesh.corners.size(); ++k) {
      ASSERT_EQ(mesh.vertices[mesh.corners[k]], patches.vertices[patches.corners[k]]);
      ASSERT_EQ(mesh.edge_light[k], patches.edge_light[k]);
    }
    Random random(seed);
    for (int round = 0; round < 300; ++round) {
      const std::vector<std::uint32_t> leaves = tree.leaves();
      const std::uint32_t leaf = leaves[random.index(static_cast<std::uint32_t>(leaves.size()))];
      if (tree.pieces_of(leaf, 1e-4) > 0)
        tree.split(leaf);
    }
    require(tree.make_mesh(&mesh));
    EXPECT_GT(mesh.patch_count(), patches.patch_count() + 300);
    expect_sound(patches, mesh);
    for (const EdgeLight light : {EdgeLight::kBends, EdgeLight::kJumps})
      EXPECT_NEAR(length_of(mesh, light), length_of(patches, light), 1e-9)
          << static_cast<int>(light);
    EXPECT_GT(length_of(mesh, EdgeLight::kBends), 1);
  }
}

TEST(EdgeLight, BacksSeeTheSameAcrossTheirEdges) {
  SceneBuilder builder(1);
  const std::uint32_t sheet = builder.material("sheet", 0.5, 0);
  builder.two_sided(sheet);
  builder.face(sheet, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  builder.face(sheet, {{1, 1, -1}, {2, 1, -1}, {2, 1, 1}, {1, 1, 1}});
  const PatchSet mesh = cut(builder.finish());
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeLight> light;
  int jumps = 0;
  for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
    const auto corners = mesh.corners_of(p);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const EdgeLight own = mesh.light_across(mesh.corner_offsets[p] + k);
      const auto ends = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      EXPECT_EQ(light.try_emplace(ends, own).first->second, own);
      jumps += own == EdgeLight::kJumps;
    }
  }
  EXPECT_EQ(jumps, 8); // of both sheets, from both sides, on front and back
}

// Catches: a solution on cut patches that is not that of the scene where nothing is refined.
TEST(EdgeLight, WhereNothingIsRefinedTheSolutionIsThatOfThePatches) {
  const Scene scene = random_box_room(3);
  const PatchSet patches = cut(scene);
  radiosity::ThreadPool pool;
  require(pool.init(2));
  radiosity::ElementTree tree;
  PatchSet elements;
  radiosity::Solution solution, expected;
  radiosity::Certificate certificate, expected_certificate;
  radiosity::RefinementReport report;
  const Options options = on_rung(Rung::kHemicube);
  require(radiosity::solve_adaptive(scene, patches, limits(1e9), options, pool, nullptr, &tree,
                                    &elements, &solution, &certificate, &report));
  require(radiosity::solve_scene(scene, patches, options, pool, nullptr, &expected,
                                 &expected_certificate));
  EXPECT_EQ(report.rounds, 0u);
  EXPECT_EQ(certificate.radiosity_hash, expected_certificate.radiosity_hash);
  EXPECT_EQ(certificate.form_factor_hash, expected_certificate.form_factor_hash);
}

/// A strip of 6 x 2 unit squares whose edges along x = 3 are of one kind.
PatchSet strip(EdgeLight light) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 0);
  builder.grid(grey, {0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {0, 2, 0}, 6, 2);
  PatchSet patches = patches_of(builder.finish());
  for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
    const auto corners = patches.corners_of(p);
    for (std::size_t k = 0; k < corners.size(); ++k)
      require(patches.edge_light.push_back(
          patches.vertices[corners[k]].x == 3 &&
                  patches.vertices[corners[(k + 1) % corners.size()]].x == 3
              ? light
              : EdgeLight::kSmooth));
  }
  return patches;
}

std::vector<double> means(const PatchSet& patches, double (*light)(double x)) {
  std::vector<double> values;
  for (const Vec3& centre : patches.centre)
    values.push_back(light(centre.x));
  return values;
}

// Catches: a mean over both sides of an edge.
TEST(EdgeLight, WhatIsDrawnJumpsWhereLightDoes) {
  const PatchSet patches = strip(EdgeLight::kJumps);
  const std::vector<double> values =
      means(patches, [](double x) { return x < 3 ? 1 + x : 40 - x; });
  Buffer<float> drawn;
  require(radiosity::vertex_radiosities(patches, values, 1, &drawn));
  for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = patches.vertices[patches.corners_of(p)[k]].x;
      EXPECT_FLOAT_EQ(drawn[patches.corner_offsets[p] + k],
                      static_cast<float>(patches.centre[p].x < 3 ? 1 + x : 40 - x));
    }
}

// Catches: a bend that is rounded off by a mean over both sides, and sides that part.
TEST(EdgeLight, WhatIsDrawnBendsWhereLightDoes) {
  const PatchSet patches = strip(EdgeLight::kBends);
  const auto light = [](double x) { return x < 3 ? 10.0 : 10 + 4 * (x - 3); };
  const std::vector<double> values = means(patches, light);
  Buffer<float> drawn;
  require(radiosity::vertex_radiosities(patches, values, 1, &drawn));
  for (std::size_t k = 0; k < patches.corners.size(); ++k)
    EXPECT_FLOAT_EQ(drawn[k], static_cast<float>(light(patches.vertices[patches.corners[k]].x)));
}

// Catches: a jump that refinement runs after: it is there however small elements are.
TEST(EdgeLight, AJumpIsNoVariationABendIs) {
  for (const EdgeLight light : {EdgeLight::kSmooth, EdgeLight::kBends, EdgeLight::kJumps}) {
    const PatchSet patches = strip(light);
    const std::vector<double> values = means(patches, [](double x) { return x < 3 ? 1.0 : 2.0; });
    const std::vector<double> dark(values.size(), 0.0), scale = {1.0};
    std::vector<double> variation;
    require(radiosity::find_variation(patches, values, dark, scale, &variation));
    EXPECT_EQ(*std::max_element(variation.begin(), variation.end()),
              light == EdgeLight::kJumps ? 0 : 1);
  }
}

} // namespace
} // namespace hemicube::test
