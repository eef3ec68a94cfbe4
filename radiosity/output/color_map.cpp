#include "radiosity/output/color_map.h"

namespace hemicube::radiosity {
namespace {

/// At shares 0, 1/16 ... 1.
constexpr std::uint8_t kColors[17][3] = {
    {65, 7, 116},   {63, 30, 134},  {58, 48, 150},   {49, 68, 158},   {39, 86, 156},
    {32, 103, 154}, {17, 119, 155}, {0, 134, 155},   {18, 149, 153},  {44, 163, 148},
    {64, 178, 141}, {83, 192, 130}, {111, 205, 115}, {148, 216, 104}, {184, 225, 99},
    {219, 234, 97}, {253, 242, 101}};
constexpr int kSteps = 16;

} // namespace

Color false_color(double share) noexcept {
  const double at = !(share > 0) ? 0 : share < 1 ? share * kSteps : kSteps;
  const int below = at < kSteps ? static_cast<int>(at) : kSteps - 1;
  const double part = at - below;
  Color color;
  for (std::size_t channel = 0; channel < color.size(); ++channel) {
    // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign): 0 <= below < kSteps, also of NaN
    const double low = kColors[below][channel], high = kColors[below + 1][channel];
    color[channel] = static_cast<std::uint8_t>(low + part * (high - low) + 0.5);
  }
  return color;
}

} // namespace hemicube::radiosity
