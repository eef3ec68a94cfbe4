#pragma once

#include "raster/memory.h"

#include <array>
#include <cstdint>

namespace hemicube::radiosity {

/// An 8-bit display colour: red, green, blue in sRGB.
using Color = std::array<std::uint8_t, 3>;

/// An image of display colours, rows from the top.
struct ColorImage {
  std::uint32_t width = 0, height = 0;
  Buffer<std::uint8_t> rgb; ///< [height][width][3]

  Status init(std::uint32_t columns, std::uint32_t rows, std::uint8_t paper = 0) {
    width = columns;
    height = rows;
    rgb.clear();
    return rgb.resize(std::size_t{columns} * rows * 3, paper);
  }

  std::uint8_t* pixel(std::size_t x, std::size_t y) noexcept {
    return rgb.data() + (y * width + x) * 3;
  }
  void set(std::size_t x, std::size_t y, const Color& color) noexcept {
    std::uint8_t* at = pixel(x, y);
    for (std::size_t channel = 0; channel < 3; ++channel)
      at[channel] = color[channel];
  }
};

} // namespace hemicube::radiosity
