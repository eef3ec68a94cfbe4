#include "tests/fuzz/target.h"

namespace hemicube::test {

std::span<const FuzzTarget> fuzz_targets() {
  static const FuzzTarget kTargets[] = {
      {"obj", judge_obj, true, 2048, 2000},          {"mtl", judge_mtl, true, 1024, 2000},
      {"json", judge_json, true, 2048, 2000},        {"ply", judge_ply, true, 1024, 2000},
      {"off", judge_off, true, 1024, 2000},          {"stl", judge_stl, true, 1024, 2000},
      {"gltf", judge_gltf, true, 4096, 1000},        {"glb", judge_glb, true, 4096, 1000},
      {"hcf", judge_hcf, true, 2048, 2000},          {"raster", judge_raster, false, 2048, 400},
      {"exchange", judge_exchange, false, 128, 500}, {"union", judge_union, false, 256, 500},
      {"rungs", judge_rungs, false, 256, 100},       {"light", judge_light, false, 256, 500},
  };
  return kTargets;
}

} // namespace hemicube::test
