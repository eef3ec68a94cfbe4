#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/solve/light_problem.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hemicube::bench {

/// Lines of a CSV by the folder of results/ they go into.
using Tables = std::map<std::string, std::string>;

/// Seconds between calls.
class Stopwatch {
public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The light of a scene that a matrix is solved for.
struct Light {
  std::uint32_t bands = 0;
  std::vector<double> area, reflectance, exitance, space_exitance;

  radiosity::LightProblem problem() const {
    return {bands, area, reflectance, exitance, space_exitance};
  }
};

/// A matrix larger than any cache, as a scene of many rooms would have it: rows made of runs of
/// neighbouring columns, 1 to 128 long, and 64 rows of a wall that see nearly the same; the same on
/// every machine. All rows are closed.
/// @param row_nonzeros  about so many entries a row
void make_long_matrix(std::uint32_t patches, std::uint32_t row_nonzeros,
                      radiosity::Executor& executor, radiosity::FormFactorMatrix* matrix);

/// All rows of the Cornell box of scenes/, cut into so many patches, on rung hemicube.
void make_cornell_matrix(double max_edge, radiosity::Executor& executor,
                         radiosity::FormFactorMatrix* matrix, std::vector<double>* area);

std::uint64_t hash_of(const Buffer<double>& values);

/// The table of sweeps against plain reading. @return false if hashes differ
bool time_sweeps(int repetitions, Tables* tables);

/// The error after so many sweeps and shots on a stored matrix, and what they took: lines of
/// convergence.csv.
std::string time_convergence();

/// The error of progressive refinement without a matrix after so many shots, and of Gauss-Seidel,
/// against time, rows included: lines of progressive.csv.
std::string time_shooting();

} // namespace hemicube::bench
