#include "radiosity/scene/gltf_material.h"

#include <cmath>
#include <set>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;

class MaterialReader {
public:
  MaterialReader(const JsonFields& fields, ReadReport* report)
      : fields_(fields), report_(*report) {}

  Status read(const JsonValue& value, std::size_t index, SceneMaterial* material);
  void count_skipped();

private:
  Status name(const JsonValue& value, const std::string& what, std::size_t index,
              std::string* name);
  Status reflectance(const JsonValue& value, const std::string& what, SceneMaterial* material);
  Status exitance(const JsonValue& value, const std::string& what, SceneMaterial* material);
  Status extensions(const JsonValue& value, const std::string& what, double* strength);

  const JsonFields& fields_;
  ReadReport& report_;
  std::set<std::string> names_;
  KeywordCounts textures_, extensions_;
};

Status MaterialReader::read(const JsonValue& value, std::size_t index, SceneMaterial* material) {
  const std::string what = "materials[" + std::to_string(index) + "]";
  HC_TRY(fields_.kind(value, what, Kind::kObject));
  HC_TRY(name(value, what, index, &material->name));
  material->file = fields_.path();
  material->line = value.line;
  HC_TRY(reflectance(value, what, material));
  HC_TRY(exitance(value, what, material));
  if (const JsonValue* sides = value.find("doubleSided"))
    HC_TRY(fields_.boolean(*sides, what + ".doubleSided", &material->two_sided));
  for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"})
    if (value.find(texture) != nullptr)
      textures_.count(texture);
  if (const JsonValue* alpha = value.find("alphaMode")) {
    HC_TRY(fields_.kind(*alpha, what + ".alphaMode", Kind::kString));
    if (alpha->text != "OPAQUE")
      ++report_.skipped["transparency (alphaMode)"];
  }
  return {};
}

Status MaterialReader::name(const JsonValue& value, const std::string& what, std::size_t index,
                            std::string* name) {
  const JsonValue* given = value.find("name");
  if (given != nullptr) {
    HC_TRY(fields_.kind(*given, what + ".name", Kind::kString));
    *name = given->text;
  }
  if (name->empty())
    *name = "material_" + std::to_string(index);
  HC_TRY(fields_.check_name(value, what + ".name", *name));
  while (!names_.insert(*name).second)
    *name += "_" + std::to_string(index);
  return {};
}

Status MaterialReader::reflectance(const JsonValue& value, const std::string& what,
                                   SceneMaterial* material) {
  material->reflectance.assign(3, 1.0); // as glTF says
  const JsonValue* model = value.find("pbrMetallicRoughness");
  if (model == nullptr)
    return {};
  const std::string model_what = what + ".pbrMetallicRoughness";
  HC_TRY(fields_.kind(*model, model_what, Kind::kObject));
  for (const char* texture : {"baseColorTexture", "metallicRoughnessTexture"})
    if (model->find(texture) != nullptr)
      textures_.count(texture);
  const JsonValue* factor = model->find("baseColorFactor");
  if (factor == nullptr)
    return {};
  const std::string factor_what = model_what + ".baseColorFactor";
  std::vector<double> rgba;
  HC_TRY(fields_.numbers(*factor, factor_what, 4, &rgba));
  rgba.resize(3);
  for (const double band : rgba)
    if (!(band >= 0 && band <= 1))
      return fields_.error(*factor, factor_what, ": ", band, " is outside [0, 1]");
  material->reflectance = rgba;
  return {};
}

Status MaterialReader::exitance(const JsonValue& value, const std::string& what,
                                SceneMaterial* material) {
  material->exitance.assign(3, 0.0);
  double strength = 1;
  HC_TRY(extensions(value, what, &strength));
  const JsonValue* factor = value.find("emissiveFactor");
  if (factor == nullptr)
    return {};
  const std::string factor_what = what + ".emissiveFactor";
  HC_TRY(fields_.numbers(*factor, factor_what, 3, &material->exitance));
  for (double& band : material->exitance) {
    if (band < 0)
      return fields_.error(*factor, factor_what, ": ", band, " is negative");
    const double exitance_of_band = band * strength;
    if (!std::isfinite(exitance_of_band))
      return fields_.error(*factor, factor_what, ": ", band, " times the emissive strength ",
                           strength, " is too large");
    band = exitance_of_band;
  }
  return {};
}

Status MaterialReader::extensions(const JsonValue& value, const std::string& what,
                                  double* strength) {
  const JsonValue* all = value.find("extensions");
  if (all == nullptr)
    return {};
  HC_TRY(fields_.kind(*all, what + ".extensions", Kind::kObject));
  for (const std::string& key : all->keys)
    if (key != kGltfEmissiveStrength)
      extensions_.count(key);
  const JsonValue* extension = all->find(kGltfEmissiveStrength);
  if (extension == nullptr)
    return {};
  const std::string extension_what = what + ".extensions." + std::string(kGltfEmissiveStrength);
  HC_TRY(fields_.kind(*extension, extension_what, Kind::kObject));
  const JsonValue* number = extension->find("emissiveStrength");
  if (number == nullptr)
    return {};
  HC_TRY(fields_.number(*number, extension_what + ".emissiveStrength", strength));
  return *strength >= 0 ? Status()
                        : fields_.error(*number, extension_what, ".emissiveStrength: ", *strength,
                                        " is negative");
}

void MaterialReader::count_skipped() {
  textures_.add_to(&report_, [](std::string_view) -> std::string_view { return "textures"; });
  extensions_.add_to(&report_,
                     [](std::string_view) -> std::string_view { return "material extensions"; });
}

} // namespace

Status read_gltf_materials(const GltfFile& file, std::vector<SceneMaterial>* materials,
                           ReadReport* report) {
  std::size_t count = 0;
  HC_TRY(file.count("materials", &count));
  MaterialReader reader(file.fields(), report);
  for (std::size_t i = 0; i < count; ++i)
    HC_TRY(reader.read(file.root().find("materials")->items[i], i, &materials->emplace_back()));
  reader.count_skipped();
  return {};
}

} // namespace hemicube::radiosity
