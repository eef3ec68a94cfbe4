#pragma once

#include "radiosity/cli/options.h"
#include "radiosity/cli/table_option.h"

#include <span>

namespace hemicube::radiosity::cli {

/// Options of `render` that say what its picture shows, or how.
using PictureOption = TableOption<PictureOptions>;
std::span<const PictureOption> picture_options();

/// Refuses options that make no sense together, or for the image that is written.
/// @return kInvalidArgument
Status check_picture_options(const CommandLine& line);

/// Refuses a picture too low for a legend.
/// @return kInvalidArgument
Status check_legend(const CommandLine& line, const Camera& camera);

} // namespace hemicube::radiosity::cli
