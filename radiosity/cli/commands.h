#pragma once

#include "radiosity/cli/options.h"

namespace hemicube::radiosity::cli {

// The commands. Each prints its own data and returns what went wrong; files are written whole or
// not at all.
Status run_solve(const CommandLine& line);
Status run_formfactors(const CommandLine& line);
Status run_render(const CommandLine& line);
Status run_info(const CommandLine& line);
Status run_look(const CommandLine& line);
Status run_probe(const CommandLine& line);
Status run_verify(const CommandLine& line);

} // namespace hemicube::radiosity::cli
