#include "radiosity/output/picture.h"

#include "radiosity/elementary.h"
#include "radiosity/mesh/straight_corners.h"
#include "radiosity/output/display_bands.h"
#include "radiosity/output/interpolation.h"
#include "radiosity/output/mesh_lines.h"
#include "radiosity/output/picture_blocks.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

bool is_known(const Vec3& v) {
  return !std::isnan(v.x + v.y + v.z);
}

/// What a ray through a sample sees of a patch.
class Shader {
public:
  Shader(const Scene& scene, const PatchSet& patches, const PictureValues& values,
         std::span<const std::uint8_t> is_straight, const DisplayBands& bands,
         const CameraView& camera)
      : scene_(scene), patches_(patches), values_(values), is_straight_(is_straight), bands_(bands),
        camera_(camera), divisor_(values.quantity == Quantity::kRadiance ? kPi : 1) {}

  /// The value of a patch in a sample of the grid; NaN if it is not known.
  Vec3 value(std::uint32_t patch, std::int32_t x, std::int32_t y) const {
    const std::uint32_t begin = patches_.corner_offsets[patch];
    const std::uint32_t count = patches_.corner_offsets[patch + 1] - begin;
    const std::size_t bands = values_.band_count;
    const Vec3 own = bands_(values_.patch.data() + patch * bands) / divisor_;
    if (values_.corner.empty() || count > kMaxInterpolatedCorners || !is_known(own))
      return own;
    double weights[kMaxInterpolatedCorners];
    interpolation_weights(patches_, is_straight_, patch, point(patch, x, y), weights);
    Vec3 sum{0, 0, 0};
    for (std::uint32_t k = 0; k < count; ++k)
      sum += weights[k] * bands_(values_.corner.data() + (begin + k) * bands);
    return is_known(sum) ? sum / divisor_ : own; // a neighbour may not be known
  }

  PixelKind kind(std::uint32_t patch) const {
    const std::size_t bands = values_.band_count;
    const double* exitance = scene_.exitance.data() + patches_.material[patch] * bands;
    for (std::size_t band = 0; band < bands; ++band)
      if (exitance[band] > 0)
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

  const Scene& scene_;
  const PatchSet& patches_;
  const PictureValues& values_;
  std::span<const std::uint8_t> is_straight_;
  const DisplayBands& bands_;
  const CameraView& camera_;
  double divisor_;
};

/// Fills the pixel at (x, y) of the picture from its samples, and returns its number.
std::size_t shade_pixel(const Shader& shader, const raster::ItemBuffer& buffer, std::int32_t x,
                        std::int32_t y, Picture* picture) {
  constexpr double kLargest = 3.4e38; // of float: an infinity could not be averaged
  const auto samples = static_cast<std::int32_t>(picture->samples);
  Vec3 sum{0, 0, 0};
  PixelKind kind = PixelKind::kBackground;
  std::uint8_t hits = 0;
  for (std::int32_t sy = y * samples; sy < (y + 1) * samples; ++sy) {
    for (std::int32_t sx = x * samples; sx < (x + 1) * samples; ++sx) {
      const raster::Item item = buffer.items(sy)[sx - buffer.window().x];
      if (item == raster::kNoItem)
        continue;
      const std::uint32_t patch = raster::item_id(item);
      const Vec3 value = shader.value(patch, sx, sy);
      if (!is_known(value))
        continue;
      sum += value;
      ++hits;
      if (sx == x * samples + samples / 2 && sy == y * samples + samples / 2)
        kind = shader.kind(patch);
    }
  }
  const std::size_t at = static_cast<std::size_t>(y) * picture->width + static_cast<std::size_t>(x);
  for (int channel = 0; channel < 3; ++channel)
    picture->rgb[at * 3 + static_cast<std::size_t>(channel)] =
        static_cast<float>(min_number(sum[channel] / (samples * samples), kLargest));
  picture->kind[at] = kind;
  picture->hits[at] = hits;
  return at;
}

Status init_picture(const Camera& camera, std::uint32_t samples, Quantity quantity,
                    Picture* picture) {
  *picture = Picture{};
  picture->width = camera.width;
  picture->height = camera.height;
  picture->samples = samples;
  picture->quantity = quantity;
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  HC_TRY(picture->rgb.resize(pixels * 3));
  HC_TRY(picture->kind.resize(pixels));
  return picture->hits.resize(pixels);
}

} // namespace

Status draw_picture(const Scene& scene, const PatchSet& patches, const PictureValues& values,
                    const Camera& camera, const PictureSetting& setting, Executor& executor,
                    Picture* picture) {
  CameraView view;
  HC_TRY(camera_view(camera, setting.samples, &view));
  HC_TRY(init_picture(camera, setting.samples, values.quantity, picture));
  const DisplayBands bands = setting.band == PictureSetting::kAllBands
                                 ? DisplayBands(scene.bands)
                                 : DisplayBands(scene.bands, setting.band);
  Buffer<std::uint8_t> is_straight;
  HC_TRY(find_straight_corners(patches, &is_straight));
  const Shader shader(scene, patches, values, is_straight.span(), bands, view);
  const MeshLines mesh(setting.samples, view.grid.width, view.grid.height);
  const std::int32_t margin = setting.mesh ? MeshLines::margin(setting.samples) : 0;
  if (setting.mesh)
    HC_TRY(picture->lines.resize(picture->hits.size()));
  const auto shade = [&](const raster::ItemBuffer& buffer, const PixelBlock& block) {
    for (std::int32_t y = block.top; y < block.bottom; ++y)
      for (std::int32_t x = block.left; x < block.right; ++x) {
        const std::size_t at = shade_pixel(shader, buffer, x, y, picture);
        if (setting.mesh)
          picture->lines[at] = mesh.count(buffer, x, y);
      }
  };
  return for_each_picture_block(patches, view, static_cast<std::int32_t>(setting.samples), margin,
                                setting.kernels, executor, shade);
}

double luminance_at(const Picture& picture, std::size_t pixel) noexcept {
  const float* rgb = picture.rgb.data() + 3 * pixel;
  return luminance(static_cast<double>(rgb[0]), static_cast<double>(rgb[1]),
                   static_cast<double>(rgb[2]));
}

double brightest(const Picture& picture) noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < picture.kind.size(); ++i)
    largest = max_number(largest, luminance_at(picture, i));
  return largest > 0 ? largest : 1;
}

Status lit_pixels(const Picture& picture, Buffer<double>* luminances) {
  luminances->clear();
  for (const PixelKind kind : {PixelKind::kSurface, PixelKind::kEmitter}) {
    for (std::size_t i = 0; i < picture.kind.size(); ++i)
      if (const double light = luminance_at(picture, i); picture.kind[i] == kind && light > 0)
        HC_TRY(luminances->push_back(light));
    if (!luminances->empty())
      break;
  }
  return {};
}

double quantile(Buffer<double>* values, double share) noexcept {
  // The value of this rank is the same whatever the order of equal ones.
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + rank, values->end());
  return (*values)[rank];
}

Result<double> choose_exposure(const Picture& picture, double given) {
  if (given != 0)
    return given;
  constexpr double kQuantile = 0.95, kShownAs = 0.8;
  Buffer<double> lit;
  HC_TRY(lit_pixels(picture, &lit));
  return lit.empty() ? 1.0 : kShownAs / quantile(&lit, kQuantile);
}

} // namespace hemicube::radiosity
