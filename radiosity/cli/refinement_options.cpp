#include "radiosity/cli/refinement_options.h"

#include "radiosity/cli/option_values.h"

#include <limits>

namespace hemicube::radiosity::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr RefinementOption kOptions[] = {
    {"--adaptive", nullptr, "cut patches into elements where the light varies",
     [](std::string_view, RefinementOptions* options) { options->adaptive = true; }},
    {"--variation", "X",
     "adaptive: most that radiosity may vary across an element, in mean radiosities [0.2]",
     [](std::string_view text, RefinementOptions* options) {
       options->limits.variation = parse_real_number(text, 0, kInfinity);
       options->limit_given = "--variation";
     }},
    {"--min-edge", "M", "adaptive: no shorter edge is made, metres [an 8th of a mean patch]",
     [](std::string_view text, RefinementOptions* options) {
       options->limits.min_edge = parse_real_number(text, 0, kInfinity);
       options->limit_given = "--min-edge";
     }},
    {"--max-elements", "N", "adaptive: no more elements are made [20000]",
     [](std::string_view text, RefinementOptions* options) {
       options->limits.max_elements = parse_count(text, 1);
       options->limit_given = "--max-elements";
     }}};

} // namespace

std::span<const RefinementOption> refinement_options() {
  return kOptions;
}

Status check_refinement(const CommandLine& line) {
  const RefinementOptions& wish = line.refinement;
  const auto refuse = [](const auto&... what) {
    return Status::error(StatusCode::kInvalidArgument, what...);
  };
  if (!wish.adaptive)
    return wish.limit_given == nullptr ? Status() : refuse(wish.limit_given, ": needs --adaptive");
  if (line.options.solver == SolverKind::kProgressive)
    return refuse("--adaptive: the light of all elements is solved for again and again, which "
                  "--solver progressive is not made for");
  if (!line.form_factors.empty())
    return refuse("--adaptive: --form-factors keeps those of a mesh that is known beforehand");
  if (line.memory_bytes != 0)
    return refuse("--adaptive: all rows are in memory, which --memory cannot bound; "
                  "--max-elements can");
  if (line.mesh.max_edge > 0 && wish.limits.min_edge > line.mesh.max_edge)
    return refuse("--min-edge ", wish.limits.min_edge, ": is more than --max-edge ",
                  line.mesh.max_edge);
  return {};
}

} // namespace hemicube::radiosity::cli
