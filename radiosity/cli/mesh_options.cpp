#include "radiosity/cli/mesh_options.h"

#include "radiosity/cli/option_values.h"

#include <limits>

namespace hemicube::radiosity::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr MeshOption kOptions[] = {
    {"--max-edge", "M", "longest edge of a patch, metres [as the scene says]",
     [](std::string_view text, MeshOptions* options) {
       options->max_edge = parse_real_number(text, 0, kInfinity);
     }},
    {"--discontinuity", nullptr,
     "cut patches along contacts and the borders of the shadows of the brightest emitters",
     [](std::string_view, MeshOptions* options) { options->discontinuity = true; }},
    {"--max-emitters", "N", "discontinuity: emitters whose shadows count, the brightest first [4]",
     [](std::string_view text, MeshOptions* options) {
       options->limits.max_emitters = parse_count(text, 0);
       options->limit_given = "--max-emitters";
     }},
    {"--snap", "M", "discontinuity: closer lines are one, metres [a 32nd of a usual patch]",
     [](std::string_view text, MeshOptions* options) {
       options->limits.snap = parse_real_number(text, 0, kInfinity);
       options->limit_given = "--snap";
     }}};

} // namespace

std::span<const MeshOption> mesh_options() {
  return kOptions;
}

Status check_mesh_options(const MeshOptions& options) {
  if (!options.discontinuity && options.limit_given != nullptr)
    return Status::error(StatusCode::kInvalidArgument, options.limit_given,
                         ": needs --discontinuity");
  return {};
}

} // namespace hemicube::radiosity::cli
