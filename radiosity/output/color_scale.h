#pragma once

#include "radiosity/output/picture.h"

#include <string_view>

namespace hemicube::radiosity {

/// Which values false colours span.
struct ColorScale {
  double min = 0, max = 1; ///< min < max; above 0 if is_log
  bool is_log = false;

  /// Where a value lies: 0 at min or below, 1 at max or above.
  double share(double value) const noexcept;
};

/// A scale for what a picture shows of surfaces that do not emit (of emitters where nothing else is
/// lit). Linear: from 0 to what 99 % of its pixels are below; logarithmic: from what 99 % are
/// above, at most four decades. Ends are round numbers.
/// @return kInvalidArgument for a logarithmic one if nothing is above 0
Status choose_scale(const Picture& picture, bool is_log, ColorScale* scale);

/// The scalar that false colours show of a pixel: the mean luminance over the samples that show
/// something. `pixel` is one that does.
double shown_value(const Picture& picture, std::size_t pixel) noexcept;

/// A marked value of a scale: a short decimal number.
struct Tick {
  double value = 0;
  char digits[32] = {};
  std::string_view text() const noexcept { return digits; }
};

inline constexpr std::size_t kMostTicks = 16;

/// Fills the ticks of a scale, ascending: multiples of 1, 2 or 5 times a power of ten; where a
/// logarithmic scale spans more than a decade, powers of ten and as many between as fit.
/// @param most  how many there may be, 3..kMostTicks
/// @return how many there are
std::size_t make_ticks(const ColorScale& scale, std::size_t most, Tick* ticks) noexcept;

} // namespace hemicube::radiosity
