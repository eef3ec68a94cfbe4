#include "bench/bench_scenes.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "radiosity/scene/read_scene.h"
#include "tests/support/office.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>

namespace hemicube::bench {
namespace {

using radiosity::PatchSet;
using test::require;

/// The Cornell box of scenes/, cut to a maximum edge length.
PatchSet cornell(double max_edge) {
  radiosity::Scene scene;
  radiosity::ReadReport read;
  radiosity::MeshReport mesh;
  PatchSet coarse, fine;
  require(radiosity::read_scene(HC_SOURCE_DIR "/scenes/cornell.obj", &scene, &read));
  require(radiosity::build_patches(scene, &coarse, &mesh));
  const std::vector<double> limits(coarse.patch_count(), max_edge);
  require(radiosity::subdivide(coarse, limits, &fine, &mesh));
  return fine;
}

PatchSet office(const test::OfficePlan& plan) {
  return test::patches_of(test::office(plan));
}

} // namespace

const std::vector<BenchScene> kBenchScenes = {
    {"cube8", [] { return test::patches_of(test::furnace_cube(8, 0.5, 1)); }},
    {"cube32", [] { return test::patches_of(test::furnace_cube(32, 0.5, 1)); }},
    {"cornell1k", [] { return cornell(0.066); }},
    {"cornell10k", [] { return cornell(0.02); }},
    {"office10k",
     [] {
       return office({3, 3, 1, 0.5});
     }},
    {"office100k",
     [] {
       return office({4, 4, 2, 0.255});
     }},
    {"office485k",
     [] {
       return office({4, 4, 10, 0.255});
     }},
};

std::vector<std::uint32_t> scattered(const PatchSet& patches, std::uint32_t count) {
  std::vector<std::uint32_t> rows;
  const std::uint64_t n = patches.patch_count();
  for (std::uint64_t k = 0; k < std::min<std::uint64_t>(count, n); ++k)
    rows.push_back(static_cast<std::uint32_t>(k * n / std::min<std::uint64_t>(count, n)));
  return rows;
}

} // namespace hemicube::bench
