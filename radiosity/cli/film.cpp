#include "radiosity/cli/film.h"

#include "radiosity/cli/console.h"
#include "radiosity/cli/wedge_layer.h"
#include "radiosity/output/false_color_image.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/output/mesh_lines.h"

#include <filesystem>

namespace hemicube::radiosity::cli {

Status Film::find_band() {
  if (wish_.band.empty())
    return {};
  const NameTable& bands = session_.loaded.scene.bands;
  band_ = bands.find(wish_.band);
  if (band_ != NameTable::kAbsent)
    return {};
  std::string known;
  for (std::uint32_t band = 0; band < bands.size(); ++band)
    known += concat(known.empty() ? "" : ", ", bands[band]);
  return Status::error(StatusCode::kInvalidArgument, "--band ", wish_.band,
                       ": the scene has the bands ", known);
}

Status Film::begin(const Solution& solution) {
  // Eyes see radiance; numbers are told of the radiosity.
  const bool is_told = wish_.false_color && wish_.quantity == Quantity::kRadiance;
  HC_TRY(picture_values(session_.loaded.patches, solution,
                        is_told ? Quantity::kRadiosity : wish_.quantity, wish_.flat, &values_));
  const std::uint32_t unknown = unknown_count(values_);
  if (unknown != 0 && !session_.line.quiet)
    print_message(concat(counted(unknown, "patch is", "patches are"),
                         " drawn as background: solved with --no-black-irradiance, the "
                         "irradiance there is not known"));
  return {};
}

Status Film::choose(const Picture& picture) {
  if (has_chosen_)
    return {};
  has_chosen_ = true;
  if (wish_.range) {
    scale_ = {wish_.range->first, wish_.range->second, wish_.log};
    return {};
  }
  if (wish_.false_color)
    return choose_scale(picture, wish_.log, &scale_);
  const Result<double> exposure = choose_exposure(picture, session_.line.exposure);
  HC_TRY(exposure.status());
  tone_ = {exposure.value(), wish_.tone.value_or(ToneCurve::kSrgb), brightest(picture)};
  return {};
}

Status Film::add(const Camera& camera, const std::string& name, FileSet* files) {
  const LoadedScene& loaded = session_.loaded;
  const raster::Kernels& kernels = *session_.line.options.kernels;
  width_ = camera.width;
  height_ = camera.height;
  if (wish_.patch_ids) {
    PatchIdPicture ids;
    HC_TRY(draw_patch_ids(loaded.patches, camera, kernels, session_.workers(), &ids));
    return write_patch_ids(files, name, ids);
  }
  Picture picture;
  HC_TRY(draw_picture(loaded.scene, loaded.patches, values_, camera,
                      {kernels, wish_.samples_used(), wish_.mesh, band_}, session_.workers(),
                      &picture));
  HC_TRY(choose(picture));
  const Result<ImageKind> kind = image_kind(name);
  HC_TRY(kind.status());
  if (kind.value() == ImageKind::kLinear)
    return write_picture(files, name, picture, tone_.exposure);
  ColorImage image;
  if (wish_.false_color)
    HC_TRY(false_color_image(picture, scale_, &image));
  else
    HC_TRY(tone_image(picture, tone_, &image));
  draw_mesh_lines(picture, &image);
  if (wish_.wedges)
    HC_TRY(draw_wedges(&session_, camera, &image));
  if (wish_.false_color)
    HC_TRY(add_legend(scale_, picture.quantity, &image));
  width_ = image.width;
  return write_display_image(files, name, image);
}

std::string frame_name(const std::string& name, std::uint32_t frame) {
  const std::filesystem::path path(name);
  std::string number = std::to_string(frame);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
  return path.stem().string() + "." + number + path.extension().string();
}

} // namespace hemicube::radiosity::cli
