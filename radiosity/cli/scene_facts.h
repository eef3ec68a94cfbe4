#pragma once

#include "radiosity/cli/session.h"

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

  std::uint64_t sample_rows = 0; ///< hemicubes the estimates come from
  double nonzeros_per_row = 0;
  double matrix_bytes = 0; ///< of the rows the solver keeps
  double seconds = 0;      ///< for all hemicubes, on the threads of the session
};

/// Gathers the facts of a session's scene; renders some hemicubes, evenly spread over the patches.
Status gather_facts(Session* session, SceneFacts* facts);

} // namespace hemicube::radiosity::cli
