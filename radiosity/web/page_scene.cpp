#include "radiosity/web/page_scene.h"

#include "radiosity/mesh/build_patches.h"

#include <bit>
#include <cstring>

namespace hemicube::radiosity::web {
namespace {

static_assert(std::endian::native == std::endian::little);

class Packer {
public:
  explicit Packer(Buffer<std::byte>* bytes) : bytes_(*bytes) {}

  template <typename T> Status value(const T& value) { return append(&value, sizeof value); }

  template <typename T> Status values(const Buffer<T>& values) {
    HC_TRY(value(std::uint64_t{values.size()}));
    return append(values.data(), values.size() * sizeof(T));
  }

  Status names(const NameTable& names) {
    HC_TRY(value(std::uint64_t{names.size()}));
    for (std::uint32_t k = 0; k < names.size(); ++k) {
      HC_TRY(value(std::uint64_t{names[k].size()}));
      HC_TRY(append(names[k].data(), names[k].size()));
    }
    return {};
  }

private:
  Status append(const void* data, std::size_t size) {
    return bytes_.append({static_cast<const std::byte*>(data), size});
  }

  Buffer<std::byte>& bytes_;
};

class Unpacker {
public:
  explicit Unpacker(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <typename T> Status value(T& value) { return take(&value, 1); }

  template <typename T> Status values(Buffer<T>& values) {
    std::size_t count = 0;
    HC_TRY(take_count(sizeof(T), &count));
    HC_TRY(values.resize(count));
    return take(values.data(), count);
  }

  Status names(NameTable& names) {
    std::size_t count = 0;
    HC_TRY(take_count(sizeof(std::uint64_t), &count));
    for (std::size_t k = 0; k < count; ++k) {
      Buffer<char> name;
      HC_TRY(values(name));
      HC_TRY(names.add({name.data(), name.size()}));
    }
    return {};
  }

  bool at_end() const { return rest_.empty(); }

private:
  static Status cut_off() {
    return Status::error(StatusCode::kBadScene, "the scene of the page is cut off");
  }

  /// A number of things that take so many bytes each, at least.
  Status take_count(std::size_t size, std::size_t* count) {
    std::uint64_t announced = 0;
    HC_TRY(value(announced));
    if (announced > rest_.size() / size)
      return cut_off();
    *count = static_cast<std::size_t>(announced);
    return {};
  }

  template <typename T> Status take(T* values, std::size_t count) {
    const std::size_t size = count * sizeof(T);
    if (size > rest_.size())
      return cut_off();
    if (size != 0)
      std::memcpy(static_cast<void*>(values), rest_.data(), size);
    rest_ = rest_.subspan(size);
    return {};
  }

  std::span<const std::byte> rest_;
};

/// All parts of a page's scene, in the order of the bytes.
template <typename Page, typename Visitor> Status each_part(Page& page, Visitor visitor) {
  auto& scene = page.scene;
  auto& patches = page.patches;
  auto& camera = scene.camera;
  for (auto* names : {&scene.bands, &scene.materials, &scene.groups})
    HC_TRY(visitor.names(*names));
  for (auto* values : {&scene.reflectance, &scene.exitance, &scene.space_exitance})
    HC_TRY(visitor.values(*values));
  HC_TRY(visitor.values(scene.two_sided));
  for (auto* place : {&camera.position, &camera.target, &camera.up})
    HC_TRY(visitor.value(*place));
  HC_TRY(visitor.value(camera.vertical_field_of_view));
  HC_TRY(visitor.value(camera.width));
  HC_TRY(visitor.value(camera.height));
  HC_TRY(visitor.values(patches.vertices));
  for (auto* values : {&patches.corner_offsets, &patches.corners, &patches.face, &patches.parent,
                       &patches.material, &patches.group})
    HC_TRY(visitor.values(*values));
  HC_TRY(visitor.value(patches.front_count));
  return visitor.value(page.exposure);
}

} // namespace

Status pack_page_scene(const PageScene& page, Buffer<std::byte>* bytes) {
  bytes->clear();
  return each_part(page, Packer(bytes));
}

Status unpack_page_scene(std::span<const std::byte> bytes, PageScene* page) {
  *page = {};
  HC_TRY(each_part(*page, Unpacker(bytes)));
  HC_TRY(measure_patches(&page->patches));
  return add_back_sides(page->scene, &page->patches);
}

} // namespace hemicube::radiosity::web
