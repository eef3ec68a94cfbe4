#include "bench/solvers/solvers.h"

#include "radiosity/solve/gauss_seidel.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"
#include "tests/support/drawn_face.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>

namespace hemicube::bench {
namespace {

using namespace radiosity;
using test::require;

/// Takes the time between checks of the residual.
class SweepClock final : public SolverProgress {
public:
  bool swept(std::uint64_t sweeps, double) noexcept override {
    const double lap = watch_.lap();
    if (sweeps != 0)
      seconds.push_back(lap);
    return true;
  }
  std::vector<double> seconds;

private:
  Stopwatch watch_;
};

constexpr std::uint64_t kSweeps = 8, kSweepsPerCheck = 4;

struct Case {
  std::string name;
  const FormFactorMatrix& matrix;
  Light light;
};

/// One patch in 100 emits; bands differ.
Light light_for(std::vector<double> area, std::uint32_t bands) {
  Light light;
  light.bands = bands;
  light.space_exitance.assign(bands, 0);
  for (std::size_t i = 0; i < area.size(); ++i)
    for (std::uint32_t b = 0; b < bands; ++b) {
      light.reflectance.push_back(0.4 + 0.1 * b + 0.002 * static_cast<double>(i % 97));
      light.exitance.push_back(i % 100 == 0 ? 1 + b : 0);
    }
  light.area = std::move(area);
  return light;
}

std::uint64_t volatile g_sink;

/// Columns and values of all rows, each word once, side by side: the fastest way found.
double time_read(const FormFactorMatrix& matrix, Executor& executor) {
  Stopwatch watch;
  require(executor.for_each(matrix.block_count(), [&](std::size_t block, std::size_t) {
    std::uint64_t sum = 0;
    for (std::uint64_t i = matrix.block_begin(block); i < matrix.block_end(block); ++i) {
      const RowView row = matrix.row(i);
      const auto* values = reinterpret_cast<const std::uint32_t*>(row.values.data());
      std::uint32_t words[16] = {};
      const std::size_t count = row.columns.size() / 16 * 16;
      for (std::size_t k = 0; k < count; k += 16) {
        for (std::size_t lane = 0; lane < 16; ++lane)
          words[lane] ^= row.columns[k + lane] ^ values[k + lane];
      }
      for (const std::uint32_t word : words)
        sum += word;
    }
    g_sink = sum;
    return Status();
  }));
  return watch.lap();
}

/// The same bytes copied to memory that no cache holds.
double time_copy(const FormFactorMatrix& matrix, Executor& executor,
                 std::vector<std::vector<std::uint32_t>>* targets) {
  constexpr std::size_t kWords = std::size_t{1} << 26;
  if (targets->empty())
    targets->assign(executor.worker_count(), std::vector<std::uint32_t>(kWords));
  std::vector<std::size_t> at(targets->size());
  Stopwatch watch;
  require(executor.for_each(matrix.block_count(), [&](std::size_t block, std::size_t worker) {
    for (std::uint64_t i = matrix.block_begin(block); i < matrix.block_end(block); ++i) {
      const RowView row = matrix.row(i);
      const std::size_t count = row.columns.size();
      if (at[worker] + 2 * count > kWords)
        at[worker] = 0;
      std::uint32_t* const to = (*targets)[worker].data() + at[worker];
      std::memcpy(to, row.columns.data(), count * 4);
      std::memcpy(to + count, row.values.data(), count * 4);
      at[worker] += 2 * count;
    }
    return Status();
  }));
  return watch.lap();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool time_case(const Case& test, int repetitions, Tables* tables) {
  std::uint64_t first_hash = 0;
  for (const std::uint32_t threads : {1u, 2u}) {
    ThreadPool pool;
    require(pool.init(threads));
    std::vector<double> read, copy;
    std::map<std::string, std::vector<double>> sweep;
    std::map<std::string, std::uint64_t> hashes;
    std::vector<std::vector<std::uint32_t>> targets;
    for (int k = 0; k < repetitions; ++k) {
      copy.push_back(time_copy(test.matrix, pool, &targets));
      for (const std::string& isa : test::kernels_here()) {
        read.push_back(time_read(test.matrix, pool));
        SolverOptions options;
        options.tolerance = 1e-300;
        options.max_sweeps = kSweeps;
        options.kernels = raster::kernels_by_name(isa);
        SweepClock clock;
        Buffer<double> b, h;
        Convergence convergence;
        (void)gauss_seidel(test.matrix, test.light.problem(), options, pool, &clock, &b, &h,
                           &convergence); // not to converge
        for (const double seconds : clock.seconds)
          sweep[isa].push_back(seconds / (kSweepsPerCheck + 1));
        hashes[isa] = hash_of(b);
        read.push_back(time_read(test.matrix, pool));
      }
    }
    for (const auto& [isa, seconds] : sweep) {
      const double bytes = 8 * static_cast<double>(test.matrix.nonzero_count());
      char line[300];
      std::snprintf(line, sizeof line,
                    "%s,%" PRIu64 ",%.3f,%u,%u,%.4f,%.4f,%.4f,%.3f,%.1f,%016" PRIx64 "\n",
                    test.name.c_str(), test.matrix.row_count(), bytes * 1e-9, test.light.bands,
                    threads, median(read), median(copy), median(seconds),
                    median(read) / median(seconds), bytes * 1e-9 / median(seconds), hashes[isa]);
      std::printf("%-7s %s", isa.c_str(), line);
      std::fflush(stdout);
      (*tables)[isa] += line;
      if (first_hash == 0)
        first_hash = hashes[isa];
      if (hashes[isa] != first_hash) {
        std::fprintf(stderr, "%s: the hash of %s on %u threads differs\n", test.name.c_str(),
                     isa.c_str(), threads);
        return false;
      }
    }
  }
  return true;
}

} // namespace

bool time_sweeps(int repetitions, Tables* tables) {
  ThreadPool pool;
  require(pool.init(0));
  std::vector<double> area;
  {
    FormFactorMatrix cornell;
    make_cornell_matrix(0.02, pool, &cornell, &area);
    for (const std::uint32_t bands : {1u, 3u})
      if (!time_case({"cornell", cornell, light_for(area, bands)}, repetitions, tables))
        return false;
  }
  constexpr std::uint32_t kPatches = 40000, kRowNonzeros = 4700;
  FormFactorMatrix rooms;
  make_long_matrix(kPatches, kRowNonzeros, pool, &rooms);
  area.assign(kPatches, 1);
  for (const std::uint32_t bands : {1u, 3u})
    if (!time_case({"rooms", rooms, light_for(area, bands)}, repetitions, tables))
      return false;
  return true;
}

} // namespace hemicube::bench
