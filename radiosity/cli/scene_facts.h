#pragma once

#include "radiosity/cli/run_cost.h"

#include <string>
#include <vector>

namespace hemicube::radiosity::cli {

/// What would be modelled of a scene, and what it would cost.
struct SceneFacts {
  std::uint64_t black_patches = 0; ///< reflect nothing in any band: no row in the sweep
  std::uint64_t emitting_patches = 0;
  double area = 0;                        ///< of all patches, m^2
  std::vector<double> emitted;            ///< [band] W
  std::vector<std::uint32_t> solved_band; ///< [band] the first band that is the same everywhere
  std::uint32_t solved_band_count = 0;
  double largest_reflectance = 0;
  Vec3 low{0, 0, 0}, high{0, 0, 0}; ///< bounding box of the patches
  std::uint64_t scene_hash = 0;

  RunCost cost;
};

/// Gathers the facts of a session's scene; computes some rows, evenly spread over the patches.
Status gather_facts(Session* session, SceneFacts* facts);

} // namespace hemicube::radiosity::cli
