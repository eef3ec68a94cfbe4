#include "radiosity/cli/scene_facts.h"

#include "radiosity/light_model.h"

#include <algorithm>

namespace hemicube::radiosity::cli {
namespace {

Status gather_light(const LoadedScene& loaded, SceneFacts* facts) {
  const PatchSet& patches = loaded.patches;
  LightModel light;
  HC_TRY(light.init(loaded.scene, patches));
  const LightProblem problem = light.problem(patches);
  const std::uint32_t bands = light.band_count;
  std::vector<double> emitted(bands, 0.0);
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    bool emits = false;
    for (std::uint32_t b = 0; b < bands; ++b) {
      const double exitance = problem.exitance[std::size_t{i} * bands + b];
      emits = emits || exitance > 0;
      emitted[b] += patches.area[i] * exitance;
      facts->largest_reflectance =
          std::max(facts->largest_reflectance, problem.reflectance[std::size_t{i} * bands + b]);
    }
    facts->emitting_patches += emits ? 1 : 0;
    facts->black_patches += problem.is_black(i) ? 1 : 0;
    facts->area += patches.area[i];
  }
  facts->solved_band_count = bands;
  for (const std::uint32_t solved : light.solved_band) {
    facts->emitted.push_back(emitted[solved]);
    const auto first = std::find(light.solved_band.begin(), light.solved_band.end(), solved);
    facts->solved_band.push_back(static_cast<std::uint32_t>(first - light.solved_band.begin()));
  }
  return {};
}

void gather_bounds(const PatchSet& patches, SceneFacts* facts) {
  facts->low = facts->high = patches.vertices[patches.corners[0]];
  for (const std::uint32_t corner : patches.corners) {
    facts->low = glm::min(facts->low, patches.vertices[corner]);
    facts->high = glm::max(facts->high, patches.vertices[corner]);
  }
}

} // namespace

Status gather_facts(Session* session, SceneFacts* facts) {
  HC_TRY(gather_light(session->loaded, facts));
  gather_bounds(session->loaded.patches, facts);
  facts->scene_hash = hash_scene(session->loaded.scene, session->loaded.patches);
  return predict_cost(session, &facts->cost);
}

} // namespace hemicube::radiosity::cli
