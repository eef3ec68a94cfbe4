#pragma once

#include "radiosity/scene/scene.h"

#include <array>
#include <cstdint>

namespace hemicube::radiosity {

/// How the bands of a scene become red, green and blue: the bands r, g and b where a scene has all
/// three; otherwise grey, the mean of all bands. Or grey, one band alone.
class DisplayBands {
public:
  explicit DisplayBands(const NameTable& bands) noexcept
      : count_(bands.size()), rgb_{bands.find("r"), bands.find("g"), bands.find("b")} {
    is_grey_ = rgb_[0] == NameTable::kAbsent || rgb_[1] == NameTable::kAbsent ||
               rgb_[2] == NameTable::kAbsent;
  }

  DisplayBands(const NameTable& bands, std::uint32_t band) noexcept
      : count_(bands.size()), rgb_{band, band, band}, is_grey_(false) {}

  /// @param values  [band]
  template <typename Number> Vec3 operator()(const Number* values) const noexcept {
    if (!is_grey_)
      return {static_cast<double>(values[rgb_[0]]), static_cast<double>(values[rgb_[1]]),
              static_cast<double>(values[rgb_[2]])};
    double sum = 0;
    for (std::uint32_t band = 0; band < count_; ++band)
      sum += static_cast<double>(values[band]);
    return Vec3(sum / count_);
  }

private:
  std::uint32_t count_;
  std::array<std::uint32_t, 3> rgb_;
  bool is_grey_ = true;
};

} // namespace hemicube::radiosity
