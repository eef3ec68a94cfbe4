// A room that reflects nothing, with one small emitter: the irradiance of a patch is one form
// factor.

#include "radiosity/hemicube/five_views.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/support/lambert.h"
#include "tests/support/one_point.h"
#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

namespace hemicube::test {
namespace {

constexpr std::uint32_t kResolution = 512;

class BlackRoom : public testing::TestWithParam<const char*> {
protected:
  void SetUp() override {
    truth_ = reference_case("enclosures.json", GetParam())["truth"];
    scene_ = reference_scene(std::string("enclosures/") + GetParam() + ".obj");
    patches_ = patches_of(scene_);
    options_.resolution = kResolution;
    for (std::uint32_t p = 0; p < patches_.patch_count(); ++p)
      if (scene_.materials[patches_.material[p]] == "emitter")
        emitters_.push_back(p);
    ASSERT_FALSE(emitters_.empty());
  }

  bool blocked() const { return std::string(GetParam()) == "black_room_blocker"; }

  double exact(const Vec3& point, const Vec3& normal) const {
    double sum = 0;
    for (const std::uint32_t emitter : emitters_)
      sum += lambert_form_factor(point, normal, corners_of(patches_, emitter));
    return sum;
  }

  /// What pixels may make of the emitter and of the edges of what stands before it.
  double bound(const raster::View& view) const {
    double sum = 1e-9;
    for (const std::uint32_t emitter : emitters_)
      sum += (blocked() ? 2 : 1) * aliasing_bound(view, corners_of(patches_, emitter), kResolution);
    return sum;
  }

  nlohmann::json truth_;
  Scene scene_;
  PatchSet patches_;
  radiosity::Options options_;
  std::vector<std::uint32_t> emitters_;
};

// Catches: black patches whose irradiance is not gathered, or wrongly; light through the blocker; a
// sheet of two coincident opposite patches that shadows itself.
TEST_P(BlackRoom, IrradianceIsThePointFormFactorToTheEmitter) {
  const Solved solved = solve(scene_, options_);
  const auto means = truth_["patch_mean_form_factor_to_emitter"];
  int sheet = 0, dark = 0;
  for (std::uint32_t p = 0; p < patches_.patch_count(); ++p) {
    const double irradiance = solved.solution.irradiance[p * 3];
    const double unblocked = exact(patches_.centre[p], patches_.normal[p]);
    const double slack = bound(radiosity::hemicube_view(patches_, p));
    EXPECT_LE(irradiance, unblocked + slack) << "patch " << p;
    // The blocker stands above the floor: patches above it, and the sheet itself, see past it.
    const bool on_sheet = blocked() && p >= 130;
    sheet += on_sheet;
    if (!blocked() || (on_sheet && patches_.normal[p].z > 0)) {
      EXPECT_GE(irradiance, unblocked - slack) << "patch " << p;
    }
    if (p < means.size() && !means[p].is_null() && means[p] == 0.0) {
      EXPECT_EQ(irradiance, 0.0) << "patch " << p << " lies wholly in the shadow";
      ++dark;
    }
  }
  EXPECT_EQ(sheet, blocked() ? 4 : 0);
  EXPECT_GT(dark, 0);
}

// Catches: rows at points that differ from rows of patches: another axis, an offset, the wrong
// side.
TEST_P(BlackRoom, PointsSeeTheEmitterAsTheExactVisibilitySays) {
  std::vector<radiosity::Receiver> points;
  for (const auto& probe : truth_["probes"])
    points.push_back({point_of(probe["position"]), point_of(probe["normal"])});
  radiosity::FormFactorMatrix matrix;
  radiosity::Certificate certificate;
  radiosity::ThreadPool pool;
  require(pool.init(2));
  require(radiosity::compute_point_form_factors(patches_, points, options_, pool, nullptr, &matrix,
                                                &certificate));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const radiosity::RowView row = matrix.row(k);
    double actual = 0;
    for (std::size_t c = 0; c < row.columns.size(); ++c)
      for (const std::uint32_t emitter : emitters_)
        actual += row.columns[c] == emitter ? row.scale * static_cast<double>(row.values[c]) : 0;
    const double expected = truth_["probes"][k]["form_factor_to_emitter"];
    EXPECT_NEAR(actual, expected,
                bound(radiosity::hemicube_view(points[k].position, points[k].normal)))
        << "probe " << k;
    if (expected == 0) {
      EXPECT_EQ(actual, 0.0) << "probe " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, BlackRoom, testing::Values("black_room", "black_room_blocker"),
                         [](const auto& made) { return std::string(made.param); });

} // namespace
} // namespace hemicube::test
