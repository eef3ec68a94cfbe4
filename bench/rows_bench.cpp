// Hemicubes per second, one thread, every row beside its error and its hash. All instruction sets
// are timed in one run, interleaved; the median counts. Usage: rows_bench OUTPUT_FOLDER
// [repetitions]
#include "bench/bench_scenes.h"
#include "bench/machine.h"
#include "radiosity/radiosity.h"
#include "raster/kernels.h"
#include "tests/support/drawn_face.h"
#include "tests/support/one_point.h"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

using namespace hemicube;
using namespace hemicube::radiosity;
using hemicube::test::require;

namespace {

struct Case {
  const char* name;        ///< of kBenchScenes
  std::uint32_t receivers; ///< scattered
  const char* error_from;  ///< what the form factors are compared with
};

const Case kCases[] = {
    {"cube8", 384, "exact point form factors"},
    {"cornell10k", 247, "resolution 2048"},
    {"office100k", 120, "resolution 2048"},
};
const std::uint32_t kResolutions[] = {64, 256, 1024};

PatchSet load(const Case& test) {
  for (const bench::BenchScene& scene : bench::kBenchScenes)
    if (std::string(scene.name) == test.name)
      return scene.build();
  throw std::runtime_error(std::string("no scene named ") + test.name);
}

/// The time from the first row to the last.
class RowClock final : public Progress {
public:
  bool rows(std::uint64_t done, std::uint64_t total) noexcept override {
    const auto now = std::chrono::steady_clock::now();
    if (done == 0)
      start_ = now;
    if (done == total)
      seconds_ = std::chrono::duration<double>(now - start_).count();
    return true;
  }
  bool sweeps(std::uint64_t, double) noexcept override { return true; }
  double seconds() const { return seconds_; }

private:
  std::chrono::steady_clock::time_point start_;
  double seconds_ = 0;
};

/// Rows of the receivers as dense vectors.
std::vector<double> dense_rows(const FormFactorMatrix& matrix) {
  std::vector<double> dense(matrix.row_count() * matrix.column_count());
  for (std::uint64_t i = 0; i < matrix.row_count(); ++i) {
    const RowView row = matrix.row(i);
    for (std::size_t k = 0; k < row.columns.size(); ++k)
      dense[i * matrix.column_count() + row.columns[k]] =
          row.scale * static_cast<double>(row.values[k]);
  }
  return dense;
}

double compute(const PatchSet& patches, const std::vector<std::uint32_t>& rows,
               std::uint32_t resolution, const raster::Kernels& kernels, FormFactorMatrix* matrix,
               std::uint64_t* hash) {
  Options options;
  options.resolution = resolution;
  options.kernels = &kernels;
  SerialExecutor executor;
  Certificate certificate;
  RowClock clock;
  require(compute_form_factors(patches, rows, options, executor, &clock, matrix, &certificate));
  *hash = certificate.form_factor_hash;
  return clock.seconds();
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    squares += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

std::vector<double> reference_rows(const Case& test, const PatchSet& patches,
                                   const std::vector<std::uint32_t>& rows) {
  if (std::string(test.name) == "cube8")
    return test::one_point_form_factors(patches);
  FormFactorMatrix matrix;
  std::uint64_t hash = 0;
  compute(patches, rows, 2048, raster::best_kernels(), &matrix, &hash);
  return dense_rows(matrix);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: rows_bench OUTPUT_FOLDER [repetitions]\n");
    return 2;
  }
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  std::map<std::string, std::string> tables; // ISA -> CSV
  for (const Case& test : kCases) {
    const PatchSet patches = load(test);
    const std::vector<std::uint32_t> rows = bench::scattered(patches, test.receivers);
    const std::vector<double> reference = reference_rows(test, patches, rows);
    for (const std::uint32_t resolution : kResolutions) {
      std::map<std::string, std::vector<double>> seconds;
      std::map<std::string, std::uint64_t> hashes;
      FormFactorMatrix matrix;
      for (int k = 0; k < repetitions; ++k)
        for (const std::string& isa : test::kernels_here())
          seconds[isa].push_back(compute(patches, rows, resolution, *raster::kernels_by_name(isa),
                                         &matrix, &hashes[isa]));
      const double error = rms(dense_rows(matrix), reference);
      for (auto& [isa, times] : seconds) {
        if (hashes[isa] != hashes.begin()->second) {
          std::fprintf(stderr, "%s at %u: the hashes of %s and %s differ\n", test.name, resolution,
                       isa.c_str(), hashes.begin()->first.c_str());
          return 1;
        }
        std::sort(times.begin(), times.end());
        char line[300];
        std::snprintf(line, sizeof line, "%s,%u,%u,%zu,1,%.0f,%.2e,%s,%016" PRIx64 "\n", test.name,
                      patches.patch_count(), resolution, rows.size(),
                      static_cast<double>(rows.size()) / times[times.size() / 2], error,
                      test.error_from, hashes[isa]);
        std::printf("%-7s %s", isa.c_str(), line);
        std::fflush(stdout);
        tables[isa] += line;
      }
    }
  }
  for (const auto& [isa, table] : tables) {
    const std::filesystem::path folder =
        std::filesystem::path(argv[1]) / (bench::cpu_name() + "_" + isa);
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "rows.csv")
        << "scene,patches,resolution,rows,threads,hemicubes_per_second,rms_form_factor_error,"
           "error_against,form_factor_hash\n"
        << table;
  }
  return 0;
}
