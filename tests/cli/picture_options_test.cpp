// What `hemicube render` draws, by its options.

#include "radiosity/output/color_map.h"
#include "radiosity/output/color_scale.h"
#include "radiosity/output/tone.h"
#include "tests/cli/cli_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

using namespace std::string_literals;

/// An image read back from a binary .ppm.
struct Image {
  std::size_t width = 0, height = 0;
  std::string rgb;

  std::string at(std::size_t x, std::size_t y) const { return rgb.substr((y * width + x) * 3, 3); }
};

class PictureOptionsTest : public CliCase {
protected:
  void SetUp() override {
    CliCase::SetUp();
    // A narrow camera within the room: the middle of the floor.
    camera_ = {"--camera-position", "0.5,0.5,0.9", "--camera-target", "0.5,0.5,0",
               "--camera-up",       "0,1,0",       "--size",          "64x64"};
  }

  /// Solves the room into the folder "out".
  void solve(std::vector<std::string> more = {}) {
    input_ = path("out");
    more.insert(more.begin(), {"solve", write_room(), "-o", path("out"), "--quiet"});
    run(0, more);
  }

  ProgramResult render(const std::string& image, const std::vector<std::string>& options,
                       int exit_code = 0) const {
    std::vector<std::string> all = {"render", input_, "-o", path(image)};
    const bool has_size = std::find(options.begin(), options.end(), "--size") != options.end();
    all.insert(all.end(), camera_.begin(), camera_.end() - (has_size ? 2 : 0));
    all.insert(all.end(), options.begin(), options.end());
    return run(exit_code, all);
  }

  Image drawn(const std::vector<std::string>& options, std::string* said = nullptr) const {
    const ProgramResult result = render("drawn.ppm", options);
    if (said != nullptr)
      *said = result.err + result.out;
    const std::string bytes = read("drawn.ppm");
    Image image;
    std::size_t end = 0;
    for (int line = 0; line < 3; ++line)
      end = bytes.find('\n', end) + 1;
    std::sscanf(bytes.c_str(), "P6 %zu %zu", &image.width, &image.height);
    image.rgb = bytes.substr(end);
    EXPECT_EQ(image.rgb.size(), image.width * image.height * 3);
    return image;
  }

  /// A column of the table of the solution.
  std::vector<double> numbers(const std::string& column) const {
    std::vector<double> values;
    for (const std::string& text : column_of(read("out/patches.csv"), column))
      values.push_back(text.empty() ? std::nan("") : std::stod(text));
    return values;
  }

  static std::string text_of(const radiosity::Color& color) { return {color.begin(), color.end()}; }

  static int most_difference(const std::string& a, const std::string& b) {
    int most = a.size() == b.size() ? 0 : 256;
    for (std::size_t k = 0; k < a.size() && k < b.size(); ++k)
      most = std::max(
          most, std::abs(static_cast<unsigned char>(a[k]) - static_cast<unsigned char>(b[k])));
    return most;
  }

  static std::string grey(double linear) {
    return std::string(3, static_cast<char>(radiosity::SrgbEncoder()(linear)));
  }

  /// Expects a usage error of `render` on the room, before the work.
  void refused(const std::vector<std::string>& options, const std::vector<std::string>& parts,
               const std::string& image = "a.png") {
    std::vector<std::string> all = {"render", write_room(), "-o", path(image)};
    all.insert(all.end(), options.begin(), options.end());
    expect_refused(2, all, parts);
  }

  std::string input_; ///< what render() draws
  std::vector<std::string> camera_;
};

