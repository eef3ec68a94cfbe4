#pragma once

#include "raster/status.h"

namespace hemicube::radiosity::cli {

/// From now on the first SIGINT or SIGTERM asks the program to stop, the second one kills it; a
/// file larger than the system allows is a failed write, as on a full disk, and kills nothing.
void catch_interrupts();

bool interrupted() noexcept;

/// kCancelled once the program was asked to stop: for between the steps of a command.
Status check_interrupt();

} // namespace hemicube::radiosity::cli
