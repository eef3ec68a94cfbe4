#pragma once

#include "radiosity/cli/options.h"
#include "radiosity/cli/table_option.h"

#include <span>

namespace hemicube::radiosity::cli {

/// --adaptive and how far it goes.
using RefinementOption = TableOption<RefinementOptions>;
std::span<const RefinementOption> refinement_options();

/// Refuses what cannot go with --adaptive, and limits that contradict each other.
/// @return kInvalidArgument
Status check_refinement(const CommandLine& line);

} // namespace hemicube::radiosity::cli
