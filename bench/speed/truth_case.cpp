#include "bench/speed/truth_case.h"

#include "bench/speed/stage_clock.h"
#include "tests/support/reference.h"
#include "tests/support/scenes_shared.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace hemicube::bench {
namespace {

using radiosity::Certificate;
using radiosity::FormFactorMatrix;
using radiosity::Options;
using test::require;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void check(bool holds, const std::string& name, const std::string& what) {
  if (!holds)
    throw std::runtime_error(name + ": " + what);
}

/// A table [patch][band] of finite numbers, some of them > 0.
void check_table(const nlohmann::json& table, std::size_t patches, std::size_t bands,
                 const std::string& name) {
  check(table.is_array() && table.size() == patches, name, "the truth is for other patches");
  double largest = 0;
  for (const nlohmann::json& row : table) {
    check(row.is_array() && row.size() == bands, name, "the truth is for other bands");
    for (const nlohmann::json& value : row) {
      check(value.is_number() && value >= 0, name, "the truth has a hole");
      largest = std::max(largest, value.get<double>());
    }
  }
  check(largest > 0, name, "the truth is dark");
}

} // namespace

TruthCase::TruthCase(Kind kind, const std::string& name) : kind_(kind), name_(name) {
  if (kind == Kind::kMatrix) {
    read_matrix();
  } else if (kind == Kind::kScene) {
    const nlohmann::json truth = test::reference_json("scenes/" + name + ".truth.json");
    read_radiosities("scenes/" + name + ".coarse.obj", truth.at("coarse_constant_element_B"),
                     truth.at("coarse").at("B"));
  } else {
    const nlohmann::json truth = test::reference_case("enclosures.json", name).at("truth");
    read_radiosities("enclosures/" + name + ".obj", truth.at("constant_element_patch_B"),
                     truth.at("continuous_patch_B"));
  }
}

void TruthCase::read_matrix() {
  scene_ = test::reference_scene("viewfactors/" + name_ + ".obj");
  patches_ = test::patches_of(scene_);
  form_factors_ = test::reference_matrix("viewfactors/" + name_ + ".F.npy");
  check(form_factors_.size == patches_.patch_count(), name_, "the truth is for other patches");
}

void TruthCase::read_radiosities(const std::string& mesh, const nlohmann::json& constant_elements,
                                 const nlohmann::json& continuous) {
  scene_ = test::reference_scene(mesh);
  patches_ = test::patches_of(scene_);
  constant_element_b_ = constant_elements;
  continuous_b_ = continuous;
  check_table(constant_element_b_, patches_.patch_count(), scene_.band_count(), name_);
  check_table(continuous_b_, patches_.patch_count(), scene_.band_count(), name_);
}

std::optional<Run> TruthCase::run(const Options& options, double limit) const {
  return is_matrix() ? run_matrix(options, limit) : run_scene(options, limit);
}

std::optional<Run> TruthCase::run_matrix(const Options& options, double limit) const {
  radiosity::SerialExecutor executor;
  FormFactorMatrix matrix;
  Certificate certificate;
  StageClock clock(limit);
  const Status status = radiosity::compute_form_factors(patches_, {}, options, executor, &clock,
                                                        &matrix, &certificate);
  if (status.code() == StatusCode::kCancelled)
    return {};
  require(status);
  Run run;
  run.form_factor_seconds = run.total_seconds = clock.seconds();
  run.hash = certificate.form_factor_hash;
  double difference = 0, squares = 0;
  for (std::uint64_t i = 0; i < form_factors_.size; ++i) {
    std::vector<double> dense(form_factors_.size, 0.0);
    const radiosity::RowView row = matrix.row(i);
    for (std::size_t k = 0; k < row.columns.size(); ++k)
      dense[row.columns[k]] = row.scale * static_cast<double>(row.values[k]);
    for (std::size_t j = 0; j < form_factors_.size; ++j) {
      const double truth = form_factors_.at(i, j);
      difference += (dense[j] - truth) * (dense[j] - truth);
      squares += truth * truth;
    }
  }
  const double pairs = static_cast<double>(form_factors_.values.size());
  run.errors = {std::sqrt(difference / pairs), std::sqrt(difference / squares), kNone, kNone};
  return run;
}

std::optional<Run> TruthCase::run_scene(const Options& options, double limit) const {
  radiosity::SerialExecutor executor;
  radiosity::Solution solution;
  Certificate certificate;
  StageClock clock(limit);
  const Status status =
      radiosity::solve_scene(scene_, patches_, options, executor, &clock, &solution, &certificate);
  if (status.code() == StatusCode::kCancelled)
    return {};
  require(status);
  Run run;
  run.total_seconds = clock.seconds();
  run.form_factor_seconds = clock.form_factor_seconds();
  run.hash = certificate.form_factor_hash;
  const auto error = [&](const nlohmann::json& truth) {
    return test::deviation(solution.radiosity.span(), truth, patches_.area.span()).area_rms;
  };
  run.errors = {kNone, kNone, error(constant_element_b_), error(continuous_b_)};
  return run;
}

std::vector<TruthCase> all_truth_cases() {
  using Kind = TruthCase::Kind;
  std::vector<TruthCase> cases;
  for (const char* name : {"cube8", "boxin"})
    cases.emplace_back(Kind::kMatrix, name);
  for (const char* name :
       {"cornell", "tableroom_a", "tworooms_a", "corridor_a", "corner2_90_a", "corner2_10_a"})
    cases.emplace_back(Kind::kScene, name);
  for (const char* name : {"cube_mixed", "room_bleed"})
    cases.emplace_back(Kind::kEnclosure, name);
  return cases;
}

} // namespace hemicube::bench
