// Writes an office (tests/support/office.h) as a scene file for the program: office_obj ROOMS_X
// ROOMS_Y STOREYS CELL FILE.obj, CELL in metres. FILE.mtl goes beside it.

#include "radiosity/output/file_set.h"
#include "radiosity/output/number_text.h"
#include "tests/support/office.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace hemicube;
using radiosity::append_number;

std::string materials_text(const radiosity::Scene& scene) {
  std::string text;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    text += "newmtl " + std::string(scene.materials[m]) + '\n';
    for (const auto& [key, values] :
         {std::pair("Kd", &scene.reflectance), {"Ke", &scene.exitance}}) {
      text += key;
      for (std::uint32_t b = 0; b < 3; ++b) {
        text += ' ';
        append_number(&text, (*values)[m * scene.band_count() + (b < scene.band_count() ? b : 0)]);
      }
      text += '\n';
    }
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

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: office_obj ROOMS_X ROOMS_Y STOREYS CELL FILE.obj\n");
    return 2;
  }
  const radiosity::Scene scene = test::office(
      {std::atoi(argv[1]), std::atoi(argv[2]), std::atoi(argv[3]), std::strtod(argv[4], nullptr)});
  radiosity::FileSet files;
  std::string name;
  test::require(files.begin_file(argv[5], &name));
  const std::string library = name.substr(0, name.rfind('.')) + ".mtl";
  test::require(files.add(name, faces_text(scene, library)));
  test::require(files.add(library, materials_text(scene)));
  test::require(files.commit());
  return 0;
}
