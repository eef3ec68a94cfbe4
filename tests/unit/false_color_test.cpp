// False colours: the map, its scale and ticks, the font, the legend.

#include "radiosity/output/bitmap_font.h"
#include "radiosity/output/color_map.h"
#include "radiosity/output/false_color_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace hemicube::radiosity::test {
namespace {

/// L* of CIELAB.
double lightness(const Color& color) {
  double linear[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = color[k] / 255.0;
    linear[k] = t <= 0.04045 ? t / 12.92 : std::pow((t + 0.055) / 1.055, 2.4);
  }
  return 116 * std::cbrt(luminance(linear[0], linear[1], linear[2])) - 16;
}

// Catches: a colour out of place, that would show an edge where there is none.
TEST(ColorMap, LightnessRisesEvenly) {
  double last = 0;
  for (int k = 0; k <= 1000; ++k) {
    const double now = lightness(false_color(k / 1000.0));
    EXPECT_NEAR(now, 18 + 76 * k / 1000.0, 0.75) << k;
    EXPECT_GE(now, last - 0.35) << k; // a channel is rounded to 1 / 255
    last = now;
  }
}

TEST(ColorMap, EndsHoldBeyondTheScale) {
  EXPECT_EQ(false_color(0), (Color{65, 7, 116}));
  EXPECT_EQ(false_color(1), (Color{253, 242, 101}));
  EXPECT_EQ(false_color(-3), false_color(0));
  EXPECT_EQ(false_color(7), false_color(1));
  EXPECT_EQ(false_color(std::nan("")), false_color(0));
}

std::vector<std::string> tick_texts(const ColorScale& scale, std::size_t most) {
  Tick ticks[kMostTicks];
  const std::size_t count = make_ticks(scale, most, ticks);
  EXPECT_LE(count, most);
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < count; ++k) {
    texts.emplace_back(ticks[k].text());
    EXPECT_DOUBLE_EQ(std::stod(texts.back()), ticks[k].value) << "text and place must agree";
    EXPECT_LE(scale.min, ticks[k].value);
    EXPECT_GE(scale.max, ticks[k].value);
    for (const char c : texts.back())
      EXPECT_TRUE(has_glyph(c)) << texts.back();
  }
  return texts;
}

using Texts = std::vector<std::string>;

