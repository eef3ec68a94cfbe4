// The shadow of a half-plane, whose light is known everywhere: are the lines where they should be,
// and is it drawn better with them?
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/build_patches.h"
#include "tests/analytic/adaptive_support.h"
#include "tests/support/half_plane_shadow.h"

#include <cmath>

namespace hemicube::test {
namespace {

using radiosity::EdgeLight;

/// Form factors that are finer than the meshes.
Options exact_enough() {
  Options options = on_rung(Rung::kAdaptive);
  options.error = 0.1;
  return options;
}

/// The patches of a scene, cut.
PatchSet cut(const Scene& scene, double snap) {
  PatchSet patches, elements;
  radiosity::MeshReport mesh;
  radiosity::DiscontinuityReport report;
  std::vector<radiosity::DiscontinuityLine> lines;
  radiosity::DiscontinuityLimits limits;
  limits.snap = snap;
  require(radiosity::build_patches(scene, &patches, &mesh));
  require(radiosity::cut_discontinuities(scene, patches, limits, &elements, &lines, &report));
  return elements;
}

double drawn_error(const Scene& scene, const PatchSet& elements) {
  radiosity::ThreadPool pool;
  radiosity::Solution solution;
  radiosity::Certificate certificate;
  require(pool.init(2));
  require(radiosity::solve_scene(scene, elements, exact_enough(), pool, nullptr, &solution,
                                 &certificate));
  return half_plane_error(elements, solution.radiosity.span()).rms;
}

double drawn_error_refined(const Scene& scene, const PatchSet& patches,
                           std::uint64_t most_elements) {
  radiosity::ThreadPool pool;
  radiosity::ElementTree tree;
  PatchSet elements;
  radiosity::Solution solution;
  radiosity::Certificate certificate;
  radiosity::RefinementReport report;
  require(pool.init(2));
  require(radiosity::solve_adaptive(scene, patches, limits(0.01, 0.02, most_elements),
                                    exact_enough(), pool, nullptr, &tree, &elements, &solution,
                                    &certificate, &report));
  EXPECT_EQ(report.end, RefinementEnd::kMaxElements);
  return half_plane_error(elements, solution.radiosity.span()).rms;
}

TEST(HalfPlaneShadow, LinesAreWhereLightBends) {
  const PatchSet elements = cut(half_plane_shadow(5), 1e-6);
  // Where the planes through the edges of the lamp along y and that of the half-plane meet the
  // floor.
  const double beyond = kHalfPlaneHeight / (kHalfPlaneLamp - kHalfPlaneHeight);
  const double begin = kHalfPlaneEdge + (kHalfPlaneEdge - 2.5) * beyond;
  const double end = kHalfPlaneEdge + (kHalfPlaneEdge - 1.5) * beyond;
  double length[2] = {0, 0}, elsewhere = 0;
  for (std::uint32_t e = 0; e < elements.patch_count(); ++e) {
    const auto corners = elements.corners_of(e);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const EdgeLight light = elements.light_across(elements.corner_offsets[e] + k);
      if (light == EdgeLight::kSmooth)
        continue;
      EXPECT_EQ(light, EdgeLight::kBends);
      const Vec3& a = elements.vertices[corners[k]];
      const Vec3& b = elements.vertices[corners[(k + 1) % corners.size()]];
      const auto lies_at = [&](double x) {
        return std::fabs(a.x - x) < 1e-9 && std::fabs(b.x - x) < 1e-9;
      };
      (lies_at(begin) ? length[0] : lies_at(end) ? length[1] : elsewhere) += glm::length(b - a);
    }
  }
  EXPECT_NEAR(length[0], 8, 1e-9); // 4, from both sides
  EXPECT_NEAR(length[1], 8, 1e-9);
  EXPECT_EQ(elsewhere, 0);
}

// Catches: lines beside the borders of the shadow, light that is averaged across them.
TEST(HalfPlaneShadow, IsDrawnBetterThanWithThreeTimesTheElements) {
  double before = 1;
  for (const int cells : {4, 8, 16}) {
    const Scene scene = half_plane_shadow(cells), finer = half_plane_shadow(2 * cells);
    const PatchSet elements = cut(scene, 0), uniform = patches_of(finer);
    ASSERT_LT(elements.patch_count(), 1.5 * patches_of(scene).patch_count());
    const double error = drawn_error(scene, elements);
    EXPECT_LT(error, 1.1 * drawn_error(finer, uniform)) << cells;
    EXPECT_LT(error, before / 2.5) << cells << ": of light that is linear it would fall by 4";
    before = error;
  }
}

// Catches: refinement of cut patches that loses the lines.
TEST(HalfPlaneShadow, IsRefinedBetterAlongItsBorders) {
  const Scene scene = half_plane_shadow(4);
  for (const std::uint64_t elements : {100u, 200u})
    EXPECT_LT(drawn_error_refined(scene, cut(scene, 0), elements),
              drawn_error_refined(scene, patches_of(scene), elements) / 1.8)
        << elements;
}

} // namespace
} // namespace hemicube::test
