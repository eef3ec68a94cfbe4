#pragma once

#include "radiosity/output/picture_values.h"
#include "radiosity/parallel/executor.h"

namespace hemicube::radiosity {

/// What the middle of a pixel shows.
enum class PixelKind : std::uint8_t { kBackground, kSurface, kEmitter };

/// A picture of a solution, rows from the top, before any display curve.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t samples = 0; ///< along each side of a pixel
  Quantity quantity = Quantity::kRadiance;
  Buffer<float> rgb; ///< [row][column][3] mean over the samples, linear, in the quantity's unit;
                     ///< background 0
  Buffer<PixelKind> kind;    ///< [row][column]
  Buffer<std::uint8_t> hits; ///< [row][column] samples that show something known
};

/// How a picture is drawn.
struct PictureSetting {
  static constexpr std::uint32_t kSamples = 3, kAllBands = NameTable::kAbsent;

  const raster::Kernels& kernels;
  std::uint32_t samples = kSamples; ///< along each side of a pixel, 1..kMaxSamples
  std::uint32_t band = kAllBands;   ///< one band in grey; all: as DisplayBands has them
};

/// Draws values of a solution from a camera, samples x samples a pixel averaged in linear light.
/// Back faces are not drawn. A point of a patch shows the rational interpolation of its corner
/// values; a patch without a known value is background.
/// @return kInvalidArgument for a camera that shows nothing; kOutOfMemory
/// Deterministic: + - * / sqrt only, in a fixed order: equal for any executor and kernels.
Status draw_picture(const Scene& scene, const PatchSet& patches, const PictureValues& values,
                    const Camera& camera, const PictureSetting& setting, Executor& executor,
                    Picture* picture);

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
