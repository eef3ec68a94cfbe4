#include "radiosity/scene/check_scene.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

template <typename... Parts> Status bad(const Parts&... parts) noexcept {
  return Status::error(StatusCode::kBadScene, parts...);
}

/// @param max  the largest there may be; infinity itself is never right
Status check_numbers(const char* what, const Buffer<double>& values, std::size_t bands,
                     double max) noexcept {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(values[k] >= 0 && values[k] <= max) || !std::isfinite(values[k]))
      return bad(what, " ", k / bands, ", band ", k % bands, ": ", values[k],
                 max == 1 ? " is not in 0..1" : " is not a finite number from 0 on");
  return {};
}

Status check_materials(const Scene& scene) noexcept {
  const std::size_t bands = scene.band_count(), values = scene.materials.size() * bands;
  if (bands == 0 || scene.materials.size() == 0)
    return bad("a scene needs a band and a material, this one has ", bands, " and ",
               scene.materials.size());
  if (scene.reflectance.size() != values || scene.exitance.size() != values ||
      scene.two_sided.size() != scene.materials.size() || scene.space_exitance.size() != bands)
    return bad("the arrays of ", scene.materials.size(), " materials and ", bands,
               " bands are not of that size");
  HC_TRY(check_numbers("reflectance of material", scene.reflectance, bands, 1));
  HC_TRY(check_numbers("exitance of material", scene.exitance, bands, HUGE_VAL));
  HC_TRY(check_numbers("exitance of space", scene.space_exitance, bands, HUGE_VAL));
  for (std::size_t m = 0; m < scene.two_sided.size(); ++m)
    if (scene.two_sided[m] > 1)
      return bad("material ", m, ": two-sided is ", scene.two_sided[m], ", neither 0 nor 1");
  return {};
}

Status check_face(const Scene& scene, std::size_t face) noexcept {
  const std::uint64_t begin = scene.corner_offsets[face], end = scene.corner_offsets[face + 1];
  if (end < begin || end > scene.corners.size())
    return bad("face ", face, ": its corners are ", begin, " to ", end, " of ",
               scene.corners.size());
  if (end - begin < 3)
    return bad("face ", face, ": needs 3 corners or more, has ", end - begin);
  for (std::uint64_t k = begin; k < end; ++k)
    if (scene.corners[k] >= scene.vertices.size())
      return bad("face ", face, ", corner ", k - begin, ": vertex ", scene.corners[k],
                 " does not exist: there are ", scene.vertices.size(), ", counted from 0");
  if (scene.face_material[face] >= scene.materials.size())
    return bad("face ", face, ": material ", scene.face_material[face],
               " does not exist: there are ", scene.materials.size(), ", counted from 0");
  return scene.face_group[face] < scene.groups.size()
             ? Status()
             : bad("face ", face, ": group ", scene.face_group[face], " does not exist");
}

} // namespace

Status check_scene(const Scene& scene) noexcept {
  HC_TRY(check_materials(scene));
  for (std::size_t v = 0; v < scene.vertices.size(); ++v)
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(scene.vertices[v][axis]))
        return bad("vertex ", v, ": ", scene.vertices[v][axis], " is not a finite number");
  const std::size_t faces = scene.face_count();
  if (faces == 0)
    return bad("the scene has no face");
  if (scene.face_material.size() != faces || scene.face_group.size() != faces)
    return bad("the arrays of ", faces, " faces are not of that size");
  if (scene.corner_offsets[0] != 0 || scene.corner_offsets[faces] != scene.corners.size())
    return bad("the corners of the faces are ", scene.corner_offsets[0], " to ",
               scene.corner_offsets[faces], ", but there are ", scene.corners.size());
  for (std::size_t face = 0; face < faces; ++face)
    HC_TRY(check_face(scene, face));
  return {};
}

} // namespace hemicube::radiosity
