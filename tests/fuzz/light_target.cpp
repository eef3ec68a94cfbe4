// Light of a few patches of any form factors: balanced matrices are reciprocal and closed, and the
// three solvers find the same light, which solves the equations.

#include "radiosity/form_factor/balance.h"
#include "radiosity/form_factor/reciprocity.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solve/jacobi.h"
#include "radiosity/solve/progressive.h"
#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/target.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace hemicube::test {
namespace {

using radiosity::Convergence;
using radiosity::FormFactorMatrix;
using radiosity::RowView;

/// A matrix and all else that light depends on. Arrays are [patch][band].
struct System {
  std::uint32_t bands = 1;
  FormFactorMatrix matrix;
  std::vector<double> area, reflectance, exitance, space_exitance;

  std::size_t count() const { return area.size(); }
  radiosity::LightProblem problem() const {
    return {bands, area, reflectance, exitance, space_exitance};
  }
};

double decode_reflectance(ByteReader* bytes) {
  static constexpr double kSome[] = {0, 1, 0.5, 0.9, 0.999, 1 - 0x1p-30};
  const std::uint32_t kind = bytes->below(8);
  return kind < 6 ? kSome[kind] : bytes->share();
}

/// Exchange areas of up to 16 patches, which rows see with errors; what they leave is space or back
/// sides, or nothing.
void decode_matrix(ByteReader* bytes, System* system) {
  const std::size_t n = 1 + bytes->below(16);
  const std::uint32_t openness = bytes->below(4); // 0: all rows close
  const double noise = bytes->below(3) * 0.1;
  Random random(bytes->byte());
  const double density = bytes->share();
  std::vector<std::vector<double>> exchange(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (random.unit() < density)
        exchange[i][j] = exchange[j][i] = std::pow(random.unit(), 1.0 + 3 * (openness & 1)) + 1e-6;
  require(system->matrix.init(n, static_cast<std::uint32_t>(n)));
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0, seen = 0;
    for (const double s : exchange[i])
      sum += s;
    const double left = sum == 0 ? 1 : openness == 0 ? 0 : random.unit() * 0.5;
    system->area.push_back(sum == 0 ? 0.5 : sum / (1 - left));
    std::vector<std::uint32_t> columns;
    std::vector<float> values;
    for (std::size_t j = 0; j < n; ++j)
      if (exchange[i][j] > 0 && random.unit() >= noise / 4) {
        columns.push_back(static_cast<std::uint32_t>(j));
        values.push_back(static_cast<float>(exchange[i][j] / system->area[i] *
                                            (1 + noise * (2 * random.unit() - 1))));
        seen += exchange[i][j];
      }
    RowView row;
    row.columns = columns;
    row.values = values;
    const double share = seen > 0 ? 1 - left : 0;
    row.back_side = openness == 3 ? (1 - share) * random.unit() : 0;
    row.space = 1 - share - row.back_side;
    radiosity::fit_scale(1 - row.space - row.back_side, &row);
    require(system->matrix.append_row(i / FormFactorMatrix::kBlockRows, row));
  }
}

void decode_light(ByteReader* bytes, System* system) {
  system->bands = 1 + bytes->below(2);
  for (std::uint32_t b = 0; b < system->bands; ++b)
    system->space_exitance.push_back(bytes->below(3) == 0 ? bytes->share() : 0);
  for (std::size_t k = 0; k < system->count() * system->bands; ++k) {
    system->reflectance.push_back(decode_reflectance(bytes));
    system->exitance.push_back(bytes->below(4) == 0 ? bytes->share() : 0);
  }
}

template <typename... Parts> std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  return text.str();
}

/// Rows whose averages sum to less than half or more than twice their share: balance.h.
std::vector<bool> rows_that_give_way(const System& system) {
  std::vector<double> sums(system.count());
  for (std::uint64_t i = 0; i < system.count(); ++i) {
    const RowView row = system.matrix.row(i);
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      const double exchange = system.area[i] * row.scale * static_cast<double>(row.values[k]) / 2;
      sums[i] += exchange;
      sums[row.columns[k]] += exchange;
    }
  }
  std::vector<bool> result;
  for (std::uint64_t i = 0; i < system.count(); ++i) {
    const RowView row = system.matrix.row(i);
    const double share = system.area[i] * (1 - row.space - row.back_side);
    result.push_back(sums[i] < 0.5000001 * share || sums[i] > 1.9999999 * share);
  }
  return result;
}

