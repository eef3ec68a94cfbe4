#include "radiosity/output/patch_table.h"

#include "radiosity/output/csv_reader.h"
#include "radiosity/output/number_text.h"

#include <array>
#include <charconv>
#include <limits>
#include <vector>

namespace hemicube::radiosity {
namespace {

constexpr std::array<const char*, 11> kPatchColumns = {
    "patch", "face", "parent", "material", "area", "cx", "cy", "cz", "nx", "ny", "nz"};
constexpr std::array<const char*, 4> kBandColumns = {"reflectance_", "exitance_", "irradiance_",
                                                     "radiosity_"};
constexpr std::size_t kMaterialColumn = 3, kAreaColumn = 4, kReflectance = 0, kIrradiance = 2;

std::vector<std::string> column_names(const Scene& scene) {
  std::vector<std::string> names(kPatchColumns.begin(), kPatchColumns.end());
  for (std::uint32_t band = 0; band < scene.band_count(); ++band)
    for (const char* column : kBandColumns)
      names.push_back(std::string(column).append(scene.bands[band]));
  return names;
}

std::array<double, 7> measures(const PatchSet& patches, std::uint32_t patch) {
  const Vec3 c = patches.centre[patch], n = patches.normal[patch];
  return {patches.area[patch], c.x, c.y, c.z, n.x, n.y, n.z};
}

/// Checks records of a table against the mesh and takes their light.
class PatchTableReader {
public:
  PatchTableReader(std::string_view text, const std::string& file, const Scene& scene,
                   const PatchSet& patches)
      : csv_(text), file_(file), scene_(scene), patches_(patches), names_(column_names(scene)) {}

  Status read(Solution* solution) {
    solution->band_count = scene_.band_count();
    HC_TRY(read_header());
    for (std::uint32_t patch = 0; patch < patches_.patch_count(); ++patch) {
      if (!csv_.next(&fields_))
        return Status::error(StatusCode::kBadScene, file_, ": ends after ", patch,
                             " patches, the scene has ", patches_.patch_count(), kAdvice);
      if (fields_.size() != names_.size())
        return error("has ", fields_.size(), " fields instead of ", names_.size());
      HC_TRY(check_patch(patch));
      HC_TRY(take_light(solution));
    }
    if (csv_.next(&fields_))
      return error("more patches than the ", patches_.patch_count(), " of the scene");
    return {};
  }

private:
  static constexpr const char* kAdvice =
      "; give the scene and the mesh options that this solution was made with";

  template <typename... Parts> Status error(const Parts&... parts) const {
    return Status::error(StatusCode::kBadScene, file_, ":", csv_.line(), ": ", parts..., kAdvice);
  }

  Status read_header() {
    if (!csv_.next(&fields_))
      return Status::error(StatusCode::kBadScene, file_, ":1: the table is empty", kAdvice);
    for (std::size_t i = 0; i < names_.size() || i < fields_.size(); ++i) {
      const std::string found = i < fields_.size() ? fields_[i] : "nothing";
      if (i >= names_.size())
        return error("unexpected column '", found, "'");
      if (i >= fields_.size() || found != names_[i])
        return error("column ", i + 1, " is '", found, "' instead of '", names_[i], "'");
    }
    return {};
  }

  /// An empty field is NaN.
  Status number(std::size_t column, double* value) const {
    const std::string& field = fields_[column];
    *value = std::numeric_limits<double>::quiet_NaN();
    if (field.empty())
      return {};
    const char* end = field.data() + field.size();
    const auto [stopped, code] = std::from_chars(field.data(), end, *value);
    if (code != std::errc() || stopped != end)
      return error(names_[column], " is '", field, "', not a number");
    return {};
  }

  Status expect(std::size_t column, double expected) const {
    double value;
    HC_TRY(number(column, &value));
    if (value == expected)
      return {};
    return error(names_[column], " is '", fields_[column], "', in the scene it is ", expected);
  }

  Status check_patch(std::uint32_t patch) const {
    HC_TRY(expect(0, patch));
    HC_TRY(expect(1, patches_.face[patch]));
    HC_TRY(expect(2, patches_.parent[patch]));
    const std::string_view material = scene_.materials[patches_.material[patch]];
    if (fields_[kMaterialColumn] != material)
      return error("material is '", fields_[kMaterialColumn], "', in the scene it is '", material,
                   "'");
    std::size_t column = kAreaColumn;
    for (const double expected : measures(patches_, patch))
      HC_TRY(expect(column++, expected));
    return {};
  }

  Status take_light(Solution* solution) const {
    std::size_t column = kPatchColumns.size();
    for (std::uint32_t band = 0; band < scene_.band_count(); ++band) {
      std::array<double, kBandColumns.size()> light;
      for (std::size_t k = 0; k < light.size(); ++k, ++column) {
        HC_TRY(number(column, &light[k]));
        const bool in_range =
            light[k] >= 0 &&
            light[k] <= (k == kReflectance ? 1.0 : std::numeric_limits<double>::max());
        if (!in_range && !(k == kIrradiance && fields_[column].empty()))
          return error(names_[column], " is '", fields_[column], "', which is out of range");
      }
      HC_TRY(solution->reflectance.push_back(light[0]));
      HC_TRY(solution->exitance.push_back(light[1]));
      HC_TRY(solution->irradiance.push_back(light[2]));
      HC_TRY(solution->radiosity.push_back(light[3]));
    }
    return {};
  }

  CsvReader csv_;
  const std::string& file_;
  const Scene& scene_;
  const PatchSet& patches_;
  const std::vector<std::string> names_;
  std::vector<std::string> fields_;
};

} // namespace

std::string patch_table(const Scene& scene, const PatchSet& patches, const Solution& solution) {
  std::string text;
  for (const std::string& name : column_names(scene)) {
    append_csv_text(&text, name);
    text += ',';
  }
  text.back() = '\n';

  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    for (const std::uint32_t id : {patch, patches.face[patch], patches.parent[patch]}) {
      append_number(&text, id);
      text += ',';
    }
    append_csv_text(&text, scene.materials[patches.material[patch]]);
    for (const double measure : measures(patches, patch)) {
      text += ',';
      append_number(&text, measure);
    }
    for (std::uint32_t band = 0; band < solution.band_count; ++band) {
      const std::size_t at = std::size_t{patch} * solution.band_count + band;
      for (const auto* values :
           {&solution.reflectance, &solution.exitance, &solution.irradiance, &solution.radiosity}) {
        text += ',';
        append_csv_number(&text, (*values)[at]);
      }
    }
    text += '\n';
  }
  return text;
}

Status read_patch_table(std::string_view text, const std::string& file, const Scene& scene,
                        const PatchSet& patches, Solution* solution) {
  *solution = Solution{};
  return PatchTableReader(text, file, scene, patches).read(solution);
}

} // namespace hemicube::radiosity
