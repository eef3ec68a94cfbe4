#include "radiosity/output/tone.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

/// The fifth root of a in 0..1, by Newton's iteration from above.
double fifth_root(double a) noexcept {
  double y = 1;
  for (int i = 0; i < 60; ++i) {
    const double y2 = y * y;
    y = (4 * y + a / (y2 * y2)) / 5;
  }
  return y;
}

/// The linear value of an sRGB value in 0..1.
double srgb_to_linear(double encoded) noexcept {
  if (encoded <= 0.04045)
    return encoded / 12.92;
  const double t = (encoded + 0.055) / 1.055;
  return t * t * fifth_root(t * t); // t^2.4
}

} // namespace

SrgbEncoder::SrgbEncoder() noexcept {
  for (int k = 0; k < 255; ++k)
    thresholds_[k] = srgb_to_linear((k + 0.5) / 255);
}

std::uint8_t SrgbEncoder::operator()(double linear) const noexcept {
  if (!(linear > 0))
    return 0;
  return static_cast<std::uint8_t>(std::upper_bound(thresholds_, thresholds_ + 255, linear) -
                                   thresholds_);
}

Status tone_map(std::span<const float> linear, const Tone& tone, Buffer<std::uint8_t>* out) {
  const SrgbEncoder encode;
  HC_TRY(out->resize(linear.size()));
  const double white = tone.exposure * tone.white;
  for (std::size_t i = 0; i < linear.size(); i += 3) {
    const double rgb[] = {static_cast<double>(linear[i]), static_cast<double>(linear[i + 1]),
                          static_cast<double>(linear[i + 2])};
    double gain = tone.exposure;
    if (tone.curve == ToneCurve::kReinhard) {
      const double y = tone.exposure * luminance(rgb[0], rgb[1], rgb[2]);
      gain *= (1 + y / white / white) / (1 + y);
    }
    for (std::size_t channel = 0; channel < 3; ++channel)
      (*out)[i + channel] = encode(gain * rgb[channel]);
  }
  return {};
}

} // namespace hemicube::radiosity
