#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/light_problem.h"

namespace hemicube::radiosity {

/// The light of a scene, reduced to what must be solved: bands that are the same everywhere are
/// solved once.
struct LightModel {
  Buffer<std::uint32_t> solved_band; ///< [band of the scene] the band of the problem that equals it
  std::uint32_t band_count = 0;      ///< bands of the problem

  Buffer<double> reflectance, exitance; ///< [patch][band of the problem]
  Buffer<double> space_exitance;        ///< [band of the problem]
  Buffer<std::string_view> band_names;  ///< [band of the problem] views of the scene's names

  Status init(const Scene& scene, const PatchSet& patches);
  LightProblem problem(const PatchSet& patches) const noexcept;
};

/// Hash of what decides the result of a run, but for its options: geometry, materials, space.
std::uint64_t hash_scene(const Scene& scene, const PatchSet& patches) noexcept;

} // namespace hemicube::radiosity
