#include "radiosity/light_model.h"

#include "radiosity/form_factor/matrix_file.h"
#include "raster/hash.h"

namespace hemicube::radiosity {
namespace {

bool same_band(const Scene& scene, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t bands = scene.band_count();
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
    if (scene.reflectance[m * bands + a] != scene.reflectance[m * bands + b] ||
        scene.exitance[m * bands + a] != scene.exitance[m * bands + b])
      return false;
  return scene.space_exitance[a] == scene.space_exitance[b];
}

} // namespace

Status LightModel::init(const Scene& scene, const PatchSet& patches) {
  const std::uint32_t bands = scene.band_count();
  Buffer<std::uint32_t>
      representative; // [band of the problem] first band of the scene that it stands for
  HC_TRY(solved_band.resize(bands));
  space_exitance.clear();
  band_names.clear();
  for (std::uint32_t b = 0; b < bands; ++b) {
    std::uint32_t k = 0;
    while (k < representative.size() && !same_band(scene, b, representative[k]))
      ++k;
    solved_band[b] = k;
    if (k == representative.size()) {
      HC_TRY(representative.push_back(b));
      HC_TRY(space_exitance.push_back(scene.space_exitance[b]));
      HC_TRY(band_names.push_back(scene.bands[b]));
    }
  }
  band_count = static_cast<std::uint32_t>(representative.size());

  const std::size_t count = std::size_t{patches.patch_count()} * band_count;
  HC_TRY(reflectance.resize(count));
  HC_TRY(exitance.resize(count));
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    for (std::uint32_t k = 0; k < band_count; ++k) {
      const std::size_t from = std::size_t{patches.material[i]} * bands + representative[k];
      const std::size_t to = std::size_t{i} * band_count + k;
      reflectance[to] = scene.reflectance[from];
      exitance[to] = scene.exitance[from];
    }
  return {};
}

LightProblem LightModel::problem(const PatchSet& patches) const noexcept {
  return {band_count,      patches.area.span(),   reflectance.span(),
          exitance.span(), space_exitance.span(), band_names.span()};
}

std::uint64_t hash_scene(const Scene& scene, const PatchSet& patches) noexcept {
  Hash hash(patches.patch_count());
  const std::uint32_t bands = scene.band_count();
  hash.add(bands);
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    hash_corners(patches, i, &hash);
    for (std::uint32_t b = 0; b < bands; ++b) {
      hash.add(scene.reflectance[std::size_t{patches.material[i]} * bands + b]);
      hash.add(scene.exitance[std::size_t{patches.material[i]} * bands + b]);
    }
  }
  for (const double exitance : scene.space_exitance)
    hash.add(exitance);
  return hash.value();
}

} // namespace hemicube::radiosity