// Catches: steps that are not 1, 2, 5; an end without its tick by rounding; unequal decimals.
TEST(Ticks, LinearOnesAreMultiplesOfOneTwoFive) {
  EXPECT_EQ(tick_texts({0, 1, false}, 6), (Texts{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(tick_texts({0, 0.3, false}, 4), (Texts{"0", "0.1", "0.2", "0.3"}));
  EXPECT_EQ(tick_texts({-1, 1, false}, 6), (Texts{"-1.0", "-0.5", "0", "0.5", "1.0"}));
  EXPECT_EQ(tick_texts({17, 23.9, false}, 8), (Texts{"17", "18", "19", "20", "21", "22", "23"}));
  EXPECT_EQ(tick_texts({0, 25000, false}, 7),
            (Texts{"0", "5000", "10000", "15000", "20000", "25000"}));
  EXPECT_EQ(tick_texts({0, 3e-8, false}, 4), (Texts{"0", "1e-8", "2e-8", "3e-8"}));
  EXPECT_EQ(tick_texts({0, 2.5e9, false}, 6), (Texts{"0", "5e8", "1e9", "1.5e9", "2e9", "2.5e9"}));
  EXPECT_EQ(tick_texts({0.001, 0.003, false}, 3), (Texts{"0.001", "0.002", "0.003"}));
}

// Catches: decades skipped or crowded, a scale within one decade without a number.
TEST(Ticks, LogarithmicOnesArePowersOfTen) {
  EXPECT_EQ(tick_texts({0.01, 10, true}, 6), (Texts{"0.01", "0.1", "1", "10"}));
  EXPECT_EQ(tick_texts({1, 100, true}, 10), (Texts{"1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(tick_texts({1e-8, 1e8, true}, 6),
            (Texts{"1e-8", "0.00001", "0.01", "10", "10000", "1e7"}));
  EXPECT_EQ(tick_texts({3, 4, true}, 6), (Texts{"3.0", "3.2", "3.4", "3.6", "3.8", "4.0"}));
}

// Catches: endless loops and digits beyond their room on scales nobody would choose.
TEST(Ticks, StrangeScalesDoNoHarm) {
  for (const double max : {1e-30, 1e-3, 1.0, 7e7, 1e30})
    for (std::size_t most = 3; most <= kMostTicks; ++most) {
      EXPECT_GE(tick_texts({0, max, false}, most).size(), 2u) << max;
      EXPECT_GE(tick_texts({max * 1e-30, max, true}, most).size(), 1u) << max;
    }
  tick_texts({1, std::nextafter(1.0, 2.0), false}, 5);
  tick_texts({-1e30, 1e30, false}, 9);
}

TEST(ColorScale, SharesAreLinearOrLogarithmic) {
  const ColorScale linear{2, 6, false}, log{0.01, 100, true};
  EXPECT_EQ(linear.share(3), 0.25);
  EXPECT_EQ(linear.share(1), 0);
  EXPECT_EQ(linear.share(6), 1);
  EXPECT_NEAR(log.share(0.1), 0.25, 1e-15);
  EXPECT_NEAR(log.share(10), 0.75, 1e-15);
  EXPECT_EQ(log.share(0), 0);
  EXPECT_EQ(log.share(std::nan("")), 0);
}

/// A picture of one row, each pixel grey and whole.
Picture row_of(const std::vector<float>& values, PixelKind kind = PixelKind::kSurface) {
  Picture picture;
  picture.width = static_cast<std::uint32_t>(values.size());
  picture.height = 1;
  picture.samples = 2;
  for (const float value : values) {
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(picture.rgb.push_back(value).ok());
    EXPECT_TRUE(picture.kind.push_back(kind).ok());
    EXPECT_TRUE(picture.hits.push_back(4).ok());
  }
  return picture;
}

// Catches: a scale chosen by the lamp or by one odd pixel, ends without a round number, log 0.
TEST(ColorScale, IsChosenByMostOfWhatDoesNotEmit) {
  std::vector<float> values(300, 0.3f);
  values[0] = 0;
  values[1] = 1e-7f;
  values[2] = 30; // an edge of the lamp
  std::fill(values.begin() + 200, values.end(), 2.1f);
  Picture picture = row_of(values);
  picture.kind[250] = PixelKind::kEmitter;
  ColorScale scale;
  ASSERT_TRUE(choose_scale(picture, false, &scale).ok());
  EXPECT_EQ(scale.min, 0);
  EXPECT_EQ(scale.max, 2.5);
  ASSERT_TRUE(choose_scale(picture, true, &scale).ok());
  EXPECT_EQ(scale.min, 0.2);
  EXPECT_EQ(scale.max, 5);
  ASSERT_TRUE(choose_scale(row_of({1e-9f, 30, 30}), true, &scale).ok());
  EXPECT_EQ(scale.min, 0.005);
  EXPECT_EQ(scale.max, 50);
  ASSERT_TRUE(choose_scale(row_of({5, 5}), true, &scale).ok());
  EXPECT_LT(scale.min, scale.max);
  ASSERT_TRUE(choose_scale(row_of({0}), false, &scale).ok());
  EXPECT_EQ(scale.max, 1);
  EXPECT_EQ(choose_scale(row_of({0}), true, &scale).code(), StatusCode::kInvalidArgument);
  ASSERT_TRUE(choose_scale(row_of({3}, PixelKind::kEmitter), false, &scale).ok());
  EXPECT_EQ(scale.max, 3);
}

// Catches: the mean taken over the background too: a rim of low values around everything.
TEST(FalseColor, ACutPixelKeepsItsColourAndFadesIntoBlack) {
  Picture picture = row_of({6, 3, 0});
  picture.hits[1] = 2; // 3 is the mean of 6, 6, and twice the background
  picture.hits[2] = 0;
  ColorImage image;
  ASSERT_TRUE(false_color_image(picture, {2, 10, false}, &image).ok());
  const Color whole = false_color(0.5);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_EQ(image.rgb[channel], whole[channel]);
    EXPECT_NEAR(image.rgb[3 + channel], whole[channel] / 2.0, 0.6);
    EXPECT_EQ(image.rgb[6 + channel], 0);
  }
}

/// An image, and whether a pixel has a colour.
struct Legend {
  explicit Legend(std::uint32_t height, const ColorScale& scale = {0, 1, false}) {
    EXPECT_TRUE(image.init(10, height, 77).ok());
    EXPECT_TRUE(add_legend(scale, Quantity::kIrradiance, &image).ok());
  }
  Color at(std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* pixel = image.pixel(x, y);
    return {pixel[0], pixel[1], pixel[2]};
  }
  ColorImage image;
};

// Catches: a bar upside down or cut, a legend over the picture, a width that films cannot have.
TEST(Legend, StandsBesideThePictureWithTheWholeScale) {
  for (const std::uint32_t height : {kMinLegendHeight, 200u, 600u, 1500u}) {
    Legend legend(height);
    EXPECT_EQ(legend.image.height, height);
    EXPECT_EQ(legend.image.width % 2, 0u);
    EXPECT_GT(legend.image.width, 10u + 40u);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < 10; ++x)
        ASSERT_EQ(legend.at(x, y), (Color{77, 77, 77}));
    std::vector<std::uint32_t> top, bottom;
    for (std::uint32_t x = 10; x < legend.image.width; ++x)
      for (std::uint32_t y = 0; y < height; ++y) {
        if (legend.at(x, y) == false_color(1))
          top.push_back(y);
        if (legend.at(x, y) == false_color(0))
          bottom.push_back(y);
      }
    ASSERT_FALSE(top.empty());
    ASSERT_FALSE(bottom.empty());
    EXPECT_LT(*std::max_element(top.begin(), top.end()),
              *std::min_element(bottom.begin(), bottom.end()));
    EXPECT_GT(bottom.back() - top.front(), height / 4);
    EXPECT_LT(bottom.back(), height - 1);
  }
}

// Catches: a tick beside the colour it names.
TEST(Legend, TicksStandAtTheirColours) {
  Legend legend(600, {0, 1, false});
  const Color ink{230, 230, 230};
  std::uint32_t bar = 10; // the bar's right edge: where ticks begin
  while (legend.at(bar, 300) == Color{} || legend.at(bar, 300) == ink)
    ++bar;
  const std::uint32_t inside = bar;
  while (legend.at(bar, 300) != Color{} && legend.at(bar, 300) != ink)
    ++bar;
  std::vector<double> shares;
  for (std::uint32_t y = 0; y + 1 < 600; ++y)
    if (legend.at(inside, y + 1) != Color{} && legend.at(inside, y + 1) != ink &&
        legend.at(bar, y) == ink && legend.at(bar, y + 1) == ink) { // two pixels thick
      double best = 1e9, share = 0;
      for (int k = 0; k <= 100; ++k) {
        double distance = 0;
        for (std::size_t c = 0; c < 3; ++c)
          distance += std::fabs(false_color(k / 100.0)[c] - legend.at(inside, y + 1)[c]);
        if (distance < best) {
          best = distance;
          share = k / 100.0;
        }
      }
      shares.push_back(share);
    }
  ASSERT_EQ(shares.size(), 11u);
  for (std::size_t k = 0; k < shares.size(); ++k)
    EXPECT_NEAR(shares[k], 1 - 0.1 * static_cast<double>(k), 0.011) << k;
}

// Catches: a unit or name that the font cannot draw.
TEST(Font, HasWhatLegendsSay) {
  for (const std::string text : {"0123456789.-e", "radiosity", "radiance", "irradiance", "exitance",
                                 "error", "relative", "W/m^2", "W/m^2 sr"})
    for (const char c : text)
      EXPECT_TRUE(c == ' ' || has_glyph(c)) << c;
  EXPECT_FALSE(has_glyph('Q'));
}

// Catches: mirrored glyphs, two characters that look the same, drawing beyond the image.
TEST(Font, DrawsLegibleGlyphs) {
  std::set<std::string> pictures;
  int characters = 0;
  for (char c = ' ' + 1; c < 127; ++c) {
    if (!has_glyph(c))
      continue;
    ++characters;
    ColorImage image;
    ASSERT_TRUE(image.init(kGlyphWidth, kGlyphHeight).ok());
    draw_text(std::string(1, c), 0, 0, 1, {255, 255, 255}, &image);
    pictures.insert(std::string(image.rgb.begin(), image.rgb.end()));
  }
  EXPECT_EQ(pictures.size(), static_cast<std::size_t>(characters));
  ColorImage seven;
  ASSERT_TRUE(seven.init(12, 14).ok());
  draw_text("7", 0, 0, 2, {255, 0, 0}, &seven);
  std::string drawn;
  for (std::uint32_t y = 0; y < 14; y += 2)
    for (std::uint32_t x = 0; x < 10; x += 2) {
      drawn += *seven.pixel(x, y) == 255 ? '#' : '.';
      EXPECT_EQ(*seven.pixel(x, y), *seven.pixel(x + 1, y + 1));
    }
  EXPECT_EQ(drawn, "#####"
                   "....#"
                   "...#."
                   "..#.."
                   ".#..."
                   ".#..."
                   ".#...");
  draw_text("88888", 9, 12, 3, {1, 2, 3}, &seven); // cut off
  EXPECT_EQ(text_width("W/m^2", 2), 58u);
}

} // namespace
} // namespace hemicube::radiosity::test
