#pragma once

#include <string>

namespace hemicube::bench {

/// The model of the processor, fit for the name of a folder.
std::string cpu_name();

} // namespace hemicube::bench
