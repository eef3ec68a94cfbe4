#pragma once

#include "radiosity/radiosity.h"
#include "radiosity/refine/element_tree.h"

namespace hemicube::radiosity {

/// How far adaptive meshing goes.
struct Refinement {
  /// Elements across which radiosity varies more are cut (refine/variation.h): relative to the mean
  /// radiosity of all that reflects, without what it emits, per band.
  double variation = 0.2;
  double min_edge = 0; ///< metres; no cut leaves a shorter edge. 0 = chosen: an 8th of the root of
                       ///< the mean area of the patches
  std::uint64_t max_elements = 20000;
};

/// Why no more was cut.
enum class RefinementEnd : std::uint8_t {
  kVariation,  ///< it is below what was asked for everywhere
  kMinEdge,    ///< where it is not, elements are as small as they may be
  kMaxElements ///< there are as many as there may be
};
const char* refinement_end_name(RefinementEnd end) noexcept;

struct RefinementReport {
  Refinement limits; ///< min_edge as it was chosen
  std::uint64_t patches = 0, elements = 0;
  std::uint64_t rounds = 0;        ///< of cutting, the first solution not counted
  std::uint64_t rows_gathered = 0; ///< of patches and elements that were cut later, too
  double largest_variation = 0;    ///< of the elements there are
  RefinementEnd end = RefinementEnd::kVariation;
};

/// Computes light on elements that follow it (Cohen, Greenberg, Immel and Brock 1986): solves with
/// the patches, cuts them where radiosity varies, gathers the rows of the new elements over the
/// patches, and so on. Item buffers show whole patches only: no T-vertex is ever rendered for a
/// row.
/// @param patches      the mesh to begin with, backs included
/// @param options      rung and resolution left open are chosen once, for the patches, no lower
///                     than area and 256; `files` and kProgressive do not apply
/// @param tree         receives how the patches were cut
/// @param elements     receives the mesh that the solution is for; parent = patch
/// @return as solve_scene, and kInvalidArgument for limits that make no sense
/// Deterministic, as solve_scene. Where nothing is cut, the result is that of solve_scene.
Status solve_adaptive(const Scene& scene, const PatchSet& patches, const Refinement& refinement,
                      const Options& options, Executor& executor, Progress* progress,
                      ElementTree* tree, PatchSet* elements, Solution* solution,
                      Certificate* certificate, RefinementReport* report);

} // namespace hemicube::radiosity
