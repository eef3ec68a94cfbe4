#include "radiosity/cli/requirements.h"

#include "radiosity/cli/console.h"
#include "radiosity/cli/option_values.h"
#include "radiosity/scene/text_cursor.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity::cli {
namespace {

using Value = std::optional<double>;

Value space(const CheckedRun& run) {
  return run.certificate.space.max;
}

Value back_side(const CheckedRun& run) {
  return run.certificate.back_side.max;
}

/// Where light is lost, and how to see it.
std::string advice_on(const WorstFraction& fraction, const char* what, const char* remedy,
                      const CheckedRun& run) {
  if (fraction.count == 0)
    return {};
  const std::uint32_t worst = fraction.worst[0].patch;
  std::string text = concat(" (", counted(fraction.count, "row sees ", "rows see "), what,
                            ", most that of ", run.row_of, " ", worst, ": ", remedy);
  if (run.row_of == "patch")
    text += concat("; `hemicube look SCENE --patch ", worst, " -o look.png` shows where");
  return text + ")";
}

std::string space_advice(const CheckedRun& run) {
  return advice_on(run.certificate.space, "space",
                   "close the gap in front of it, or turn it round if it is the outside of a body",
                   run);
}

std::string back_side_advice(const CheckedRun& run) {
  return advice_on(run.certificate.back_side, "back sides",
                   "turn round the faces it sees, or make their material two-sided", run);
}

Value closure(const CheckedRun& run) {
  return run.closure_error;
}

Value reciprocity(const CheckedRun& run) {
  return run.certificate.has_reciprocity ? Value(run.certificate.reciprocity.rms) : Value();
}

Value residual(const CheckedRun& run) {
  return run.certificate.residual;
}

Value imbalance(const CheckedRun& run) {
  Value worst;
  for (const EnergyBalance& band : run.certificate.energy)
    worst = std::max(worst.value_or(0), std::fabs(band.imbalance));
  return worst;
}

Value radiosity_error(const CheckedRun& run) {
  return run.certificate.has_radiosity_error ? Value(run.certificate.radiosity_error) : Value();
}

Value form_factor_error(const CheckedRun& run) {
  return run.certificate.has_form_factor_error ? Value(run.certificate.form_factor_error) : Value();
}

Value not_converged(const CheckedRun& run) {
  return run.certificate.converged ? 0.0 : run.certificate.estimated_error;
}

/// The commands a condition is for.
enum class Of { kAll, kSolve, kFormFactors };

/// What there is to require. A condition may stand here more than once: all must hold.
struct Condition {
  const char* name;
  const char* quantity; ///< what messages call it: its key in `result` of report.json
  Of of;
  std::optional<double> fixed; ///< the bound; without it, `=X` gives it
  Value (*value)(const CheckedRun& run);
  std::string (*advice)(const CheckedRun& run) = nullptr;