// Catches: the wrong column of the solution, the wrong band or unit in false colours, unknown
// values without a word, an option that does nothing.
TEST_F(PictureOptionsTest, PixelsAreThoseOfTheTable) {
  solve({"--max-edge", "0.5", "--no-black-irradiance"});
  std::string said;
  EXPECT_EQ(drawn({"--quantity", "irradiance", "--exposure", "0.1", "--flat"}, &said).at(20, 44)[0],
            grey(0.1 * numbers("irradiance_r").front())[0]);
  EXPECT_NE(said.find("4 patches are drawn as background"), std::string::npos) << said;

  const Image numbered = drawn(
      {"--false-color", "--band", "g", "--range", "0.1,20", "--log", "--flat", "--size", "90x90"},
      &said);
  const double share = radiosity::ColorScale{0.1, 20, true}.share(numbers("radiosity_g").front());
  EXPECT_EQ(numbered.at(30, 60), text_of(radiosity::false_color(share)));
  EXPECT_GT(numbered.width, 90u);
  EXPECT_NE(said.find("colours from 0.1 to 20"), std::string::npos) << said;

  // The floor is of four patches, which share the middle of the picture.
  const Image lined =
      drawn({"--flat", "--samples", "1", "--mesh", "--tone", "reinhard", "--exposure", "0.5"});
  radiosity::Tone tone{0.5, radiosity::ToneCurve::kReinhard, 0};
  std::vector<float> light;
  for (std::size_t patch = 0; patch < 4; ++patch) {
    for (const char* band : {"radiosity_r", "radiosity_g", "radiosity_b"})
      light.push_back(static_cast<float>(numbers(band)[patch] / 3.14159265358979));
    const float* rgb = light.data() + 3 * patch;
    tone.white = std::max(tone.white, radiosity::luminance(static_cast<double>(rgb[0]),
                                                           static_cast<double>(rgb[1]),
                                                           static_cast<double>(rgb[2])));
  }
  Buffer<std::uint8_t> shown;
  ASSERT_TRUE(radiosity::tone_map(light, tone, &shown).ok());
  const radiosity::Color first{shown[0], shown[1], shown[2]};
  EXPECT_EQ(lined.at(3, 60), text_of(first));
  EXPECT_EQ(lined.at(28, 34), text_of(first));
  radiosity::Color line; // half of the patch, half black
  for (std::size_t channel = 0; channel < 3; ++channel)
    line[channel] = static_cast<std::uint8_t>((first[channel] + 1) / 2);
  EXPECT_EQ(lined.at(31, 50), text_of(line));
}

// Catches: ids that a float cannot hold or that are colours; light computed for nothing.
TEST_F(PictureOptionsTest, PatchIdsNeedNoLight) {
  // Light that is reflected for ever: there is no solution.
  const std::string scene = write_room(kRoomObj, "newmtl white\nKd 1 1 1\n"
                                                 "newmtl light\nKd 1 1 1\nKe 1 1 1\n"
                                                 "newmtl red\nKd 1 1 1\n");
  run(1, {"render", scene, "-o", path("light.png"), "--size", "8x8"});
  const ProgramResult result = run(0, {"render", scene, "-o", path("ids.exr"), "--quantity",
                                       "patch-id", "--size", "8x8", "--json"});
  EXPECT_EQ(nlohmann::json::parse(result.out).count("exposure"), 0u);
  const std::string bytes = read("ids.exr"); // its channel list: id, unsigned integers
  const std::string channel = std::string("chlist") + '\0' + "\x14\0\0\0id\0"s + "\0\0\0\0"s;
  EXPECT_NE(bytes.find(channel), std::string::npos);
}

