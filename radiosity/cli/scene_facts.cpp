#include "radiosity/cli/scene_facts.h"

#include "radiosity/light_model.h"

#include <algorithm>

namespace hemicube::radiosity::cli {
namespace {

constexpr std::uint64_t kSampleRows = 16;

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

Status estimate_cost(Session* session, SceneFacts* facts) {
  const std::uint64_t count = session->loaded.patches.patch_count();
  std::vector<std::uint32_t> rows;
  for (std::uint64_t k = 0; k < std::min(count, kSampleRows); ++k)
    rows.push_back(static_cast<std::uint32_t>(k * count / std::min(count, kSampleRows)));
  FormFactorMatrix matrix;
  Certificate certificate;
  HC_TRY(session->form_factors(rows, &matrix, &certificate));
  const double sampled = static_cast<double>(rows.size());
  facts->sample_rows = rows.size();
  facts->nonzeros_per_row = static_cast<double>(certificate.nonzeros) / sampled;
  facts->matrix_bytes = static_cast<double>(count - facts->black_patches) *
                        facts->nonzeros_per_row * (sizeof(std::uint32_t) + sizeof(float));
  // The sample is one block of rows, and so the work of one thread.
  facts->seconds = session->run.form_factor_seconds / sampled * static_cast<double>(count) /
                   static_cast<double>(session->run.threads);
  return {};
}

} // namespace

Status gather_facts(Session* session, SceneFacts* facts) {
  HC_TRY(gather_light(session->loaded, facts));
  gather_bounds(session->loaded.patches, facts);
  facts->scene_hash = hash_scene(session->loaded.scene, session->loaded.patches);
  return estimate_cost(session, facts);
}

} // namespace hemicube::radiosity::cli
