#include "radiosity/c_api/handles.h"
#include "radiosity/light_model.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/scene/check_scene.h"

#include <algorithm>
#include <charconv>

namespace hemicube::radiosity::c_api {
namespace {

/// Names for messages: scenes of arrays have none.
Status add_numbers(std::uint32_t count, NameTable* names) noexcept {
  for (std::uint32_t k = 0; k < count; ++k) {
    char text[10];
    const char* end = std::to_chars(text, text + sizeof text, k).ptr;
    HC_TRY(names->add({text, static_cast<std::size_t>(end - text)}));
  }
  return {};
}

/// NULL stands for zeros.
template <typename T>
Status copy_or_zeros(const T* from, std::uint64_t count, Buffer<T>* to) noexcept {
  return from != nullptr ? copy_array("", from, count, to)
                         : to->resize(static_cast<std::size_t>(count));
}

Status copy_materials(const hc_scene_desc& desc, Scene* scene) noexcept {
  constexpr std::uint32_t kMost = 1u << 24; // so that their product is no surprise
  const std::uint32_t materials = std::max(desc.material_count, 1u);
  const std::uint32_t bands = std::max(desc.band_count, 1u);
  if (materials > kMost || bands > kMost)
    return Status::error(StatusCode::kInvalidArgument, materials, " materials and ", bands,
                         " bands: at most ", kMost, " of either");
  if (desc.material_count == 0 && (desc.reflectance != nullptr || desc.exitance != nullptr ||
                                   desc.two_sided != nullptr || desc.polygon_materials != nullptr))
    return Status::error(StatusCode::kInvalidArgument, "material_count is 0, but there are arrays ",
                         "of materials");
  if (desc.band_count == 0 &&
      (desc.reflectance != nullptr || desc.exitance != nullptr || desc.space_exitance != nullptr))
    return Status::error(StatusCode::kInvalidArgument, "band_count is 0, but there are arrays of ",
                         "bands");
  const std::uint64_t values = std::uint64_t{materials} * bands;
  HC_TRY(copy_or_zeros(desc.reflectance, values, &scene->reflectance));
  HC_TRY(copy_or_zeros(desc.exitance, values, &scene->exitance));
  HC_TRY(copy_or_zeros(desc.two_sided, materials, &scene->two_sided));
  HC_TRY(copy_or_zeros(desc.space_exitance, bands, &scene->space_exitance));
  HC_TRY(add_numbers(materials, &scene->materials));
  return add_numbers(bands, &scene->bands);
}

Status copy_polygons(const hc_scene_desc& desc, Scene* scene) noexcept {
  const std::uint64_t polygons = desc.polygon_count;
  if (polygons == 0)
    return Status::error(StatusCode::kInvalidArgument, "polygon_count is 0");
  HC_TRY(check_mesh_size(polygons, desc.index_count, desc.vertex_count, "make several scenes"));
  HC_TRY(copy_array("vertices", reinterpret_cast<const Vec3*>(desc.vertices), desc.vertex_count,
                    &scene->vertices));
  HC_TRY(copy_array("polygon_offsets", desc.polygon_offsets, polygons + 1, &scene->corner_offsets));
  HC_TRY(copy_array("indices", desc.indices, desc.index_count, &scene->corners));
  HC_TRY(copy_or_zeros(desc.polygon_materials, polygons, &scene->face_material));
  HC_TRY(scene->face_group.resize(static_cast<std::size_t>(polygons)));
  return scene->groups.add("");
}

void log_repairs(const MeshReport& report) noexcept {
  const std::uint64_t dropped = report.dropped_repeated_index + report.dropped_zero_area;
  const std::uint64_t cut = report.triangulated_concave + report.triangulated_warped;
  if (dropped + cut + report.duplicate_faces == 0)
    return;
  const Status text =
      Status::error(StatusCode::kBadScene, "polygons left out: ", dropped,
                    " (no area, a vertex twice); cut into ", "triangles: ", cut,
                    "; with the vertices of an earlier one: ", report.duplicate_faces);
  log_message(text.message().data());
}

Status make_scene(const hc_scene_desc* given, NewHandle<hc_scene>* made) noexcept {
  hc_scene_desc desc;
  HC_TRY(read_struct("desc", given, sizeof(hc_scene_desc), &desc));
  HC_TRY(made->make());
  hc_scene& s = **made;
  HC_TRY(copy_materials(desc, &s.scene));
  HC_TRY(copy_polygons(desc, &s.scene));
  HC_TRY(check_scene(s.scene));
  HC_TRY(build_patches(s.scene, &s.patches, &s.report));
  HC_TRY(add_back_sides(s.scene, &s.patches));
  log_repairs(s.report);
  s.hash = hash_scene(s.scene, s.patches);
  // From here on the patches are the geometry.
  s.scene.vertices = {};
  s.scene.corner_offsets = {};
  s.scene.corners = {};
  s.scene.face_material = {};
  s.scene.face_group = {};
  return {};
}

Status get_patches(const hc_scene* scene, const hc_patches* given) noexcept {
  if (scene == nullptr)
    return null_argument("scene");
  hc_patches out;
  HC_TRY(read_struct("patches", given, sizeof(hc_patches), &out));
  const PatchSet& patches = scene->patches;
  if (out.patch_count != patches.patch_count())
    return Status::error(StatusCode::kInvalidArgument, "patch_count is ", out.patch_count,
                         ", but there are ", patches.patch_count(), " patches");
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    if (out.area != nullptr)
      out.area[i] = patches.area[i];
    for (int axis = 0; axis < 3; ++axis) {
      if (out.centre != nullptr)
        out.centre[std::size_t{i} * 3 + static_cast<std::size_t>(axis)] = patches.centre[i][axis];
      if (out.normal != nullptr)
        out.normal[std::size_t{i} * 3 + static_cast<std::size_t>(axis)] = patches.normal[i][axis];
    }
    if (out.polygon != nullptr)
      out.polygon[i] = patches.face[i];
  }
  return {};
}

Status get_info(const hc_scene* scene, hc_scene_info* info) noexcept {
  if (scene == nullptr)
    return null_argument("scene");
  const MeshReport& report = scene->report;
  return write_struct("info",
                      hc_scene_info{0, scene->patches.patch_count(), scene->patches.front_count,
                                    scene->scene.band_count(), report.dropped_repeated_index,
                                    report.dropped_zero_area, report.triangulated_concave,
                                    report.triangulated_warped, report.duplicate_faces,
                                    scene->hash},
                      sizeof(hc_scene_info), info);
}

} // namespace
} // namespace hemicube::radiosity::c_api

using namespace hemicube::radiosity::c_api;

int hc_scene_create(const hc_scene_desc* desc, hc_scene** scene) {
  if (scene == nullptr)
    return finish(null_argument("scene"));
  *scene = nullptr;
  NewHandle<hc_scene> made;
  const hemicube::Status status = make_scene(desc, &made);
  if (status.ok())
    made.give(scene);
  return finish(status);
}

void hc_scene_release(hc_scene* scene) {
  release_handle(scene);
}

int hc_scene_get_info(const hc_scene* scene, hc_scene_info* info) {
  return finish(get_info(scene, info));
}

int hc_scene_get_patches(const hc_scene* scene, const hc_patches* patches) {
  return finish(get_patches(scene, patches));
}
