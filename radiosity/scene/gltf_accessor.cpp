#include "radiosity/scene/gltf_accessor.h"

#include "radiosity/scene/file_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;

enum class Component { kInt8, kUint8, kInt16, kUint16, kUint32, kFloat32 };

struct ComponentType {
  double number; ///< in the file
  Component component;
  std::size_t size;
  double largest; ///< what a normalised integer of this value stands for 1
};

constexpr ComponentType kComponentTypes[] = {
    {5120, Component::kInt8, 1, 127},    {5121, Component::kUint8, 1, 255},
    {5122, Component::kInt16, 2, 32767}, {5123, Component::kUint16, 2, 65535},
    {5125, Component::kUint32, 4, 0},    {5126, Component::kFloat32, 4, 0}};

/// Where the elements of an accessor are.
struct Elements {
  const ComponentType* type = nullptr;
  bool is_normalized = false;
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  const char* first = nullptr; ///< all elements are within their buffer view
};

double load(const ComponentType& type, const char* at) {
  std::uint32_t bits = 0;
  for (std::size_t k = type.size; k-- > 0;)
    bits = bits << 8 | static_cast<unsigned char>(at[k]);
  switch (type.component) {
  case Component::kInt8:
    return static_cast<std::int8_t>(bits);
  case Component::kInt16:
    return static_cast<std::int16_t>(bits);
  case Component::kFloat32:
    return static_cast<double>(std::bit_cast<float>(bits));
  default:
    return bits;
  }
}

/// A member that is a whole number, or a default.
Status optional_number(const GltfFile& file, const JsonValue& value, const std::string& what,
                       const char* key, std::uint64_t* number) {
  const JsonValue* member = value.find(key);
  return member == nullptr ? Status() : file.whole_number(*member, what + "." + key, number);
}

/// The bytes of a buffer view, and the distance of its elements; 0 where it says none.
Status read_view(GltfFile* file, const JsonValue& reference, const std::string& reference_what,
                 std::string_view* bytes, std::uint64_t* stride) {
  GltfFile::Item view, buffer;
  HC_TRY(file->follow(reference, reference_what, "bufferViews", &view));
  const JsonValue *buffer_index = nullptr, *length_value = nullptr;
  HC_TRY(file->required(*view.value, view.what, "buffer", &buffer_index));
  HC_TRY(file->required(*view.value, view.what, "byteLength", &length_value));
  HC_TRY(file->follow(*buffer_index, view.what + ".buffer", "buffers", &buffer));
  std::uint64_t offset = 0, length = 0;
  HC_TRY(optional_number(*file, *view.value, view.what, "byteOffset", &offset));
  HC_TRY(optional_number(*file, *view.value, view.what, "byteStride", stride));
  HC_TRY(file->whole_number(*length_value, view.what + ".byteLength", &length));
  if (*stride > 252)
    return file->fields().error(*view.value, view.what, ".byteStride: ", *stride,
                                " is more than 252");
  HC_TRY(file->buffer(buffer, bytes));
  if (offset > bytes->size() || length > bytes->size() - offset)
    return file->fields().error(*view.value, view.what, ": bytes ", offset, " to ", offset + length,
                                " of ", buffer.what, ", which has ", bytes->size());
  *bytes = bytes->substr(offset, length);
  return {};
}

Status component_type(const GltfFile& file, const JsonValue& accessor, const std::string& what,
                      const ComponentType** type) {
  const JsonValue* value = nullptr;
  HC_TRY(file.required(accessor, what, "componentType", &value));
  double number = 0;
  HC_TRY(file.fields().number(*value, what + ".componentType", &number));
  for (const ComponentType& known : kComponentTypes)
    if (known.number == number) {
      *type = &known;
      return {};
    }
  return file.fields().error(*value, what, ".componentType: ", number,
                             " is not known; known are 5120 to 5123, 5125, 5126");
}

