#pragma once

#include "radiosity/output/color_image.h"

namespace hemicube::radiosity {

/// The false colour of a share: violet for 0 or less, over blue and green to yellow for 1 or more.
/// The lightness L* of CIELAB rises evenly from 18 to 94, so that equal differences look equal, to
/// the colour-blind and in grey too. In the spirit of viridis, with a table of our own: a path
/// through OKLab of even steps in lightness and hue, as colourful as sRGB allows.
/// Deterministic: + - * and one rounding.
Color false_color(double share) noexcept;

} // namespace hemicube::radiosity
