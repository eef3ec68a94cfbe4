// The solvers: error against sweeps and time, sweeps against plain reading. Usage: solvers_bench
// OUTPUT_FOLDER [repetitions]
#include "bench/machine.h"
#include "bench/solvers/solvers.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

using namespace hemicube::bench;

void write(const std::string& folder, const char* name, const char* header, const Tables& tables) {
  for (const auto& [isa, table] : tables) {
    const auto path = std::filesystem::path(folder) / (cpu_name() + "_" + isa);
    std::filesystem::create_directories(path);
    std::ofstream(path / name) << header << table;
  }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: solvers_bench OUTPUT_FOLDER [repetitions]\n");
    return 2;
  }
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  write(argv[1], "convergence.csv",
        "scene,patches,solver,sweeps_or_shots_per_patch,seconds,residual,error\n",
        {{hemicube::raster::best_kernels().name, time_convergence()}});
  write(argv[1], "progressive.csv",
        "scene,patches,solver,sweeps_or_shots,seconds,error,radiosity_hash\n",
        {{hemicube::raster::best_kernels().name, time_shooting()}});
  Tables sweeps;
  if (!time_sweeps(repetitions, &sweeps))
    return 1;
  write(argv[1], "sweep.csv",
        "matrix,patches,gigabytes,bands,threads,read_seconds,copy_seconds,sweep_seconds,"
        "read_over_sweep,sweep_gigabytes_per_second,radiosity_hash\n",
        sweeps);
  return 0;
}
