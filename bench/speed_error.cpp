// Error against time, for every rung of the ladder of accuracy: scenes whose form factors or
// radiosities are known without this program, one thread, interleaved repetitions, medians.
// Usage: speed_error OUTPUT_FOLDER [SCENE]; with a scene, only that one, and nothing is written.
#include "bench/machine.h"
#include "bench/speed/truth_case.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

using namespace hemicube;
using namespace hemicube::bench;
using radiosity::Options;
using radiosity::Rung;

namespace {

constexpr std::uint32_t kResolutions[] = {64, 128, 256, 512};
constexpr double kTargets[] = {0.3, 0.1, 0.03, 0.01, 0.003, 0.001};

// A setting is run again until it has had its time. Twice at least: the hashes are compared.
constexpr std::size_t kLeastRuns = 2, kMostRuns = 9;
constexpr double kEnoughSeconds = 0.6;
// What takes longer is left out.
constexpr double kMostSeconds = 6;

/// A point of a line of the plot: a rung, and what is varied on it.
struct Setting {
  Rung rung;
  std::uint32_t resolution = 0; ///< 0: the rung does not depend on it here
  double target = 0;            ///< 0: the rung has none

  Options options() const {
    Options options;
    options.rung = rung;
    if (resolution != 0)
      options.resolution = resolution;
    if (target != 0)
      options.error = target;
    return options;
  }
  std::string resolution_text() const { return resolution == 0 ? "" : std::to_string(resolution); }
  std::string target_text() const { return target == 0 ? "" : shortest(target); }

private:
  static std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
  }
};

std::vector<Setting> all_settings() {
  std::vector<Setting> settings;
  for (const Rung rung : {Rung::kHemicube, Rung::kAnalytic, Rung::kArea})
    for (const std::uint32_t resolution : kResolutions)
      settings.push_back({rung, resolution});
  for (const double target : kTargets)
    settings.push_back({Rung::kAdaptive, 0, target});
  settings.push_back({Rung::kExact});
  return settings;
}

/// All runs of one setting.
struct Measured {
  Setting setting;
  Run first;
  std::vector<double> form_factor_seconds, total_seconds;
  double spent = 0;
  bool is_too_long = false;

  std::string name() const {
    return std::string(rung_name(setting.rung)) + " " + setting.resolution_text() +
           setting.target_text();
  }
  bool wants_more() const {
    if (is_too_long)
      return false;
    const std::size_t runs = total_seconds.size();
    return runs < kLeastRuns || (runs < kMostRuns && spent < kEnoughSeconds);
  }
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// A number, or nothing for NaN.
std::string cell(double value) {
  if (std::isnan(value))
    return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.3e", value);
  return text;
}

/// An error that was measured is some number above zero: form factors are rounded.
void check_errors(const TruthCase& truth, const Errors& errors) {
  const bool found = truth.is_matrix() ? errors.rms_f > 0 && errors.relative_f > 0
                                       : errors.relative_b > 0 && errors.relative_continuous_b > 0;
  if (!found)
    throw std::runtime_error(truth.name() + ": no error was measured; is the truth there?");
}

void run_once(const TruthCase& truth, Measured* measured) {
  const bool is_first = measured->total_seconds.empty();
  const std::optional<Run> finished =
      truth.run(measured->setting.options(), is_first ? kMostSeconds : 10 * kMostSeconds);
  if (!finished) {
    measured->is_too_long = true;
    return;
  }
  const Run& run = *finished;
  if (is_first) {
    check_errors(truth, run.errors);
    measured->first = run;
  } else if (run.hash != measured->first.hash) {
    throw std::runtime_error(truth.name() + ", rung " + measured->name() +
                             ": two runs with the same setting have different hashes");
  }
  measured->form_factor_seconds.push_back(run.form_factor_seconds);
  measured->total_seconds.push_back(run.total_seconds);
  measured->spent += run.total_seconds;
}

std::string csv_line(const TruthCase& truth, const Measured& measured) {
  const Setting& setting = measured.setting;
  const Errors& errors = measured.first.errors;
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016" PRIx64, measured.first.hash);
  std::string line;
  for (const std::string& field :
       {truth.name(), std::to_string(truth.patch_count()), std::string(rung_name(setting.rung)),
        setting.resolution_text(), setting.target_text(),
        std::to_string(measured.total_seconds.size()), cell(median(measured.form_factor_seconds)),
        cell(median(measured.total_seconds)), cell(errors.rms_f), cell(errors.relative_f),
        cell(errors.relative_b), cell(errors.relative_continuous_b)})
    line += field + ",";
  return line + hash + "\n";
}

/// All settings on one scene: lines of the table.
std::string measure(const TruthCase& truth) {
  std::vector<Measured> all;
  for (const Setting& setting : all_settings())
    all.push_back({setting, {}, {}, {}, 0, false});
  for (bool more = true; more;) {
    more = false;
    for (Measured& measured : all)
      if (measured.wants_more()) {
        run_once(truth, &measured);
        more = true;
      }
  }
  std::string lines;
  for (const Measured& measured : all) {
    if (!measured.is_too_long)
      lines += csv_line(truth, measured);
    else
      std::fprintf(stderr, "speed_error: %s, rung %s: more than %g s, left out\n",
                   truth.name().c_str(), measured.name().c_str(), kMostSeconds);
  }
  return lines;
}

int run(const std::filesystem::path& output, const std::string& only) {
  const auto start = std::chrono::steady_clock::now();
  const std::string header = "scene,patches,rung,resolution,error_target,runs,form_factor_seconds,"
                             "total_seconds,rms_error_of_f,relative_error_of_f,relative_error_of_b,"
                             "relative_error_of_continuous_b,form_factor_hash\n";
  std::string table = header;
  std::printf("%s", header.c_str());
  for (const TruthCase& truth : all_truth_cases()) {
    if (!only.empty() && truth.name() != only)
      continue;
    const std::string lines = measure(truth);
    table += lines;
    std::printf("%s", lines.c_str());
    std::fflush(stdout);
  }
  if (table == header)
    throw std::runtime_error("no scene is named " + only);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("speed_error: %.0f s\n", took.count());
  if (!only.empty())
    return 0;
  const std::filesystem::path folder = output / (cpu_name() + "_" + raster::best_kernels().name);
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / "speed_error.csv");
  file << table;
  if (!file.flush())
    throw std::runtime_error("cannot write " + (folder / "speed_error.csv").string());
  // The last line is the folder: `make speed` draws what lies there.
  std::printf("%s\n", folder.c_str());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: speed_error OUTPUT_FOLDER [SCENE]\n");
    return 2;
  }
  try {
    return run(argv[1], argc > 2 ? argv[2] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "speed_error: %s\n", error.what());
    return 1;
  }
}
