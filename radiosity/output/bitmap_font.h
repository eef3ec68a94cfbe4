#pragma once

#include "radiosity/output/color_image.h"

#include <string_view>

namespace hemicube::radiosity {

/// Cells of a glyph, 5 x 7, and what it takes with the gap to the next one.
inline constexpr std::uint32_t kGlyphWidth = 5, kGlyphHeight = 7, kGlyphAdvance = 6;

/// Whether a character can be drawn: digits, what numbers and units need, and the letters of the
/// quantities' names.
bool has_glyph(char character) noexcept;

/// Pixels that a text is wide, at `scale` pixels a cell.
std::uint32_t text_width(std::string_view text, std::uint32_t scale) noexcept;

/// Draws a text with its upper left corner at (x, y); what lies outside the image is cut off, and a
/// character without a glyph leaves its place empty.
void draw_text(std::string_view text, std::uint32_t x, std::uint32_t y, std::uint32_t scale,
               const Color& color, ColorImage* image) noexcept;

} // namespace hemicube::radiosity
