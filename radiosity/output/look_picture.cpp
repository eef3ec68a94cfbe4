#include "radiosity/output/look_picture.h"

#include "radiosity/hemicube/five_views.h"
#include "radiosity/output/tone.h"
#include "radiosity/output/unfolded_hemicube.h"
#include "raster/rasterizer.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

constexpr std::uint32_t kPanels = 3;
constexpr std::uint32_t kGap = 16; ///< pixels between and around the panels
constexpr std::uint8_t kPaper = 40;
constexpr std::int32_t kStripe = 4; ///< pixels, on back-facing items

Status draw_face(raster::Face face, std::uint32_t resolution, raster::Rasterizer* rasterizer,
                 raster::ItemBuffer* buffer, FaceImage* out) {
  const raster::PixelGrid grid = raster::hemicube_grid(face, resolution);
  const auto pitch = static_cast<std::size_t>(grid.width);
  const std::size_t pixels = pitch * static_cast<std::size_t>(grid.height);
  HC_TRY(out->items.resize(pixels));
  HC_TRY(out->depths.resize(pixels));
  for (std::int32_t top = 0; top < grid.height; top += raster::kMaxWindowSize)
    for (std::int32_t left = 0; left < grid.width; left += raster::kMaxWindowSize) {
      const std::int32_t width = std::min(raster::kMaxWindowSize, grid.width - left);
      const std::int32_t height = std::min(raster::kMaxWindowSize, grid.height - top);
      buffer->begin({left, top, width, height});
      rasterizer->draw(face, grid, buffer);
      for (std::int32_t y = top; y < top + height; ++y) {
        const std::size_t at = static_cast<std::size_t>(y) * pitch + static_cast<std::size_t>(left);
        std::copy_n(buffer->items(y), width, out->items.data() + at);
        std::copy_n(buffer->depths(y), width, out->depths.data() + at);
      }
    }
  return {};
}

Color grey(std::uint8_t value) {
  return {value, value, value};
}

/// The three colours of a pixel of the hemicube.
class Look {
public:
  Look(const HemicubeImage& hemicube, const DeltaFormFactors& weights)
      : hemicube_(hemicube), weights_(weights) {
    for (const FaceImage& face : hemicube.faces)
      for (const float depth : face.depths)
        nearest_ = std::max(nearest_, static_cast<double>(depth));
    const auto middle = static_cast<std::int32_t>(hemicube.resolution / 2);
    heaviest_ = static_cast<double>(weights.weight(raster::Face::kTop, middle, middle));
  }

  Color color(std::uint32_t panel, const FacePixel& pixel) const {
    if (panel == 2)
      return grey(
          encode_(static_cast<double>(weights_.weight(pixel.face, pixel.x, pixel.y)) / heaviest_));
    const FaceImage& face = hemicube_.faces[static_cast<std::size_t>(pixel.face)];
    const std::size_t at = static_cast<std::size_t>(pixel.y) * hemicube_.resolution +
                           static_cast<std::size_t>(pixel.x);
    const raster::Item item = face.items[at];
    if (item == raster::kNoItem)
      return panel == 0 ? kSpaceColor : grey(0);
    return panel == 0 ? shown_item(item, pixel)
                      : grey(encode_(static_cast<double>(face.depths[at]) / nearest_));
  }

private:
  static Color shown_item(raster::Item item, const FacePixel& pixel) {
    if (raster::is_back_facing(item) && (pixel.x + pixel.y) / kStripe % 2 == 0)
      return kBackColor;
    return item_color(raster::item_id(item));
  }

  const HemicubeImage& hemicube_;
  const DeltaFormFactors& weights_;
  SrgbEncoder encode_;
  double nearest_ = 0, heaviest_ = 0;
};

} // namespace

Status render_hemicube(const PatchSet& patches, std::uint32_t patch, std::uint32_t resolution,
                       const raster::Kernels& kernels, HemicubeImage* image) {
  if (patch >= patches.patch_count())
    return Status::error(StatusCode::kInvalidArgument, "patch ", patch,
                         " does not exist; the last is ", patches.patch_count() - 1);
  raster::PolygonTree tree;
  HC_TRY(tree.build(polygons_of(patches)));
  raster::Rasterizer rasterizer;
  HC_TRY(rasterizer.init(tree, kernels));
  raster::ItemBuffer buffer;
  HC_TRY(buffer.init());
  rasterizer.begin(hemicube_view(patches, patch));
  image->resolution = resolution;
  for (std::size_t face = 0; face < image->faces.size(); ++face)
    HC_TRY(draw_face(static_cast<raster::Face>(face), resolution, &rasterizer, &buffer,
                     &image->faces[face]));
  return {};
}

Status draw_look(const HemicubeImage& hemicube, const DeltaFormFactors& weights,
                 ColorImage* image) {
  HC_ASSERT(hemicube.resolution == weights.resolution());
  const std::uint32_t side = 2 * hemicube.resolution;
  HC_TRY(image->init(kPanels * (side + kGap) + kGap, side + 2 * kGap, kPaper));
  const Look look(hemicube, weights);
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column) {
      const FacePixel pixel = unfolded_pixel(hemicube.resolution, column, row);
      if (!pixel.is_inside)
        continue;
      for (std::uint32_t panel = 0; panel < kPanels; ++panel) {
        const std::size_t x = kGap + panel * (side + kGap) + column;
        image->set(x, kGap + row, look.color(panel, pixel));
      }
    }
  return {};
}

Color item_color(std::uint32_t id) noexcept {
  // Numbers of three digits in base 176, the levels of a channel, in the order of the golden ratio:
  // one step leads far away, and none leads back before all were taken.
  constexpr std::uint64_t kLevels = 176, kColors = kLevels * kLevels * kLevels, kStep = 3369383;
  const std::uint64_t number = (std::uint64_t{id} + 1) * kStep % kColors;
  constexpr std::uint64_t kDarkest = 256 - kLevels;
  return {static_cast<std::uint8_t>(kDarkest + number / (kLevels * kLevels)),
          static_cast<std::uint8_t>(kDarkest + number / kLevels % kLevels),
          static_cast<std::uint8_t>(kDarkest + number % kLevels)};
}

} // namespace hemicube::radiosity
