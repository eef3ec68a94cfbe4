#include "radiosity/cli/picture_options.h"

#include "radiosity/cli/console.h"
#include "radiosity/cli/option_values.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/output/false_color_image.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/scene/text_cursor.h"

#include <filesystem>

namespace hemicube::radiosity::cli {
namespace {

constexpr std::uint32_t kMaxFrames = 10000; ///< that four digits can number

void set_quantity(std::string_view name, PictureOptions* options) {
  constexpr struct {
    std::string_view name;
    Quantity quantity;
  } kQuantities[] = {{"radiosity", Quantity::kRadiance},
                     {"irradiance", Quantity::kIrradiance},
                     {"exitance", Quantity::kExitance},
                     {"error", Quantity::kError}};
  options->patch_ids = name == "patch-id";
  if (options->patch_ids)
    return;
  for (const auto& known : kQuantities)
    if (name == known.name) {
      options->quantity = known.quantity;
      return;
    }
  throw BadValue("is not one of radiosity, irradiance, exitance, error, patch-id");
}

void set_band(std::string_view text, PictureOptions* options) {
  if (text.empty())
    throw BadValue("is empty");
  options->band = text;
}

void set_tone(std::string_view name, PictureOptions* options) {
  if (name != "srgb" && name != "reinhard")
    throw BadValue("is not one of srgb, reinhard");
  options->tone = name == "srgb" ? ToneCurve::kSrgb : ToneCurve::kReinhard;
}

constexpr PictureOption kOptions[] = {
    {"--quantity", "NAME",
     "radiosity, irradiance, exitance, error (variation inside a patch), or patch-id [radiosity]",
     set_quantity},
    {"--flat", nullptr, "one value a patch, as computed, not reconstructed between corners",
     [](std::string_view, PictureOptions* options) { options->flat = true; }},
    {"--band", "NAME", "one band of the scene instead of all", set_band},
    {"--false-colour,--false-color", nullptr, "numbers as colours, with a legend",
     [](std::string_view, PictureOptions* options) { options->false_color = true; }},
    {"--range", "MIN,MAX", "values at the ends of the false colours [chosen from the picture]",
     [](std::string_view text, PictureOptions* options) { options->range = parse_range(text); }},
    {"--log", nullptr, "false colours on a logarithmic scale",
     [](std::string_view, PictureOptions* options) { options->log = true; }},
    {"--tone", "NAME", "srgb: clipped at display white; reinhard: highlights compressed [srgb]",
     set_tone},
    {"--mesh", nullptr, "draw the edges of patches over the picture",
     [](std::string_view, PictureOptions* options) { options->mesh = true; }},
    {"--wedges", nullptr, "discontinuity: draw the light that passes edges and corners",
     [](std::string_view, PictureOptions* options) { options->wedges = true; }},
    {"--samples", "N", "samples along each side of a pixel, 1..8 [3]",
     [](std::string_view text, PictureOptions* options) {
       options->samples = parse_whole_number(text, 1, kMaxSamples);
     }},
    {"--orbit", "N", "N frames of a film once around the camera's target: IMAGE.0000, ...",
     [](std::string_view text, PictureOptions* options) {
       options->orbit = parse_whole_number(text, 1, kMaxFrames);
     }},
};

/// "film.0007.png" already numbers a frame.
bool has_frame_number(const std::string& output) {
  const std::string number = std::filesystem::path(output).stem().extension().string();
  return number.size() == 5 && number.find_first_not_of("0123456789", 1) == std::string::npos;
}

} // namespace

std::span<const PictureOption> picture_options() {
  return kOptions;
}

Status check_picture_options(const CommandLine& line) {
  const PictureOptions& picture = line.picture;
  const Result<ImageKind> kind = image_kind(line.output);
  HC_TRY(kind.status());
  const bool is_linear = kind.value() == ImageKind::kLinear;
  const bool holds_no_ids = is_linear && !has_extension(line.output, ".exr");
  const bool has_tone = picture.tone.has_value();
  constexpr const char* kLinear =
      "this format holds linear values; use .png, or leave the option out";
  constexpr const char* kIds = "patch ids are shown as they are; leave the option out";
  constexpr const char* kNumbers = "does not go with --false-colour, whose colours are those of "
                                   "its legend; choose with --range";
  constexpr const char* kNeeds = "needs --false-colour";
  const struct {
    const char* option;
    bool is_wrong;
    const char* reason;
  } kRules[] = {
      {"--quantity patch-id", picture.patch_ids && holds_no_ids,
       "this format holds no numbers of patches; use .exr, or .png for their colours"},
      {"--false-colour", picture.false_color && picture.patch_ids, kIds},
      {"--mesh", picture.mesh && picture.patch_ids, kIds},
      {"--wedges", picture.wedges && picture.patch_ids, kIds},
      {"--samples", picture.samples && picture.patch_ids, kIds},
      {"--band", !picture.band.empty() && picture.patch_ids, kIds},
      {"--tone", has_tone && picture.patch_ids, kIds},
      {"--exposure", line.exposure != 0 && picture.patch_ids, kIds},
      {"--false-colour", picture.false_color && is_linear, kLinear},
      {"--mesh", picture.mesh && is_linear, kLinear},
      {"--wedges", picture.wedges && is_linear, kLinear},
      {"--tone", has_tone && is_linear, kLinear},
      {"--tone", has_tone && picture.false_color, kNumbers},
      {"--exposure", line.exposure != 0 && picture.false_color, kNumbers},
      {"--range", picture.range && !picture.false_color, kNeeds},
      {"--log", picture.log && !picture.false_color, kNeeds},
      {"--range", picture.log && picture.range && !(picture.range->first > 0),
       "with --log, MIN must be above 0"},
      {"--orbit", picture.orbit != 0 && has_frame_number(line.output),
       "numbers the frames itself; name the film without a number, as in -o film.png"},
  };
  for (const auto& rule : kRules)
    if (rule.is_wrong)
      return Status::error(StatusCode::kInvalidArgument, rule.option, ": ", rule.reason);
  return {};
}

Status check_legend(const CommandLine& line, const Camera& camera) {
  if (!line.picture.false_color || camera.height >= kMinLegendHeight)
    return {};
  return Status::error(StatusCode::kInvalidArgument, "--false-colour: a picture ", camera.height,
                       " pixels high has no room for the legend; choose a --size of ",
                       kMinLegendHeight, " or more");
}

} // namespace hemicube::radiosity::cli
