#include "radiosity/output/group_table.h"

#include "radiosity/output/number_text.h"

#include <map>
#include <vector>

namespace hemicube::radiosity {
namespace {

struct Power {
  double emitted = 0, absorbed = 0, received = 0; ///< W
};

struct Group {
  std::uint32_t group = 0, material = 0;
  std::uint64_t patches = 0;
  double area = 0;
  std::vector<Power> power; ///< [band]
};

std::vector<Group> sum_groups(const PatchSet& patches, const Solution& solution) {
  std::vector<Group> groups;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> index;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const std::pair key{patches.group[patch], patches.material[patch]};
    const auto [found, is_new] = index.try_emplace(key, groups.size());
    if (is_new)
      groups.push_back({key.first, key.second, 0, 0, std::vector<Power>(solution.band_count)});
    Group& group = groups[found->second];
    const double area = patches.area[patch];
    ++group.patches;
    group.area += area;
    for (std::uint32_t band = 0; band < solution.band_count; ++band) {
      const std::size_t at = std::size_t{patch} * solution.band_count + band;
      Power& power = group.power[band];
      power.emitted += area * solution.exitance[at];
      power.absorbed += area * (1 - solution.reflectance[at]) * solution.irradiance[at];
      power.received += area * solution.irradiance[at];
    }
  }
  return groups;
}

} // namespace

std::string group_table(const Scene& scene, const PatchSet& patches, const Solution& solution) {
  std::string text = "group,material,patches,area";
  for (std::uint32_t band = 0; band < solution.band_count; ++band)
    for (const char* column : {"emitted_", "absorbed_", "received_"}) {
      text += ',';
      append_csv_text(&text, std::string(column).append(scene.bands[band]));
    }
  text += '\n';

  for (const Group& group : sum_groups(patches, solution)) {
    append_csv_text(&text, scene.groups[group.group]);
    text += ',';
    append_csv_text(&text, scene.materials[group.material]);
    text += ',';
    append_number(&text, group.patches);
    text += ',';
    append_number(&text, group.area);
    for (const Power& power : group.power)
      for (const double value : {power.emitted, power.absorbed, power.received}) {
        text += ',';
        append_csv_number(&text, value);
      }
    text += '\n';
  }
  return text;
}

} // namespace hemicube::radiosity
