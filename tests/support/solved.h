#pragma once

#include "radiosity/radiosity.h"
#include "tests/support/scenes_shared.h"

#include <string>
#include <vector>

namespace hemicube::test {

/// A scene with its mesh and its solution.
struct Solved {
  PatchSet patches;
  radiosity::Solution solution;
  radiosity::Certificate certificate;

  double radiosity(std::uint32_t patch, std::uint32_t band) const {
    return solution.radiosity[static_cast<std::size_t>(patch) * solution.band_count + band];
  }
};

/// Meshes and solves a scene. Throws std::runtime_error with the status' message on any failure.
/// @param threads  of a ThreadPool; 0 = all cores
Solved solve(const Scene& scene, const radiosity::Options& options, std::uint32_t threads = 0);

/// All rows of form factors of a mesh; throws on any failure.
struct FormFactors {
  radiosity::FormFactorMatrix matrix;
  radiosity::Certificate certificate;

  /// Row i with a value for every patch, 0 where there is none.
  std::vector<double> dense_row(std::uint64_t i) const;
};
void compute_all(const PatchSet& patches, const radiosity::Options& options, std::uint32_t threads,
                 FormFactors* result);

/// Bit for bit, also where a value is NaN.
bool same_bits(std::span<const double> a, std::span<const double> b);
bool same_bits(const radiosity::FormFactorMatrix& a, const radiosity::FormFactorMatrix& b);

} // namespace hemicube::test