/// Checks that all elements of an accessor are there.
/// @param form  what its type must be, of `components` components
Status find_elements(GltfFile* file, const GltfFile::Item& accessor, std::string_view form,
                     std::uint64_t components, Elements* elements) {
  const JsonFields& fields = file->fields();
  const std::string& what = accessor.what;
  if (const JsonValue* sparse = accessor.value->find("sparse"))
    return fields.error(*sparse, what, ".sparse: sparse accessors are not read: save it whole");
  const JsonValue *view = nullptr, *count = nullptr, *type = nullptr;
  HC_TRY(file->required(*accessor.value, what, "bufferView", &view));
  HC_TRY(file->required(*accessor.value, what, "count", &count));
  HC_TRY(file->required(*accessor.value, what, "type", &type));
  HC_TRY(component_type(*file, *accessor.value, what, &elements->type));
  HC_TRY(fields.kind(*type, what + ".type", Kind::kString));
  if (type->text != form)
    return fields.error(*type, what, ".type: ", in_quotes(type->text), " must be '", form,
                        "' here");
  if (const JsonValue* normalized = accessor.value->find("normalized"))
    HC_TRY(fields.boolean(*normalized, what + ".normalized", &elements->is_normalized));
  std::uint64_t offset = 0;
  HC_TRY(optional_number(*file, *accessor.value, what, "byteOffset", &offset));
  HC_TRY(file->whole_number(*count, what + ".count", &elements->count));
  if (elements->count == 0)
    return fields.error(*count, what, ".count: 0 elements");

  std::string_view bytes;
  HC_TRY(read_view(file, *view, what + ".bufferView", &bytes, &elements->stride));
  const std::uint64_t size = components * elements->type->size;
  if (elements->stride == 0)
    elements->stride = size;
  // count <= 2^53 and stride <= 252: no overflow.
  const std::uint64_t end = offset + (elements->count - 1) * elements->stride + size;
  if (end > bytes.size())
    return fields.error(*accessor.value, what, ": its ", elements->count, " elements end at byte ",
                        end, " of a buffer view of ", bytes.size());
  elements->first = bytes.data() + offset;
  return {};
}

} // namespace

Status read_positions(GltfFile* file, const GltfFile::Item& accessor, Buffer<Vec3>* positions) {
  Elements elements;
  HC_TRY(find_elements(file, accessor, "VEC3", 3, &elements));
  // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): find_elements has set it
  const ComponentType& type = *elements.type;
  if (type.component == Component::kUint32)
    return file->fields().error(*accessor.value, accessor.what,
                                ".componentType: positions cannot be 5125");
  const bool is_scaled = elements.is_normalized && type.largest != 0;
  if (positions->size() + elements.count > MeshLimits().vertices)
    return file->fields().error(*accessor.value, accessor.what, ": more than ",
                                MeshLimits().vertices, " vertices with these");
  for (std::uint64_t i = 0; i < elements.count; ++i) {
    Vec3 position;
    for (std::size_t k = 0; k < 3; ++k) {
      double value = load(type, elements.first + i * elements.stride + k * type.size);
      if (is_scaled)
        value = std::max(value / type.largest, -1.0);
      if (!std::isfinite(value))
        return file->fields().error(*accessor.value, accessor.what, ": element ", i,
                                    " has a coordinate of ", value, ", not a finite number");
      position[static_cast<int>(k)] = value;
    }
    HC_TRY(positions->push_back(position));
  }
  return {};
}

Status read_indices(GltfFile* file, const GltfFile::Item& accessor, std::uint64_t vertex_count,
                    Buffer<std::uint32_t>* indices) {
  Elements elements;
  HC_TRY(find_elements(file, accessor, "SCALAR", 1, &elements));
  // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): find_elements has set it
  const ComponentType& type = *elements.type;
  if (type.component != Component::kUint8 && type.component != Component::kUint16 &&
      type.component != Component::kUint32)
    return file->fields().error(*accessor.value, accessor.what, ".componentType: indices must ",
                                "be 5121, 5123 or 5125, not ", type.number);
  indices->clear();
  for (std::uint64_t i = 0; i < elements.count; ++i) {
    const double value = load(type, elements.first + i * elements.stride);
    if (value >= static_cast<double>(vertex_count))
      return file->fields().error(*accessor.value, accessor.what, ": element ", i,
                                  " is vertex index ", value, ", but there are ", vertex_count,
                                  " vertices");
    HC_TRY(indices->push_back(static_cast<std::uint32_t>(value)));
  }
  return {};
}

} // namespace hemicube::radiosity
