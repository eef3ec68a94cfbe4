#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/progress.h"
#include "radiosity/cli/stopwatch.h"
#include "radiosity/cli/verify_cases.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/parallel/thread_pool.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

/// Bounds of the rungs that look at pixels are for this resolution; below it they grow as pixels
/// do.
constexpr double kBoundResolution = 256;
/// Of the solver: its error must not show beside that of the form factors.
constexpr double kTolerance = 1e-12;

/// One line of the table.
struct Outcome {
  const VerifyCase& made;
  Rung rung;
  double got = 0;
  double error = 0; ///< relative, absolute if the exact value is 0
  double bound = kNoPromise;
  double seconds = 0; ///< wall-clock, mesh included

  bool is_promised() const { return bound != kNoPromise; }
  bool failed() const { return !(error <= bound); } // not a number fails too
};

double entry(const RowView& row, std::uint32_t column) {
  for (std::size_t k = 0; k < row.columns.size(); ++k)
    if (row.columns[k] == column)
      return row.scale * static_cast<double>(row.values[k]);
  return 0;
}

/// sum A_i F_ij over i of material 0 and j of material 1, over the sum of A_j.
double shared_power(const PatchSet& patches, const FormFactorMatrix& matrix) {
  double power = 0, area = 0;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    area += patches.material[i] == 1 ? patches.area[i] : 0;
    if (patches.material[i] != 0)
      continue;
    const RowView row = matrix.row(i);
    for (std::size_t k = 0; k < row.columns.size(); ++k)
      if (patches.material[row.columns[k]] == 1)
        power += patches.area[i] * row.scale * static_cast<double>(row.values[k]);
  }
  return power / area;
}

double farthest_from(double exact, std::span<const double> values) {
  return *std::max_element(values.begin(), values.end(), [exact](double a, double b) {
    return std::fabs(a - exact) < std::fabs(b - exact);
  });
}

/// Computes the number of a case.
Status compute(const VerifyCase& made, const PatchSet& patches, const Options& options,
               Executor& executor, double* got) {
  ProgressReport progress(true); // for interrupts
  FormFactorMatrix matrix;
  Certificate certificate;
  if (made.kind == VerifyKind::kRadiosity || made.kind == VerifyKind::kImbalance) {
    Solution solution;
    HC_TRY(solve_scene(made.scene.scene(), patches, options, executor, &progress, &solution,
                       &certificate));
    *got = made.kind == VerifyKind::kImbalance
               ? certificate.energy[0].imbalance
               : farthest_from(made.exact, solution.radiosity.span());
    return {};
  }
  if (made.kind == VerifyKind::kPointToPatch) {
    HC_TRY(compute_point_form_factors(patches, {&made.point, 1}, options, executor, &progress,
                                      &matrix, &certificate));
    *got = entry(matrix.row(0), 0);
    return {};
  }
  HC_TRY(compute_form_factors(patches, {}, options, executor, &progress, &matrix, &certificate));
  *got = made.kind == VerifyKind::kPatchToPatch ? entry(matrix.row(0), 1)
                                                : shared_power(patches, matrix);
  return {};
}

Status run_case(const CommandLine& line, Executor& executor, Outcome* outcome) {
  const VerifyCase& made = outcome->made;
  Options options = line.options;
  options.rung = outcome->rung;
  options.error = kVerifyError;
  options.choose_rung = options.choose_resolution = options.estimate_error = false;
  options.tolerance = kTolerance;
  options.balance = false; // the bounds are those of rungs
  PatchSet patches;
  MeshReport report;
  Stopwatch watch;
  HC_TRY(build_patches(made.scene.scene(), &patches, &report));
  HC_TRY(compute(made, patches, options, executor, &outcome->got));
  outcome->seconds = watch.lap();
  outcome->error =
      std::fabs(outcome->got - made.exact) / (made.exact == 0 ? 1 : std::fabs(made.exact));
  outcome->bound = made.bounds[static_cast<std::size_t>(outcome->rung)];
  return check_interrupt();
}

/// Text in a column, and two blanks.
std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text + "  ";
}

std::string digits(double value) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 12).ptr;
  return {text, end};
}

std::string table_line(const std::array<std::string, 8>& fields) {
  constexpr std::size_t kWidths[] = {22, 8, 17, 17, 8, 6, 7, 0};
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k)
    line += k + 1 < fields.size() ? padded(fields[k], kWidths[k]) : fields[k] + "\n";
  return line;
}

void print_header() {
  print(table_line({"case", "rung", "exact", "got", "error", "bound", "seconds", ""}));
}

void print_line(const Outcome& outcome) {
  print(table_line({outcome.made.name, rung_name(outcome.rung), digits(outcome.made.exact),
                    digits(outcome.got), rounded(outcome.error),
                    outcome.is_promised() ? rounded(outcome.bound) : "", rounded(outcome.seconds),
                    outcome.failed()        ? "FAILED"
                    : outcome.is_promised() ? "ok"
                                            : "no promise"}));
}

void print_json(std::span<const Outcome> outcomes, std::uint64_t failures) {
  nlohmann::ordered_json json;
  nlohmann::ordered_json& list = json["cases"] = nlohmann::ordered_json::array();
  for (const Outcome& outcome : outcomes) {
    nlohmann::ordered_json& one = list.emplace_back();
    one["case"] = outcome.made.name;
    one["rung"] = rung_name(outcome.rung);
    one["exact"] = outcome.made.exact;
    one["got"] = outcome.got;
    one["error"] = outcome.error;
    if (outcome.is_promised())
      one["bound"] = outcome.bound;
    one["seconds"] = outcome.seconds;
    one["failed"] = outcome.failed();
  }
  json["failures"] = failures;
  print(json.dump(2) + "\n");
}

} // namespace

Status run_verify(const CommandLine& line) {
  ThreadPool pool;
  HC_TRY(pool.init(line.threads));
  std::vector<VerifyCase> cases = verify_cases();
  if (line.all_cases)
    for (VerifyCase& hard : verify_hard_cases())
      cases.push_back(std::move(hard));
  std::vector<Outcome> outcomes;
  std::uint64_t failures = 0;
  if (!line.json && !line.quiet)
    print_header();
  for (const VerifyCase& made : cases)
    for (const Rung rung :
         {Rung::kHemicube, Rung::kAnalytic, Rung::kArea, Rung::kAdaptive, Rung::kExact}) {
      if (!line.options.choose_rung && line.options.rung != rung)
        continue;
      Outcome& outcome = outcomes.emplace_back(Outcome{made, rung});
      HC_TRY(run_case(line, pool, &outcome));
      failures += outcome.failed() ? 1 : 0;
      if (!line.json && (outcome.failed() || !line.quiet))
        print_line(outcome);
    }
  if (line.json)
    print_json(outcomes, failures);
  if (failures != 0)
    return Status::error(StatusCode::kCheckFailed, failures, " of ", outcomes.size(),
                         " results are farther from the exact ones than their rung promises");
  return {};
}

} // namespace hemicube::radiosity::cli
