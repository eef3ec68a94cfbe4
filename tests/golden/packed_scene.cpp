#include "tests/golden/packed_scene.h"

#include <bit>
#include <string>

namespace hemicube::radiosity::test {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T> bool write_values(const Buffer<T>& values, std::FILE* file) {
  const std::uint64_t count = values.size();
  return std::fwrite(&count, sizeof count, 1, file) == 1 &&
         std::fwrite(values.data(), sizeof(T), values.size(), file) == values.size();
}

template <typename T> bool read_values(std::FILE* file, Buffer<T>* values) {
  std::uint64_t count = 0;
  return std::fread(&count, sizeof count, 1, file) == 1 &&
         values->resize(static_cast<std::size_t>(count)).ok() &&
         std::fread(values->data(), sizeof(T), values->size(), file) == values->size();
}

/// Names by their number: light does not depend on what they are.
bool write_names(const NameTable& names, std::FILE* file) {
  const std::uint32_t count = names.size();
  return std::fwrite(&count, sizeof count, 1, file) == 1;
}

bool read_names(std::FILE* file, NameTable* names) {
  std::uint32_t count = 0;
  if (std::fread(&count, sizeof count, 1, file) != 1)
    return false;
  for (std::uint32_t k = 0; k < count; ++k)
    if (!names->add(std::to_string(k)).ok())
      return false;
  return true;
}

/// All parts of a scene in the order they are written, until `names` or `values` returns false.
template <typename AnyScene, typename Names, typename Values>
bool each_part(AnyScene& scene, Names names, Values values) {
  return names(scene.bands) && names(scene.materials) && names(scene.groups) &&
         values(scene.reflectance) && values(scene.exitance) && values(scene.two_sided) &&
         values(scene.space_exitance) && values(scene.vertices) && values(scene.corner_offsets) &&
         values(scene.corners) && values(scene.face_material) && values(scene.face_group) &&
         values(scene.face_max_edge);
}

} // namespace

bool write_packed_scene(const Scene& scene, std::FILE* file) {
  return each_part(
      scene, [=](const NameTable& names) { return write_names(names, file); },
      [=](const auto& values) { return write_values(values, file); });
}

bool read_packed_scene(std::FILE* file, Scene* scene) {
  *scene = {};
  return each_part(
      *scene, [=](NameTable& names) { return read_names(file, &names); },
      [=](auto& values) { return read_values(file, &values); });
}

} // namespace hemicube::radiosity::test
