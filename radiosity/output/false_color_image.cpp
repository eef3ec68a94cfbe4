#include "radiosity/output/false_color_image.h"

#include "radiosity/output/bitmap_font.h"
#include "radiosity/output/color_map.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

constexpr Color kInk{230, 230, 230};

struct Title {
  std::string_view name, unit;
};

Title title_of(Quantity quantity) noexcept {
  switch (quantity) {
  case Quantity::kRadiance:
    return {"radiance", "W/m^2 sr"};
  case Quantity::kRadiosity:
    return {"radiosity", "W/m^2"};
  case Quantity::kIrradiance:
    return {"irradiance", "W/m^2"};
  case Quantity::kExitance:
    return {"exitance", "W/m^2"};
  case Quantity::kError:
    return {"error", "relative"};
  }
  return {};
}

/// Where the parts of a legend stand, in pixels from its upper left corner.
struct LegendLayout {
  std::uint32_t scale; ///< pixels a cell of the font
  std::uint32_t gap, line, bar_x, bar_width, bar_top, bar_height, tick_width, text_x;

  explicit LegendLayout(std::uint32_t height) noexcept : scale(std::max((height + 300) / 450, 1u)) {
    gap = 5 * scale;
    line = (kGlyphHeight + 3) * scale;
    bar_x = gap;
    bar_width = 12 * scale;
    bar_top = 3 * gap + 2 * line; // under the two lines of the title
    bar_height = height - bar_top - 2 * gap;
    tick_width = 3 * scale;
    text_x = bar_x + bar_width + tick_width + gap / 2;
  }

  std::size_t most_ticks() const noexcept {
    return std::clamp<std::size_t>(bar_height / (5 * line / 2) + 1, 3, 11);
  }
  /// The row of the picture at a share of the scale; 1 is the uppermost of the bar.
  std::uint32_t row(double share) const noexcept {
    return bar_top + bar_height - 1 -
           static_cast<std::uint32_t>(share * static_cast<double>(bar_height - 1) + 0.5);
  }
};

void draw_bar(const ColorScale& scale, const LegendLayout& layout, std::span<const Tick> ticks,
              std::uint32_t left, ColorImage* image) noexcept {
  for (std::uint32_t y = 0; y < layout.bar_height; ++y) {
    const Color color = false_color(1 - static_cast<double>(y) / (layout.bar_height - 1));
    for (std::uint32_t x = 0; x < layout.bar_width; ++x)
      image->set(left + layout.bar_x + x, layout.bar_top + y, color);
  }
  for (const Tick& tick : ticks) {
    const std::uint32_t row = layout.row(scale.share(tick.value));
    const std::uint32_t half = layout.scale / 2;
    for (std::uint32_t y = 0; y < layout.scale; ++y)
      for (std::uint32_t x = 0; x < layout.tick_width; ++x)
        image->set(left + layout.bar_x + layout.bar_width + x, row - half + y, kInk);
    draw_text(tick.text(), left + layout.text_x, row - kGlyphHeight * layout.scale / 2,
              layout.scale, kInk, image);
  }
}

} // namespace

Status false_color_image(const Picture& picture, const ColorScale& scale, ColorImage* image) {
  HC_TRY(image->init(picture.width, picture.height));
  const std::uint32_t samples = picture.samples * picture.samples;
  for (std::size_t i = 0; i < picture.hits.size(); ++i) {
    if (picture.hits[i] == 0)
      continue;
    const Color color = false_color(scale.share(shown_value(picture, i)));
    for (std::size_t channel = 0; channel < color.size(); ++channel)
      image->rgb[3 * i + channel] =
          static_cast<std::uint8_t>((color[channel] * picture.hits[i] + samples / 2) / samples);
  }
  return {};
}

Status add_legend(const ColorScale& scale, Quantity quantity, ColorImage* image) {
  HC_ASSERT(image->height >= kMinLegendHeight);
  const LegendLayout layout(image->height);
  Tick ticks[kMostTicks];
  const std::size_t count = make_ticks(scale, layout.most_ticks(), ticks);
  const Title title = title_of(quantity);

  std::uint32_t right = layout.gap + text_width(title.name, layout.scale);
  right = std::max(right, layout.gap + text_width(title.unit, layout.scale));
  for (std::size_t k = 0; k < count; ++k)
    right = std::max(right, layout.text_x + text_width(ticks[k].text(), layout.scale));
  std::uint32_t width = image->width + right + layout.gap;
  width += width % 2;

  ColorImage wide;
  HC_TRY(wide.init(width, image->height));
  for (std::uint32_t y = 0; y < image->height; ++y)
    std::copy_n(image->pixel(0, y), 3 * std::size_t{image->width}, wide.pixel(0, y));
  const std::uint32_t left = image->width;
  draw_text(title.name, left + layout.gap, layout.gap, layout.scale, kInk, &wide);
  draw_text(title.unit, left + layout.gap, layout.gap + layout.line, layout.scale, kInk, &wide);
  draw_bar(scale, layout, {ticks, count}, left, &wide);
  *image = std::move(wide);
  return {};
}

} // namespace hemicube::radiosity
