#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hemicube::bench {

/// A scene that rows are timed on.
struct BenchScene {
  const char* name;
  radiosity::PatchSet (*build)();
};

/// Closed scenes of one-sided quads, small to large: cubes of 8 x 8 and 32 x 32 patches a face,
/// Cornell boxes, offices.
extern const std::vector<BenchScene> kBenchScenes;

/// Scattered receivers: about `count` patches, evenly spread over their numbers.
std::vector<std::uint32_t> scattered(const radiosity::PatchSet& patches, std::uint32_t count);

} // namespace hemicube::bench
