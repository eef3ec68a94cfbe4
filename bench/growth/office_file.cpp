#include "bench/growth/office_file.h"

#include "radiosity/output/file_set.h"
#include "radiosity/output/number_text.h"

namespace hemicube::bench {
namespace {

using radiosity::append_number;

std::string materials_text(const radiosity::Scene& scene) {
  std::string text;
  const auto add = [&](const char* key, const Buffer<double>& values, std::uint32_t material) {
    text += key;
    for (std::uint32_t b = 0; b < 3; ++b) {
      text += ' ';
      append_number(&text, values[material * scene.band_count() + b % scene.band_count()]);
    }
    text += '\n';
  };
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    text += "newmtl " + std::string(scene.materials[m]) + '\n';
    add("Kd", scene.reflectance, m);
    add("Ke", scene.exitance, m);
  }
  return text;
}

std::string faces_text(const radiosity::Scene& scene, const std::string& library) {
  std::string text = "mtllib " + library + '\n';
  for (const Vec3& v : scene.vertices) {
    text += 'v';
    for (const double x : {v.x, v.y, v.z}) {
      text += ' ';
      append_number(&text, x);
    }
    text += '\n';
  }
  std::uint32_t material = ~0u;
  for (std::size_t f = 0; f < scene.face_count(); ++f) {
    if (scene.face_material[f] != material) {
      material = scene.face_material[f];
      const std::string name(scene.materials[material]);
      text += "g " + name + "\nusemtl " + name + '\n';
    }
    text += 'f';
    for (std::uint64_t c = scene.corner_offsets[f]; c < scene.corner_offsets[f + 1]; ++c) {
      text += ' ';
      append_number(&text, std::uint64_t{scene.corners[c]} + 1);
    }
    text += '\n';
  }
  return text;
}

} // namespace

void write_office(const test::OfficePlan& plan, const std::string& path) {
  const radiosity::Scene scene = test::office(plan);
  radiosity::FileSet files;
  std::string name;
  test::require(files.begin_file(path, &name));
  const std::string library = name.substr(0, name.rfind('.')) + ".mtl";
  test::require(files.add(name, faces_text(scene, library)));
  test::require(files.add(library, materials_text(scene)));
  test::require(files.commit());
}

} // namespace hemicube::bench
