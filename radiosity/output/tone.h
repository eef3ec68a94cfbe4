#pragma once

#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// The sRGB transfer curve (IEC 61966-2-1) to 8 bit, exactly rounded without pow: 255 decision
/// thresholds, computed once from + - * /.
class SrgbEncoder {
public:
  SrgbEncoder() noexcept;

  /// @param linear  1 = display white; below 0 and NaN give 0, above 1 gives 255
  std::uint8_t operator()(double linear) const noexcept;

private:
  double thresholds_[255]; ///< smallest linear value that is shown as k + 1
};

/// Relative luminance of linear sRGB.
inline double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/// How linear light becomes display light.
enum class ToneCurve {
  kSrgb,    ///< the exposure alone; what is brighter than display white is clipped
  kReinhard ///< luminance Y becomes Y (1 + Y / white^2) / (1 + Y): highlights keep their shape
};
struct Tone {
  double exposure = 1; ///< display white is 1 / exposure
  ToneCurve curve = ToneCurve::kSrgb;
  double white = 1; ///< of kReinhard: the linear luminance, before the exposure, that becomes white
};

/// Encodes linear values; out receives as many bytes as there are values.
/// @param linear  [pixel][3]
/// @return kOutOfMemory
/// Source of kReinhard: Reinhard, Stark, Shirley, Ferwerda 2002, "Photographic Tone Reproduction
/// for Digital Images", the operator with a white point; colours keep their ratios.
Status tone_map(std::span<const float> linear, const Tone& tone, Buffer<std::uint8_t>* out);

} // namespace hemicube::radiosity