std::string balance_problem(System* system, bool* is_balanced) {
  radiosity::SerialExecutor executor;
  radiosity::BalanceReport report;
  std::vector<double> space, back_side;
  for (std::uint64_t i = 0; i < system->count(); ++i) {
    space.push_back(system->matrix.row(i).space);
    back_side.push_back(system->matrix.row(i).back_side);
  }
  const std::vector<bool> gives_way = rows_that_give_way(*system);
  const Status status =
      radiosity::balance(&system->matrix, system->area, executor, nullptr, &report);
  *is_balanced = status.ok();
  if (!status.ok())
    return status.code() == StatusCode::kBadScene &&
                   report.rms_change > radiosity::kMostBalanceChange
               ? ""
               : text_of("balance: ", status.message());
  for (std::uint64_t i = 0; i < system->count(); ++i) {
    const RowView row = system->matrix.row(i);
    const double share = 1 - row.space - row.back_side, sum = radiosity::row_sum(row);
    if (!(sum <= share) || !(sum >= share - 1e-15) || !(row.space >= 0) || !(row.back_side >= 0))
      return text_of("balanced row ", i, " sums to ", sum, " of ", share);
    for (const float value : row.values)
      if (!(value > 0 && std::isfinite(value)))
        return text_of("balanced row ", i, " holds ", value);
    if (report.closure_residual <= 1e-7 && !gives_way[i] &&
        (std::fabs(row.space - space[i]) > 1e-7 || std::fabs(row.back_side - back_side[i]) > 1e-7))
      return text_of("space or back side of row ", i, " changed");
  }
  // Entries are floats, and rows are closed at the cost of reciprocity.
  radiosity::Reciprocity reciprocity;
  require(radiosity::measure_reciprocity(system->matrix, system->area, executor, &reciprocity));
  if (reciprocity.max > 0x1p-23 + 4 * report.closure_residual)
    return text_of("reciprocity ", reciprocity.max, ", closure ", report.closure_residual);
  return "";
}

struct Outcome {
  Status status;
  Buffer<double> light, irradiance;
  Convergence convergence;
};

/// By band: the largest |B|, and how far the light is from solving the equations, in long double.
std::string residual_problem(const System& system, const Outcome& outcome) {
  for (std::uint32_t b = 0; b < system.bands; ++b) {
    long double residual = 0, brightest = 0;
    for (std::size_t i = 0; i < system.count(); ++i) {
      const RowView row = system.matrix.row(i);
      long double gathered = static_cast<long double>(row.space) * system.space_exitance[b];
      for (std::size_t k = 0; k < row.columns.size(); ++k)
        gathered += static_cast<long double>(row.scale) * row.values[k] *
                    outcome.light[row.columns[k] * system.bands + b];
      const std::size_t at = i * system.bands + b;
      const long double light = outcome.light[at];
      if (!(light >= 0) || !std::isfinite(light))
        return text_of("light of patch ", i, " is ", light);
      residual = std::max(
          residual, std::fabs(system.exitance[at] + system.reflectance[at] * gathered - light));
      brightest = std::max(brightest, light);
    }
    if (residual > (outcome.convergence.residual + 0x1p-45L) * brightest)
      return text_of("residual ", residual / brightest, ", reported ",
                     outcome.convergence.residual);
  }
  return "";
}

/// Two solutions, each good to its own bound.
std::string difference(const System& system, const Outcome& a, const Outcome& b) {
  const double bound = a.convergence.estimated_error + b.convergence.estimated_error + 0x1p-40;
  for (std::uint32_t band = 0; band < system.bands; ++band) {
    double brightest = 0, largest = 0;
    for (std::size_t at = band; at < a.light.size(); at += system.bands) {
      brightest = std::max({brightest, a.light[at], b.light[at]});
      largest = std::max(largest, std::fabs(a.light[at] - b.light[at]));
    }
    if (largest > bound * brightest)
      return text_of("differ by ", largest / brightest, ", bounds ", a.convergence.estimated_error,
                     " and ", b.convergence.estimated_error);
  }
  return "";
}

std::string solvers_problem(const System& system) {
  radiosity::SerialExecutor executor;
  radiosity::SolverOptions options;
  options.tolerance = 1e-7;
  options.max_sweeps = 300;
  options.max_shots = 3000;
  static constexpr decltype(radiosity::gauss_seidel)* kSolvers[] = {
      radiosity::gauss_seidel, radiosity::jacobi, radiosity::progressive};
  static constexpr const char* kNames[] = {"Gauss-Seidel", "Jacobi", "progressive"};
  Outcome outcomes[3];
  for (int k = 0; k < 3; ++k) {
    Outcome& one = outcomes[k];
    one.status = kSolvers[k](system.matrix, system.problem(), options, executor, nullptr,
                             &one.light, &one.irradiance, &one.convergence);
    const StatusCode code = one.status.code();
    if (code != StatusCode::kOk && code != StatusCode::kSingular &&
        code != StatusCode::kNotConverged)
      return text_of(kNames[k], ": ", one.status.message());
    if ((code == StatusCode::kSingular) != (outcomes[0].status.code() == StatusCode::kSingular))
      return text_of(kNames[k], " and ", kNames[0], " disagree whether there is a solution");
    if (code == StatusCode::kSingular)
      continue;
    std::string problem = residual_problem(system, one);
    if (problem.empty())
      problem = difference(system, outcomes[0], one);
    if (!problem.empty())
      return text_of(kNames[k], ": ", problem);
  }
  return "";
}

} // namespace

Verdict judge_light(Bytes bytes) {
  ByteReader reader(bytes);
  System system;
  const bool balances = reader.below(2) == 1;
  decode_matrix(&reader, &system);
  decode_light(&reader, &system);
  bool is_whole = true;
  if (balances) {
    const std::string problem = balance_problem(&system, &is_whole);
    if (!problem.empty())
      return {problem};
  }
  return {is_whole ? solvers_problem(system) : "", is_whole};
}

} // namespace hemicube::test
