#include "radiosity/cli/option_values.h"

#include "radiosity/cli/console.h"
#include "radiosity/hemicube/delta_form_factors.h"
#include "radiosity/output/camera_view.h"
#include "raster/simd/dispatch.h"
#include "raster/types.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace hemicube::radiosity::cli {
namespace {

/// @return false unless the whole text is one number of the type
template <typename Number> bool read_number(std::string_view text, Number* value) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && stop == end;
}

/// Takes the text up to the next separator, or all of it, off the front.
std::string_view take_part(std::string_view* text, char separator) {
  const std::size_t end = std::min(text->find(separator), text->size());
  const std::string_view part = text->substr(0, end);
  text->remove_prefix(std::min(end + 1, text->size()));
  return part;
}

/// The names of kernel_names() that run here.
std::string available_isas() {
  std::string available;
  std::string_view names = raster::kernel_names();
  while (!names.empty()) {
    std::string_view name = take_part(&names, ',');
    name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
    if (raster::kernels_by_name(name) != nullptr)
      available += concat(available.empty() ? "" : ", ", name);
  }
  return available;
}

} // namespace

std::uint64_t parse_count(std::string_view text, std::uint64_t min) {
  std::uint64_t value = 0;
  if (!read_number(text, &value) || value < min)
    throw BadValue(concat("must be a whole number, ", min, " or more"));
  return value;
}

std::uint32_t parse_whole_number(std::string_view text, std::uint32_t min, std::uint32_t max) {
  std::uint32_t value = 0;
  if (!read_number(text, &value) || value < min || value > max)
    throw BadValue(concat("must be a whole number, ", min, "..", max));
  return value;
}

std::uint64_t parse_memory_size(std::string_view text) {
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr Unit kUnits[] = {{"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}, {"TiB", 0x1p40},
                             {"kB", 1e3},     {"MB", 1e6},     {"GB", 1e9},     {"TB", 1e12}};
  double value = 0, unit = 1;
  std::string_view number = text;
  for (const Unit& known : kUnits)
    if (text.ends_with(known.name)) {
      number.remove_suffix(known.name.size());
      unit = known.bytes;
      break;
    }
  if (!read_number(number, &value) || !(value * unit >= 1) || !(value * unit < 0x1p60))
    throw BadValue("must be a size such as 4GiB, 500MB or 1000000 (bytes)");
  return static_cast<std::uint64_t>(value * unit);
}

double parse_real_number(std::string_view text, double min, double max) {
  double value = 0;
  if (read_number(text, &value) && std::isfinite(value) && value > min && value < max)
    return value;
  if (max == std::numeric_limits<double>::infinity())
    throw BadValue(concat("must be a number greater than ", min));
  throw BadValue(concat("must be a number between ", min, " and ", max));
}

Vec3 parse_vector(std::string_view text) {
  double values[3] = {};
  bool good = std::count(text.begin(), text.end(), ',') == 2;
  for (double& value : values)
    good = good && read_number(take_part(&text, ','), &value) && std::isfinite(value);
  if (!good)
    throw BadValue("must be three numbers, x,y,z");
  return {values[0], values[1], values[2]};
}

std::pair<double, double> parse_range(std::string_view text) {
  constexpr double kLargest = 1e30, kSmallest = 1e-30;
  double min = 0, max = 0;
  if (std::count(text.begin(), text.end(), ',') != 1 || !read_number(take_part(&text, ','), &min) ||
      !read_number(text, &max) || !(std::fabs(min) <= kLargest && std::fabs(max) <= kLargest) ||
      !(max - min >= kSmallest))
    throw BadValue("must be two numbers MIN,MAX, the second one larger, both within 1e30");
  return {min, max};
}

void parse_size(std::string_view text, CameraOptions* camera) {
  for (std::optional<std::uint32_t>* side : {&camera->width, &camera->height}) {
    std::uint32_t pixels = 0;
    const std::string_view part = side == &camera->width ? take_part(&text, 'x') : text;
    if (!read_number(part, &pixels) || pixels < 1 || pixels > Camera::kMaxSize)
      throw BadValue(concat("must be WIDTHxHEIGHT in pixels, each 1..", Camera::kMaxSize));
    *side = pixels;
  }
}

std::uint32_t parse_resolution(std::string_view text) {
  std::uint32_t value = 0;
  if (!read_number(text, &value) || value < kMinResolution || value > kMaxResolution ||
      value % 2 != 0)
    throw BadValue(
        concat("must be an even number of pixels, ", kMinResolution, "..", kMaxResolution));
  return value;
}

RowSelection parse_rows(std::string_view text) {
  constexpr std::string_view kEvery = "every:";
  RowSelection rows;
  if (text.starts_with(kEvery)) {
    if (!read_number(text.substr(kEvery.size()), &rows.every) || rows.every == 0)
      throw BadValue(concat("must be every:N with a whole number N, 1..",
                            std::numeric_limits<std::uint64_t>::max()));
    return rows;
  }
  if (text.empty() || text.back() == ',')
    throw BadValue("must be every:N or patch numbers, I,J,K");
  while (!text.empty()) {
    const std::string_view part = take_part(&text, ',');
    std::uint32_t row = 0;
    if (!read_number(part, &row) || row >= raster::kMaxPolygonCount)
      throw BadValue(concat("'", part, "' is not a patch number; must be every:N or I,J,K"));
    rows.listed.push_back(row);
  }
  std::sort(rows.listed.begin(), rows.listed.end());
  const auto twice = std::adjacent_find(rows.listed.begin(), rows.listed.end());
  if (twice != rows.listed.end())
    throw BadValue(concat("names patch ", *twice, " twice"));
  return rows;
}

Rung parse_rung(std::string_view name) {
  for (const Rung rung :
       {Rung::kHemicube, Rung::kAnalytic, Rung::kArea, Rung::kAdaptive, Rung::kExact})
    if (name == rung_name(rung))
      return rung;
  throw BadValue("is not one of hemicube, analytic, area, adaptive, exact");
}

SolverKind parse_solver(std::string_view name) {
  for (const SolverKind solver :
       {SolverKind::kGaussSeidel, SolverKind::kJacobi, SolverKind::kProgressive})
    if (name == solver_name(solver))
      return solver;
  throw BadValue("is not one of gauss-seidel, jacobi, progressive");
}

const raster::Kernels* parse_isa(std::string_view name) {
  const raster::Kernels* kernels = raster::kernels_by_name(name);
  if (kernels == nullptr)
    throw BadValue(concat("this program on this machine has ", available_isas()));
  return kernels;
}

} // namespace hemicube::radiosity::cli
