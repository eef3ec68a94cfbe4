// How time and memory of whole runs of the program grow with the scene: bench/README.md.

#include "bench/growth/office_file.h"
#include "bench/machine.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace hemicube::bench {
namespace {

using Json = nlohmann::json;

/// Rooms of about 3,000 patches each, that see about 1,000 others.
constexpr double kCell = 0.255;
const std::vector<test::OfficePlan> kPlans = {
    {3, 1, 1, kCell}, {5, 2, 1, kCell}, {4, 4, 2, kCell}, {5, 5, 4, kCell}};

struct Run {
  double patches, seconds, memory;
};

/// Starts the program and reads the JSON it prints.
Json run_program(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr)
    throw std::runtime_error("cannot run " + command);
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), count);
  if (::pclose(pipe) != 0)
    throw std::runtime_error("failed: " + command);
  return Json::parse(text);
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// b of y = a x^b by least squares of logarithms.
double exponent(const std::vector<Run>& runs, double Run::*y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(runs.size());
  for (const Run& run : runs) {
    const double u = std::log(run.patches), v = std::log(run.*y);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// One scene: what was predicted, and what it took from the start of the process to its end.
std::string measure(const std::string& program, const std::string& options,
                    const test::OfficePlan& plan, std::vector<Run>* runs) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "hemicube-growth";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string scene = (folder / "office.obj").string();
  write_office(plan, scene);
  const Json cost = run_program(program + " info --json " + options + " " + scene).at("cost");
  const auto start = std::chrono::steady_clock::now();
  const Json report = run_program(program + " solve --json --quiet " + options + " " + scene +
                                  " -o " + (folder / "out").string());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::filesystem::remove_all(folder);

  const Json &result = report.at("result"), &run = report.at("run");
  const double patches = result.at("patches");
  runs->push_back({patches, took.count(), run.at("peak_memory_bytes")});
  const Json& seconds = run.at("seconds");
  std::string line = number(patches);
  for (const double value :
       {result.at("nonzeros").get<double>() / patches, took.count(),
        seconds.at("form_factors").get<double>(), seconds.at("solve").get<double>(),
        seconds.at("write").get<double>(), run.at("peak_memory_bytes").get<double>() / 1e6,
        cost.at("seconds").get<double>(), cost.at("memory_bytes").get<double>() / 1e6,
        result.at("error").at("radiosity").get<double>()})
    line += ',' + number(value);
  line += ',' + std::to_string(run.at("threads").get<int>());
  for (const char* hash : {"form_factors", "radiosity"})
    line += ',' + result.at("hashes").at(hash).get<std::string>();
  return line + '\n';
}

int run(const std::string& program, const std::filesystem::path& output,
        const std::string& options) {
  std::string table = "patches,nonzeros_per_row,seconds,form_factor_seconds,solve_seconds,"
                      "write_seconds,peak_memory_mb,predicted_seconds,predicted_memory_mb,"
                      "estimated_error_of_b,threads,form_factor_hash,radiosity_hash\n";
  std::printf("%s", table.c_str());
  std::vector<Run> runs;
  for (const test::OfficePlan& plan : kPlans) {
    const std::string line = measure(program, options, plan, &runs);
    table += line;
    std::printf("%s", line.c_str());
    std::fflush(stdout);
  }
  const std::string fit = "# grows with the patches to the power of: time " +
                          number(exponent(runs, &Run::seconds)) + ", memory " +
                          number(exponent(runs, &Run::memory)) + "; options: " + options + "\n";
  std::printf("%s", fit.c_str());
  const std::filesystem::path folder = output / (cpu_name() + "_" + raster::best_kernels().name);
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / "growth.csv");
  file << table << fit;
  if (!file.flush())
    throw std::runtime_error("cannot write " + (folder / "growth.csv").string());
  return 0;
}

} // namespace
} // namespace hemicube::bench

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: growth PROGRAM OUTPUT_FOLDER OPTIONS\n");
    return 2;
  }
  try {
    return hemicube::bench::run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "growth: %s\n", error.what());
    return 1;
  }
}
