#include "radiosity/output/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hemicube::radiosity {
namespace {

TEST(Tone, IsTheSrgbCurveRoundedToTheNearest) {
  const SrgbEncoder encode;
  int mismatches = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double linear = i / 100000.0;
    const double srgb =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    const double exact = srgb * 255;
    if (std::fabs(exact - std::floor(exact) - 0.5) < 1e-6)
      continue; // on a threshold, where pow may round either way
    mismatches += encode(linear) != std::lround(exact);
  }
  EXPECT_EQ(mismatches, 0);
}

TEST(Tone, EveryCodeComesBack) {
  const SrgbEncoder encode;
  for (int code = 0; code < 256; ++code) {
    const double t = code / 255.0;
    const double linear = t <= 0.04045 ? t / 12.92 : std::pow((t + 0.055) / 1.055, 2.4);
    EXPECT_EQ(encode(linear), code);
  }
}

TEST(Tone, ClipsWhatCannotBeShown) {
  const SrgbEncoder encode;
  EXPECT_EQ(encode(-1), 0);
  EXPECT_EQ(encode(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(encode(7), 255);
  EXPECT_EQ(encode(std::numeric_limits<double>::infinity()), 255);
}

TEST(Tone, ExposureScalesLinearLight) {
  const float linear[] = {0, 0.01f, 4};
  Buffer<std::uint8_t> out;
  ASSERT_TRUE(tone_map(linear, {50}, &out).ok());
  const SrgbEncoder encode;
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[0], 0);
  EXPECT_EQ(out[1], encode(0.5));
  EXPECT_EQ(out[2], 255);
}

// Catches: a curve that does not reach white at the white point, hues that turn with brightness.
TEST(Tone, ReinhardCompressesLuminanceAndKeepsHues) {
  const float linear[] = {0.5f, 0.5f, 0.5f, 4, 4, 4, 0.2f, 0.1f, 0.05f, 0, 0, 0};
  Buffer<std::uint8_t> out;
  ASSERT_TRUE(tone_map(linear, {2, ToneCurve::kReinhard, 4}, &out).ok());
  const SrgbEncoder encode;
  EXPECT_EQ(out[0], encode(1 * (1 + 1 / 64.0) / 2));
  EXPECT_EQ(out[3], 255);
  const double y = 2 * luminance(0.2, 0.1, 0.05), gain = 2 * (1 + y / 64) / (1 + y);
  EXPECT_EQ(out[6], encode(gain * 0.2));
  EXPECT_EQ(out[7], encode(gain * 0.1));
  EXPECT_EQ(out[8], encode(gain * 0.05));
  EXPECT_EQ(out[9], 0);
}

} // namespace
} // namespace hemicube::radiosity
