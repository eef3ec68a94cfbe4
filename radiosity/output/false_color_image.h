#pragma once

#include "radiosity/output/color_image.h"
#include "radiosity/output/color_scale.h"

namespace hemicube::radiosity {

/// The lowest picture that a legend has room beside.
inline constexpr std::uint32_t kMinLegendHeight = 80;

/// Colours a picture by its scalar, shown_value(); where a pixel is partly background the colour is
/// mixed with black. Background is black.
/// @return kOutOfMemory
Status false_color_image(const Picture& picture, const ColorScale& scale, ColorImage* image);

/// Widens an image by a strip at its right with the colours of a scale, ticks, numbers, and the
/// quantity with its unit. The image is at least kMinLegendHeight high; its new width is even.
/// @return kOutOfMemory
Status add_legend(const ColorScale& scale, Quantity quantity, ColorImage* image);

} // namespace hemicube::radiosity
