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

/// Scales linear values by the exposure and encodes them; out receives as many bytes as there are
/// values.
/// @return kOutOfMemory
Status tone_map(std::span<const float> linear, double exposure, Buffer<std::uint8_t>* out);

} // namespace hemicube::radiosity
