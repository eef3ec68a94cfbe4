#pragma once

#include "radiosity/radiosity.h"

namespace hemicube::radiosity::cli {

/// How the memory of a run is shared out.
struct MemoryPlan {
  std::uint64_t most_rows = 0; ///< of form factors in memory; beyond it they stay in a file
  std::uint64_t row_range = 0; ///< of rows read at once from there
};

/// What a run takes besides the rows of its form factors: the scene, the mesh, the rasterizer's
/// tree, scratch memory of threads, vectors of the solver, what is written.
std::uint64_t other_memory(std::uint64_t patches, std::uint32_t bands, std::uint64_t threads);

/// Shares out a budget.
/// @param budget  bytes; 0: most of the memory of this machine
/// @return kOutOfMemory, with what is needed, if there is not enough for anything
Status plan_memory(std::uint64_t budget, std::uint64_t patches, std::uint32_t bands,
                   std::uint64_t threads, MemoryPlan* plan);

} // namespace hemicube::radiosity::cli