  bool is_for(bool solves) const { return of == Of::kAll || (of == Of::kSolve) == solves; }
};
const Condition kConditions[] = {
    {"closed", "space.max", Of::kAll, WorstFraction::kRounding, space, space_advice},
    {"closed", "back_side.max", Of::kAll, WorstFraction::kRounding, back_side, back_side_advice},
    {"closure", "the farthest row sum + space + back side from 1", Of::kAll, {}, closure},
    {"reciprocity", "reciprocity.rms", Of::kAll, {}, reciprocity},
    {"error", "error.radiosity", Of::kSolve, {}, radiosity_error},
    {"error", "error.form_factor", Of::kFormFactors, {}, form_factor_error},
    {"residual", "residual", Of::kSolve, {}, residual},
    {"imbalance", "the largest energy.imbalance", Of::kSolve, {}, imbalance},
    {"converged", "estimated_error without convergence", Of::kSolve, 0.0, not_converged},
};

/// X of "name=X".
double parse_bound(std::string_view part) {
  double bound = 0;
  const std::string_view digits = part.substr(part.find('=') + 1);
  if (parse_number(digits, &bound) != NumberForm::kFinite || bound < 0)
    throw BadValue(concat("'", part, "' must have a number that is 0 or more after '='"));
  return bound;
}

/// Adds what one part of the list asks for.
void add_part(std::string_view part, bool solves, std::vector<Requirement>* requirements) {
  const std::size_t equals = part.find('=');
  const bool has_bound = equals != std::string_view::npos;
  const std::string_view name = part.substr(0, equals);
  bool found = false;
  for (const Condition& condition : kConditions) {
    if (condition.name != name || !condition.is_for(solves))
      continue;
    if (has_bound == condition.fixed.has_value())
      throw BadValue(concat("'", part, "' must be ", name, condition.fixed ? "" : "=X"));
    requirements->push_back({condition.name, condition.quantity,
                             condition.fixed ? *condition.fixed : parse_bound(part),
                             condition.value, condition.advice});
    found = true;
  }
  if (!found)
    throw BadValue(concat("'", part, "' is not one of ", known_conditions(solves)));
}

} // namespace

double closure_error(const Solution& solution) {
  double worst = 0;
  for (std::size_t i = 0; i < solution.row_sum.size(); ++i) {
    const double error =
        std::fabs(solution.row_sum[i] + solution.space[i] + solution.back_side[i] - 1);
    worst = std::max(worst, error); // not a number: a row that was not built
  }
  return worst;
}

Status closure_error(const FormFactorMatrix& matrix, double* error) {
  *error = 0;
  return matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i) {
      const RowView row = matrix.row(i);
      *error = std::max(*error, std::fabs(row_sum(row) + row.space + row.back_side - 1));
    }
    return Status();
  });
}

std::string known_conditions(bool solves) {
  std::string known;
  std::string_view last;
  for (const Condition& condition : kConditions)
    if (condition.is_for(solves) && last != condition.name) {
      last = condition.name;
      known += concat(known.empty() ? "" : ", ", last, condition.fixed ? "" : "=X");
    }
  return known;
}

std::vector<Requirement> parse_requirements(std::string_view text, bool solves) {
  std::vector<Requirement> requirements;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    add_part(text.substr(begin, end - begin), solves, &requirements);
    begin = end + 1;
  }
  return requirements;
}

Status check_applicable(const CommandLine& line) {
  for (const Requirement& requirement : line.requirements) {
    const bool is_of_all =
        requirement.value == reciprocity || requirement.value == form_factor_error;
    if (is_of_all && !(line.rows.is_all() && line.points.empty()))
      return Status::error(StatusCode::kInvalidArgument, "--require ", requirement.condition,
                           ": needs the rows of all patches, so neither --rows nor --points");
    if (requirement.condition == "error" && !line.options.choose_rung &&
        line.options.rung == Rung::kExact)
      return Status::error(StatusCode::kInvalidArgument,
                           "--require error: nothing is finer than rung exact to estimate it by");
    if (requirement.value == imbalance && !line.options.black_irradiance)
      return Status::error(StatusCode::kInvalidArgument,
                           "--require imbalance: needs the irradiance of all patches, "
                           "so no --no-black-irradiance");
  }
  return {};
}

Status check_requirements(std::span<const Requirement> requirements, const CheckedRun& run) {
  std::string broken;
  for (const Requirement& requirement : requirements) {
    const Value value = requirement.value(run);
    if (value && *value <= requirement.bound)
      continue;
    broken += concat(broken.empty() ? "--require " : "; ", requirement.condition, ": ",
                     requirement.quantity, " is ");
    broken += value ? concat(*value, ", must be at most ", requirement.bound) : "not known";
    if (requirement.advice != nullptr)
      broken += requirement.advice(run);
  }
  if (broken.empty())
    return {};
  return Status::error(StatusCode::kCheckFailed, broken);
}

} // namespace hemicube::radiosity::cli
