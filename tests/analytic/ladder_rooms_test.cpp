// Solutions of rooms on the rungs of the ladder: how good they are, how good the certificate says
// they are, and what is chosen for a wanted error.

#include "tests/support/reference.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace hemicube::test {
namespace {

using radiosity::Options;
using radiosity::Rung;

/// A scene whose solution with exact form factors is known.
struct Room {
  const char* name;
  /// Bounds on the area-weighted RMS error of B, worst band: about 1.5 times what was measured. On
  /// rung adaptive that is the noise of the truth, whose form factors were sampled.
  double area, adaptive;
  /// The same, of the truth itself: a smaller error cannot be seen.
  double noise;
};
void PrintTo(const Room& room, std::ostream* out) {
  *out << room.name;
}

const Room kRooms[] = {
    {"cornell", 2e-3, 1.2e-3, 1e-3},        {"tableroom_a", 2.3e-3, 8.5e-4, 1e-3},
    {"tworooms_a", 1.7e-3, 1.4e-3, 1e-3},   {"corridor_a", 2.3e-3, 8e-4, 1e-3},
    {"corner2_90_a", 4.5e-6, 4.5e-6, 1e-3}, {"corner2_10_a", 1.7e-3, 1.7e-3, 1.2e-3},
    {"cube_mixed", 4e-9, 1.7e-8, 0},        {"room_bleed", 3e-8, 2.8e-8, 0}};

class LadderRooms : public testing::TestWithParam<Room> {
protected:
  void SetUp() override {
    const std::string name = GetParam().name;
    const bool is_enclosure = GetParam().noise == 0;
    scene_ = reference_scene(is_enclosure ? "enclosures/" + name + ".obj"
                                          : "scenes/" + name + ".coarse.obj");
    truth_ = is_enclosure ? reference_case("enclosures.json", name)["truth"]
                          : reference_json("scenes/" + name + ".truth.json");
    truth_ = nlohmann::json(
        truth_[is_enclosure ? "constant_element_patch_B" : "coarse_constant_element_B"]);
  }

  double worst_band(const Solved& solved) const {
    return deviation(solved.solution.radiosity.span(), truth_, solved.patches.area.span()).area_rms;
  }

  /// Over all bands, as the certificate says it.
  double all_bands(const Solved& solved) const {
    double squares = 0, all = 0;
    for (std::uint32_t p = 0; p < solved.patches.patch_count(); ++p)
      for (std::uint32_t band = 0; band < solved.solution.band_count; ++band) {
        const double exact = truth_[p][band], error = solved.radiosity(p, band) - exact;
        squares += solved.patches.area[p] * error * error;
        all += solved.patches.area[p] * exact * exact;
      }
    return std::sqrt(squares / all);
  }

  Scene scene_;
  nlohmann::json truth_;
};

// Catches: what no single form factor shows: leaks, lost light, closure that takes from one patch
// what belongs to another.
TEST_P(LadderRooms, RadiosityIsThatOfExactFormFactors) {
  Options options;
  options.rung = Rung::kArea;
  const double area = worst_band(solve(scene_, options));
  options.rung = Rung::kAdaptive;
  options.error = 0.3;
  const double adaptive = worst_band(solve(scene_, options));
  std::printf("%s: area RMS on rung area %.2e, adaptive at 0.3 %.2e\n", GetParam().name, area,
              adaptive);
  EXPECT_LE(area, GetParam().area);
  EXPECT_LE(adaptive, GetParam().adaptive);
}

// Catches: an estimate that is calm or alarmed by a constant factor: of the sampled rows alone, of
// the first bounce alone, of one band.
TEST_P(LadderRooms, TheCertificateKnowsTheError) {
  for (const std::uint32_t resolution : {64u, 256u}) {
    Options options;
    options.resolution = resolution;
    options.estimate_error = true;
    const Solved solved = solve(scene_, options);
    ASSERT_TRUE(solved.certificate.has_radiosity_error);
    const double actual = all_bands(solved), estimate = solved.certificate.radiosity_error;
    std::printf("%s at %u: error %.2e, estimate %.2e, ratio %.2f\n", GetParam().name, resolution,
                actual, estimate, estimate / actual);
    EXPECT_GE(estimate, 0.5 * actual) << resolution;
    EXPECT_LE(estimate, 2 * actual) << resolution;
  }
}

// Catches: a choice by the wrong error, or of something cheap whose error was not looked at; a
// choice or bits that depend on the number of workers.
TEST_P(LadderRooms, TheDialMeetsTheWantedError) {
  for (const double wanted : {0.05, 0.01, 0.002}) {
    Options options;
    options.choose_rung = options.choose_resolution = true;
    options.error = wanted;
    options.estimate_error = wanted == 0.01;
    const Solved solved = solve(scene_, options, 2);
    const radiosity::RungSetting& chosen = solved.certificate.setting;
    const double actual = all_bands(solved), noise = GetParam().noise;
    std::printf("%s, wanted %g: rung %s, resolution %u, target %g; error %.2e\n", GetParam().name,
                wanted, radiosity::rung_name(chosen.rung), chosen.resolution, chosen.target,
                actual);
    EXPECT_LE(actual, std::sqrt(wanted * wanted + noise * noise)) << wanted;
    if (wanted != 0.01)
      continue;
    EXPECT_LE(solved.certificate.radiosity_error, wanted);
    if (solved.patches.patch_count() > 600)
      continue; // slow
    const Solved alone = solve(scene_, options, 1);
    EXPECT_EQ(alone.certificate.setting.rung, chosen.rung);
    EXPECT_EQ(alone.certificate.setting.resolution, chosen.resolution);
    EXPECT_EQ(alone.certificate.setting.target, chosen.target);
    EXPECT_EQ(alone.certificate.radiosity_error, solved.certificate.radiosity_error);
    EXPECT_EQ(alone.certificate.form_factor_error, solved.certificate.form_factor_error);
    EXPECT_TRUE(same_bits(alone.solution.radiosity, solved.solution.radiosity));
  }
}

INSTANTIATE_TEST_SUITE_P(, LadderRooms, testing::ValuesIn(kRooms),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace hemicube::test
