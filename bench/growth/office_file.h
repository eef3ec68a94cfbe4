#pragma once

#include "tests/support/office.h"

#include <string>

namespace hemicube::bench {

/// Writes an office as a scene file for the program, PATH ending in .obj, and its materials beside
/// it. Throws std::runtime_error.
void write_office(const test::OfficePlan& plan, const std::string& path);

} // namespace hemicube::bench
