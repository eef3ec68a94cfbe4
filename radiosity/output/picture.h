#pragma once

#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// What the middle of a pixel shows.
enum class PixelKind : std::uint8_t { kBackground, kSurface, kEmitter };

/// A picture of a solution, rows from the top, before any display curve.
struct Picture {
  std::uint32_t width = 0, height = 0;
  Buffer<float> rgb; ///< [row][column][3] radiance L = B / pi, W/(m^2 sr), linear; background 0
  Buffer<PixelKind> kind; ///< [row][column]
};

/// Draws a solution from a camera, 3 x 3 samples a pixel averaged in linear light. Back faces are
/// not drawn. A point of a patch shows the interpolation (interpolation.h) of its corner values.
/// @param corner_radiosity  from vertex_radiosities()
/// @return kInvalidArgument for a camera that shows nothing; kOutOfMemory
/// Deterministic: + - * / sqrt only, in a fixed order.
Status draw_picture(const Scene& scene, const PatchSet& patches, const Solution& solution,
                    std::span<const float> corner_radiosity, const Camera& camera,
                    const raster::Kernels& kernels, Picture* picture);

/// An exposure for display: the brightest 5 % of the pixels that show lit surfaces which do not
/// emit are at or above 0.8 of display white. A picture of emitters alone is exposed for them, a
/// black one gets 1.
/// @param given  an exposure that was asked for, and is returned; 0 = none was
Result<double> choose_exposure(const Picture& picture, double given = 0);

/// Relative luminance of linear sRGB.
inline double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

} // namespace hemicube::radiosity
