#pragma once

#include "radiosity/cli/options.h"

#include <span>
#include <string_view>

namespace hemicube::radiosity::cli {

/// An option of `render` that says what its picture shows, or how.
struct PictureOption {
  const char* names;       ///< "--a", or "--a,--b" for two spellings
  const char* placeholder; ///< of its value; null = it has none
  const char* description;
  /// Takes the value. Throws BadValue.
  void (*set)(std::string_view text, PictureOptions* options);
};

std::span<const PictureOption> picture_options();

/// Refuses options that make no sense together, or for the image that is written.
/// @return kInvalidArgument
Status check_picture_options(const CommandLine& line);

/// Refuses a picture too low for a legend.
/// @return kInvalidArgument
Status check_legend(const CommandLine& line, const Camera& camera);

} // namespace hemicube::radiosity::cli
