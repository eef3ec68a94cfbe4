#pragma once

#include "radiosity/cli/options.h"

#include <stdexcept>
#include <string_view>
#include <utility>

namespace hemicube::radiosity::cli {

/// A value that an option cannot have. The message says what it must be.
struct BadValue : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Text to values, by std::from_chars: whole text, no locale, no octal. All throw BadValue.

std::uint64_t parse_count(std::string_view text, std::uint64_t min);
std::uint32_t parse_whole_number(std::string_view text, std::uint32_t min, std::uint32_t max);

/// A finite number with min < number < max.
double parse_real_number(std::string_view text, double min, double max);

/// "4GiB", "500MB", "1e6" bytes, > 0.
std::uint64_t parse_memory_size(std::string_view text);

/// Three finite numbers, "x,y,z".
Vec3 parse_vector(std::string_view text);

/// "min,max": finite numbers, min < max, of a size that scales can be made of.
std::pair<double, double> parse_range(std::string_view text);

/// "WxH", pixels.
void parse_size(std::string_view text, CameraOptions* camera);

/// Even, 16..2048.
std::uint32_t parse_resolution(std::string_view text);

/// "every:N" or "I,J,K".
RowSelection parse_rows(std::string_view text);

/// "hemicube", "analytic", ...
Rung parse_rung(std::string_view name);

/// "gauss-seidel", "jacobi", "progressive".
SolverKind parse_solver(std::string_view name);

/// The kernels of an instruction set by name, if this machine has it.
const raster::Kernels* parse_isa(std::string_view name);

} // namespace hemicube::radiosity::cli
