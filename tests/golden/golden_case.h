#pragma once

#include "radiosity/parallel/executor.h"
#include "radiosity/scene/scene.h"

#include <string>

namespace hemicube::raster {
struct Kernels;
}

namespace hemicube::radiosity::test {

/// A line of hashes.txt.
struct GoldenCase {
  std::string scene; ///< below the checkout; "+discontinuity" at the end: its patches are cut
  std::string rung;  ///< adaptive: with its target, "adaptive:0.3"
  std::uint32_t resolution = 0;
  std::string items, form_factors, radiosity; ///< 16 digits each

  std::string scene_file() const; ///< below the checkout
};

/// @param line  neither empty nor a comment
GoldenCase parse_golden_case(std::string line);

/// The line again.
std::string line_of(const GoldenCase& golden);

/// Meshes and lights the scene as the case says, and replaces the hashes. Needs the core and the
/// meshing along shadows alone.
Status compute_hashes(const Scene& scene, const raster::Kernels& kernels, Executor& executor,
                      GoldenCase* golden);

} // namespace hemicube::radiosity::test
