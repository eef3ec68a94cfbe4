#include "radiosity/cli/picture_options.h"

#include "radiosity/cli/option_values.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/output/image_writer.h"

namespace hemicube::radiosity::cli {
namespace {

void set_quantity(std::string_view name, PictureOptions* options) {
  constexpr struct {
    std::string_view name;
    Quantity quantity;
  } kQuantities[] = {{"radiosity", Quantity::kRadiance},
                     {"irradiance", Quantity::kIrradiance},
                     {"exitance", Quantity::kExitance},
                     {"error", Quantity::kError}};
  for (const auto& known : kQuantities)
    if (name == known.name) {
      options->quantity = known.quantity;
      return;
    }
  throw BadValue("is not one of radiosity, irradiance, exitance, error");
}

void set_flat(std::string_view, PictureOptions* options) {
  options->flat = true;
}

void set_samples(std::string_view text, PictureOptions* options) {
  options->samples = parse_whole_number(text, 1, kMaxSamples);
}

constexpr PictureOption kOptions[] = {
    {"--quantity", "NAME", "radiosity, irradiance, exitance, or error: variation inside a patch",
     set_quantity},
    {"--flat", nullptr, "one value a patch, as computed, not reconstructed between corners",
     set_flat},
    {"--samples", "N", "samples along each side of a pixel, 1..8 [3]", set_samples},
};

} // namespace

std::span<const PictureOption> picture_options() {
  return kOptions;
}

Status check_picture_options(const CommandLine& line) {
  return image_kind(line.output).status();
}

} // namespace hemicube::radiosity::cli
