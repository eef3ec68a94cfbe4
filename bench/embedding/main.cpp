// What embedding costs: bytes of code, heap per thread, patch and non-zero, time to start.
// Usage: embedding LIBHEMICUBE.SO PROGRAM OUTPUT_FOLDER
#include "bench/bench_scenes.h"
#include "bench/machine.h"
#include "radiosity/radiosity.h"
#include "raster/kernels.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace hemicube::bench {
namespace {

using namespace radiosity;
namespace fs = std::filesystem;

std::size_t g_live = 0, g_peak = 0; ///< bytes asked for; one thread is at work

void count_heap() {
  set_allocator({[](std::size_t bytes) {
                   g_live += bytes;
                   g_peak = std::max(g_peak, g_live);
                   return default_allocator().allocate(bytes);
                 },
                 [](void* memory, std::size_t bytes) {
                   g_live -= bytes;
                   default_allocator().release(memory, bytes);
                 }});
}

/// So many workers, one after the other on one thread: each has its share of blocks whatever the
/// machine is doing.
class Workers final : public Executor {
public:
  explicit Workers(std::size_t count) : count_(count) {}
  std::size_t worker_count() const noexcept override { return count_; }
  Status run(std::size_t block_count, Block block, void* context) noexcept override {
    for (std::size_t i = 0; i < block_count; ++i)
      HC_TRY(block(context, i, i % count_));
    return {};
  }

private:
  std::size_t count_;
};

PatchSet scene(const std::string& name) {
  for (const BenchScene& each : kBenchScenes)
    if (each.name == name)
      return each.build();
  throw std::runtime_error("no scene named " + name);
}

/// Most heap that some rows take at once, beyond what is there.
double peak_of_rows(const PatchSet& patches, const Options& options, std::size_t workers,
                    std::uint32_t row_count, FormFactorMatrix* matrix) {
  Workers executor(workers);
  Certificate certificate;
  const std::size_t before = g_peak = g_live;
  test::require(compute_form_factors(patches, scattered(patches, row_count), options, executor,
                                     nullptr, matrix, &certificate));
  return static_cast<double>(g_peak - before);
}

class Table {
public:
  explicit Table(const fs::path& path) : out_(path) { out_ << "quantity,value,unit,of\n"; }
  void add(const char* quantity, double value, const char* unit, const std::string& of) {
    char number[32];
    std::snprintf(number, sizeof number, "%.4g", value);
    const std::string line = std::string(quantity) + "," + number + "," + unit + "," + of + "\n";
    std::fputs(line.c_str(), stdout);
    out_ << line;
  }

private:
  std::ofstream out_;
};

/// Rungs alike but for what they take, and resolutions.
void measure_heap(Table* table) {
  constexpr std::uint32_t kRows = 64; // eight blocks: each worker gets some
  const PatchSet small = scene("office10k"), large = scene("office100k");
  const double more = large.patch_count() - small.patch_count();
  for (const Rung rung : {Rung::kHemicube, Rung::kAdaptive})
    for (const std::uint32_t resolution : {64u, 256u, 1024u}) {
      if (rung != Rung::kHemicube && resolution != 256)
        continue;
      Options options;
      options.rung = rung;
      options.resolution = resolution;
      const std::string of =
          std::string(rung_name(rung)) + " " + std::to_string(resolution) + "; office10k";
      FormFactorMatrix matrix;
      const double one = peak_of_rows(small, options, 1, kRows, &matrix);
      const double two = peak_of_rows(small, options, 2, kRows, &matrix);
      table->add("heap_per_thread", two - one, "bytes", of);
      const double many = peak_of_rows(large, options, 1, kRows, &matrix);
      table->add("heap_per_patch", (many - one) / more, "bytes", of + " to office100k");
    }
  Options options;
  const std::size_t before = g_live;
  FormFactorMatrix matrix;
  peak_of_rows(small, options, 1, 1000, &matrix);
  table->add("heap_per_nonzero",
             static_cast<double>(g_live - before) / static_cast<double>(matrix.nonzero_count()),
             "bytes", "1000 rows of office10k");
}

/// Code and data of a program or library, as `size` counts them.
void measure_code(const std::string& file, const char* what, Table* table) {
  std::FILE* pipe = ::popen(("size '" + file + "'").c_str(), "r");
  long text = 0, data = 0, bss = 0;
  if (pipe == nullptr || std::fscanf(pipe, "%*[^\n] %ld %ld %ld", &text, &data, &bss) != 3 ||
      ::pclose(pipe) < 0)
    throw std::runtime_error("cannot measure " + file);
  table->add("code", static_cast<double>(text), "bytes", what);
  table->add("data", static_cast<double>(data + bss), "bytes", what);
}

template <typename Function> double median_seconds(int repetitions, Function function) {
  std::vector<double> seconds;
  for (int k = 0; k < repetitions; ++k) {
    const auto start = std::chrono::steady_clock::now();
    function();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + repetitions / 2, seconds.end());
  return seconds[static_cast<std::size_t>(repetitions) / 2];
}

void measure_start(const std::string& library, const std::string& program, Table* table) {
  table->add("start",
             1e6 * median_seconds(101,
                                  [&] {
                                    void* handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
                                    if (handle == nullptr || ::dlsym(handle, "hc_solve") == nullptr)
                                      throw std::runtime_error("cannot load " + library);
                                    ::dlclose(handle);
                                  }),
             "microseconds", "dlopen of libhemicube.so");
  table->add("start",
             1e3 * median_seconds(31,
                                  [&] {
                                    if (std::system((program + " >/dev/null").c_str()) != 0)
                                      throw std::runtime_error("failed: " + program);
                                  }),
             "milliseconds",
             "whole run of examples/room.c by a shell: 96 patches; form factors; light");
}

} // namespace
} // namespace hemicube::bench

int main(int argc, char** argv) {
  using namespace hemicube;
  using namespace hemicube::bench;
  if (argc != 4) {
    std::fprintf(stderr, "usage: embedding LIBHEMICUBE.SO PROGRAM OUTPUT_FOLDER\n");
    return 2;
  }
  try {
    const fs::path folder = fs::path(argv[3]) / (cpu_name() + "_" + raster::best_kernels().name);
    fs::create_directories(folder);
    Table table(folder / "embedding.csv");
    measure_code(argv[1], "libhemicube.so", &table);
    measure_start(argv[1], argv[2], &table);
    count_heap();
    measure_heap(&table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "embedding: %s\n", error.what());
    return 1;
  }
  return 0;
}
