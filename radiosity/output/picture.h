#pragma once

#include "radiosity/output/picture_values.h"
#include "radiosity/output/tone.h"
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
  Buffer<PixelKind> kind;     ///< [row][column]
  Buffer<std::uint8_t> hits;  ///< [row][column] samples that show something known
  Buffer<std::uint8_t> lines; ///< [row][column] samples on an edge of a patch; empty: none were
                              ///< asked for
};

/// How a picture is drawn.
struct PictureSetting {
  static constexpr std::uint32_t kSamples = 3, kAllBands = NameTable::kAbsent;

  const raster::Kernels& kernels;
  std::uint32_t samples = kSamples; ///< along each side of a pixel, 1..kMaxSamples
  bool mesh = false;                ///< find the edges of patches
  std::uint32_t band = kAllBands;   ///< one band in grey; all: as DisplayBands has them
};

/// Draws values of a solution from a camera, samples x samples a pixel averaged in linear light.
/// Back faces are not drawn. A point of a patch shows the interpolation (interpolation.h) of its
/// corner values; a patch without a known value is background.
/// @return kInvalidArgument for a camera that shows nothing; kOutOfMemory
/// Deterministic: + - * / sqrt only, in a fixed order: equal for any executor and kernels.
Status draw_picture(const Scene& scene, const PatchSet& patches, const PictureValues& values,
                    const Camera& camera, const PictureSetting& setting, Executor& executor,
                    Picture* picture);

/// The luminances above 0 of the pixels that show surfaces which do not emit; where there are none,
/// of those that show emitters.
/// @return kOutOfMemory
Status lit_pixels(const Picture& picture, Buffer<double>* luminances);

/// The value that is larger than a share of all values, of which there is at least one; changes
/// their order.
double quantile(Buffer<double>* values, double share) noexcept;

/// An exposure for display: the brightest 5 % of the pixels that show lit surfaces which do not
/// emit are at or above 0.8 of display white. A picture of emitters alone is exposed for them, a
/// black one gets 1.
/// @param given  an exposure that was asked for, and is returned; 0 = none was
Result<double> choose_exposure(const Picture& picture, double given = 0);

double luminance_at(const Picture& picture, std::size_t pixel) noexcept;

/// The largest luminance of a picture; 1 of a black one.
double brightest(const Picture& picture) noexcept;

} // namespace hemicube::radiosity
