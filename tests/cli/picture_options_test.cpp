// What `hemicube render` draws, by its options.

#include "radiosity/output/tone.h"
#include "tests/cli/cli_case.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace hemicube::test {
namespace {

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
               "--camera-up",       "0,1,0",       "--size",          "65x65"};
  }

  /// Solves the room into the folder "out".
  void solve(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"solve", write_room(), "-o", path("out"), "--quiet"});
    run(0, more);
  }

  ProgramResult render(const std::string& image, const std::vector<std::string>& options,
                       int exit_code = 0) const {
    std::vector<std::string> all = {"render", path("out"), "-o", path(image)};
    all.insert(all.end(), camera_.begin(), camera_.end());
    all.insert(all.end(), options.begin(), options.end());
    return run(exit_code, all);
  }

  Image drawn(const std::vector<std::string>& options, std::string* said = nullptr) const {
    const ProgramResult result = render("drawn.ppm", options);
    if (said != nullptr)
      *said = result.err;
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
      values.push_back(std::stod(text));
    return values;
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

  std::vector<std::string> camera_;
};

// Catches: an option that does nothing, or another's work.
TEST_F(PictureOptionsTest, QuantitiesAreThoseOfTheSolution) {
  solve();
  const auto floor = [this](const std::string& quantity) {
    return drawn({"--quantity", quantity, "--exposure", "0.1", "--flat"}).at(32, 32);
  };
  const std::vector<double> h = numbers("irradiance_r"), b = numbers("radiosity_r");
  ASSERT_FALSE(h.empty());
  EXPECT_EQ(floor("irradiance")[0], grey(0.1 * h.front())[0]);
  EXPECT_EQ(floor("radiosity")[0], grey(0.1 * b.front() / 3.14159265358979)[0]);
  EXPECT_EQ(floor("exitance"), grey(0));
}

// Catches: NaN drawn, or no word of it.
TEST_F(PictureOptionsTest, UnknownIrradianceIsBackgroundWithANote) {
  solve({"--no-black-irradiance"});
  camera_ = {"--camera-position", "0.5,0.5,0.1", "--camera-target", "0.5,0.5,1",
             "--camera-up",       "0,1,0",       "--size",          "8x8"};
  std::string said;
  EXPECT_EQ(drawn({"--quantity", "irradiance"}, &said).at(4, 4), grey(0));
  EXPECT_NE(said.find("1 patch is drawn as background"), std::string::npos) << said;
}

TEST_F(PictureOptionsTest, BadValuesAreNamed) {
  for (const std::string value : {"0", "9", "-1", "3x", ""})
    refused({"--samples", value}, {"--samples " + value, "1..8"});
  refused({"--quantity", "colour"}, {"--quantity colour", "irradiance", "exitance"});
  refused({"--samples", "8", "--size", "16384x4"}, {"16384", "16383"});
}

} // namespace
} // namespace hemicube::test