// Catches: frames named over each other, a flicker of the exposure, half a film.
TEST_F(PictureOptionsTest, AFilmGoesAroundTheTargetAtOneExposure) {
  input_ = write_room();
  camera_ = {"--camera-position", "0.5,0.1,0.5", "--camera-target", "0.5,0.5,0.5",
             "--camera-up",       "0,0,1",       "--size",          "16x16"};
  const ProgramResult film = render("film.ppm", {"--orbit", "3", "--max-edge", "0.3"});
  EXPECT_NE(film.out.find("3 frames"), std::string::npos) << film.out;
  std::set<std::string> frames;
  for (const char* name : {"film.0000.ppm", "film.0001.ppm", "film.0002.ppm"})
    frames.insert(read(name));
  EXPECT_EQ(frames.size(), 3u);
  EXPECT_EQ(new_files().count("film.ppm"), 0u);
  const std::string exposure = film.out.substr(film.out.find("exposure ") + 9);
  const double angle = 2 * 3.14159265358979 / 3, x = 0.5 + 0.4 * std::sin(angle),
               y = 0.5 - 0.4 * std::cos(angle);
  camera_[1] = std::to_string(x) + "," + std::to_string(y) + ",0.5";
  const std::string second = read("film.0001.ppm"), first = read("film.0000.ppm");
  EXPECT_LE(
      most_difference(
          drawn({"--exposure", exposure.substr(0, exposure.size() - 1), "--max-edge", "0.3"}).rgb,
          second.substr(second.size() - 768)),
      2);
  EXPECT_GT(most_difference(first, second), 20);
  // None at all where one frame cannot be written.
  std::filesystem::create_directories(path("new.0002.ppm"));
  EXPECT_NE(render("new.ppm", {"--orbit", "3"}, 1).err.find("new.0002.ppm"), std::string::npos);
  EXPECT_EQ(new_files().count("new.0000.ppm"), 0u);
}

// Catches: an option silently without effect.
TEST_F(PictureOptionsTest, WhatMakesNoSenseTogetherIsRefused) {
  using Words = std::vector<std::string>;
  for (const Words& words : {Words{"--range", "0,1"}, {"--log"}})
    refused(words, {words.front() + ": needs --false-colour"});
  for (const Words& words : {Words{"--tone", "srgb"}, {"--exposure", "2"}}) {
    Words both = words;
    both.push_back("--false-colour");
    refused(both, {words.front() + ":", "--false-colour"});
  }
  for (const Words& words : {Words{"--false-colour"}, {"--tone", "reinhard"}, {"--mesh"}})
    refused(words, {words.front() + ":", ".png"}, "a.exr");
  for (const Words& words : {Words{"--false-color"},
                             {"--mesh"},
                             {"--samples", "2"},
                             {"--band", "r"},
                             {"--tone", "srgb"},
                             {"--exposure", "2"}}) {
    Words both = words;
    both.insert(both.end(), {"--quantity", "patch-id"});
    refused(both, {"patch ids"});
  }
  for (const std::string range : {"0,1", "-1,1"})
    refused({"--false-colour", "--log", "--range", range}, {"--range", "--log", "above 0"});
  refused({"--orbit", "4"}, {"--orbit", "number"}, "film.0003.png");
  refused({"--orbit", "4", "--camera-position", "0,0,3", "--camera-target", "0,0,1", "--camera-up",
           "0,0,1"},
          {"camera", "up"});
  refused({"--false-colour", "--size", "90x79"}, {"legend", "79", "80"});
  refused({"--quantity", "patch-id"}, {"numbers", ".exr"}, "a.hdr");
}

TEST_F(PictureOptionsTest, BadValuesAreNamed) {
  for (const std::string value : {"0", "9", "-1", "3x", ""})
    refused({"--samples", value}, {"--samples " + value, "1..8"});
  refused({"--quantity", "colour"}, {"--quantity colour", "irradiance", "exitance"});
  for (const std::string value :
       {"1", "1,2,3", "2,1", "1,1", "a,b", "0,inf", "nan,1", "0,1e31", ""})
    refused({"--false-colour", "--range", value}, {"--range " + value, "MIN,MAX"});
  for (const std::string value : {"0", "-1", "10001", "4.5"})
    refused({"--orbit", value}, {"--orbit " + value, "1..10000"});
  refused({"--tone", "filmic"}, {"--tone filmic", "srgb, reinhard"});
  refused({"--band", "x"}, {"--band x", "r, g, b"});
  refused({"--samples", "8", "--size", "16384x4"}, {"16384", "16383"});
}

} // namespace
} // namespace hemicube::test
