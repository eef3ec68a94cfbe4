#include "radiosity/output/picture.h"

#include "radiosity/elementary.h"
#include "radiosity/hemicube/five_views.h"
#include "radiosity/mesh/straight_corners.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/output/display_bands.h"
#include "radiosity/output/interpolation.h"
#include "raster/rasterizer.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

constexpr std::int32_t kSamples = 3;                               ///< along each side of a pixel
constexpr std::int32_t kBlock = raster::kMaxWindowSize / kSamples; ///< pixels along a window

/// What a ray through a sample sees of a patch.
class Shader {
public:
  Shader(const Scene& scene, const PatchSet& patches, const Solution& solution,
         std::span<const float> corner_radiosity, std::span<const std::uint8_t> is_straight,
         const CameraView& camera)
      : patches_(patches), solution_(solution), corner_radiosity_(corner_radiosity),
        is_straight_(is_straight), bands_(scene.bands), camera_(camera) {}

  /// Radiance of a patch in a sample of the grid.
  Vec3 radiance(std::uint32_t patch, std::int32_t x, std::int32_t y) const {
    const std::uint32_t begin = patches_.corner_offsets[patch];
    const std::uint32_t count = patches_.corner_offsets[patch + 1] - begin;
    const std::size_t bands = solution_.band_count;
    if (count > kMaxInterpolatedCorners)
      return bands_(solution_.radiosity.data() + patch * bands) / kPi;
    double weights[kMaxInterpolatedCorners];
    interpolation_weights(patches_, is_straight_, patch, point(patch, x, y), weights);
    Vec3 sum{0, 0, 0};
    for (std::uint32_t k = 0; k < count; ++k)
      sum += weights[k] * bands_(corner_radiosity_.data() + (begin + k) * bands);
    return sum / kPi;
  }

  PixelKind kind(std::uint32_t patch) const {
    for (std::uint32_t band = 0; band < solution_.band_count; ++band)
      if (solution_.exitance[std::size_t{patch} * solution_.band_count + band] > 0)
        return PixelKind::kEmitter;
    return PixelKind::kSurface;
  }

private:
  /// Where the ray through a sample meets the plane of a patch.
  Vec3 point(std::uint32_t patch, std::int32_t x, std::int32_t y) const {
    const raster::View& view = camera_.view;
    const raster::PixelGrid& grid = camera_.grid;
    const Vec3 direction =
        (grid.x0 + x * grid.dx) * view.axis_x + (grid.y0 + y * grid.dy) * view.axis_y + view.axis_z;
    const Vec3 to_patch = patches_.centre[patch] - view.eye;
    const Vec3& normal = patches_.normal[patch];
    const double away = glm::dot(normal, direction);
    if (away == 0) // seen exactly edge-on
      return patches_.centre[patch];
    return view.eye + glm::dot(normal, to_patch) / away * direction;
  }

  const PatchSet& patches_;
  const Solution& solution_;
  std::span<const float> corner_radiosity_;
  std::span<const std::uint8_t> is_straight_;
  DisplayBands bands_;
  const CameraView& camera_;
};

/// Fills the pixel at (x, y) of the picture from its samples.
void shade_pixel(const Shader& shader, const raster::ItemBuffer& buffer, std::int32_t x,
                 std::int32_t y, Picture* picture) {
  Vec3 sum{0, 0, 0};
  PixelKind kind = PixelKind::kBackground;
  for (std::int32_t sy = y * kSamples; sy < (y + 1) * kSamples; ++sy) {
    for (std::int32_t sx = x * kSamples; sx < (x + 1) * kSamples; ++sx) {
      const raster::Item item = buffer.items(sy)[sx - buffer.window().x];
      if (item == raster::kNoItem)
        continue;
      const std::uint32_t patch = raster::item_id(item);
      sum += shader.radiance(patch, sx, sy);
      if (sx == x * kSamples + kSamples / 2 && sy == y * kSamples + kSamples / 2)
        kind = shader.kind(patch);
    }
  }
  const std::size_t at = static_cast<std::size_t>(y) * picture->width + static_cast<std::size_t>(x);
  for (int channel = 0; channel < 3; ++channel)
    picture->rgb[at * 3 + static_cast<std::size_t>(channel)] =
        static_cast<float>(sum[channel] / (kSamples * kSamples));
  picture->kind[at] = kind;
}

Status init_picture(const Camera& camera, Picture* picture) {
  *picture = Picture{};
  picture->width = camera.width;
  picture->height = camera.height;
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  HC_TRY(picture->rgb.resize(pixels * 3));
  return picture->kind.resize(pixels);
}

} // namespace

Status draw_picture(const Scene& scene, const PatchSet& patches, const Solution& solution,
                    std::span<const float> corner_radiosity, const Camera& camera,
                    const raster::Kernels& kernels, Picture* picture) {
  CameraView view;
  HC_TRY(camera_view(camera, kSamples, &view));
  HC_TRY(init_picture(camera, picture));

  raster::PolygonTree tree;
  HC_TRY(tree.build(polygons_of(patches)));
  raster::Rasterizer rasterizer;
  HC_TRY(rasterizer.init(tree, kernels));
  raster::ItemBuffer buffer;
  HC_TRY(buffer.init());
  rasterizer.begin(view.view);

  Buffer<std::uint8_t> is_straight;
  HC_TRY(find_straight_corners(patches, &is_straight));
  const Shader shader(scene, patches, solution, corner_radiosity, is_straight.span(), view);
  const auto width = static_cast<std::int32_t>(camera.width);
  const auto height = static_cast<std::int32_t>(camera.height);
  for (std::int32_t top = 0; top < height; top += kBlock)
    for (std::int32_t left = 0; left < width; left += kBlock) {
      const std::int32_t right = std::min(left + kBlock, width);
      const std::int32_t bottom = std::min(top + kBlock, height);
      buffer.begin(
          {left * kSamples, top * kSamples, (right - left) * kSamples, (bottom - top) * kSamples});
      rasterizer.draw(raster::Face::kTop, view.grid, &buffer);
      for (std::int32_t y = top; y < bottom; ++y)
        for (std::int32_t x = left; x < right; ++x)
          shade_pixel(shader, buffer, x, y, picture);
    }
  return {};
}

Result<double> choose_exposure(const Picture& picture, double given) {
  if (given != 0)
    return given;
  constexpr double kQuantile = 0.95, kShownAs = 0.8;
  for (const PixelKind kind : {PixelKind::kSurface, PixelKind::kEmitter}) {
    Buffer<double> lit;
    for (std::size_t i = 0; i < picture.kind.size(); ++i) {
      const float* rgb = picture.rgb.data() + 3 * i;
      const double light = luminance(static_cast<double>(rgb[0]), static_cast<double>(rgb[1]),
                                     static_cast<double>(rgb[2]));
      if (picture.kind[i] == kind && light > 0)
        HC_TRY(lit.push_back(light));
    }
    if (lit.empty())
      continue;
    // The value of this rank is the same whatever the order of equal ones.
    const auto rank = static_cast<std::size_t>(kQuantile * static_cast<double>(lit.size() - 1));
    std::nth_element(lit.begin(), lit.begin() + rank, lit.end());
    return kShownAs / lit[rank];
  }
  return 1.0;
}

} // namespace hemicube::radiosity
