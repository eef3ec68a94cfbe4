#include "radiosity/cli/load_scene.h"

#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/stopwatch.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "radiosity/scene/read_scene.h"

#include <algorithm>

namespace hemicube::radiosity::cli {
namespace {

Status mesh(const MeshOptions& options, LoadedScene* loaded) {
  const double max_edge = options.max_edge;
  const Scene& scene = loaded->scene;
  PatchSet* patches = &loaded->patches;
  HC_TRY(build_patches(scene, patches, &loaded->mesh));
  HC_TRY(check_interrupt());
  const bool scene_limits = std::any_of(scene.face_max_edge.begin(), scene.face_max_edge.end(),
                                        [](double limit) { return limit != 0; });
  if (max_edge != 0 || scene_limits) {
    std::vector<double> limits(patches->patch_count(), max_edge);
    if (max_edge == 0)
      for (std::uint32_t i = 0; i < patches->patch_count(); ++i)
        limits[i] = scene.face_max_edge[patches->face[i]];
    PatchSet coarse = std::move(*patches);
    *patches = {};
    HC_TRY(subdivide(coarse, limits, patches, &loaded->mesh));
  }
  if (options.discontinuity) {
    PatchSet whole = std::move(*patches);
    *patches = {};
    HC_TRY(cut_discontinuities(scene, whole, options.limits, patches, &loaded->lines,
                               &loaded->discontinuities));
  }
  HC_TRY(add_back_sides(scene, patches));
  return check_interrupt();
}

} // namespace

Status load_scene(const std::string& path, const MeshOptions& options, LoadedScene* loaded,
                  RunReport* run) {
  Stopwatch watch;
  HC_TRY(read_scene(path, &loaded->scene, &loaded->read));
  HC_TRY(check_interrupt());
  run->read_seconds = watch.lap();
  const Status meshed = mesh(options, loaded);
  if (meshed.code() == StatusCode::kBadScene)
    return Status::error(StatusCode::kBadScene, path, ": ", meshed.message());
  HC_TRY(meshed);
  run->mesh_seconds = watch.lap();
  return {};
}

std::vector<std::string> warnings(const LoadedScene& loaded) {
  std::vector<std::string> lines;
  for (const auto& [reason, count] : loaded.read.skipped)
    lines.push_back(concat("skipped ", count, " x ", reason));
  const MeshReport& mesh = loaded.mesh;
  const auto faces = [&lines](std::uint64_t count, const char* what) {
    if (count != 0)
      lines.push_back(concat(counted(count, "face ", "faces "), what));
  };
  faces(loaded.read.faces_without_material, "without a material: grey, reflectance 0.5");
  faces(mesh.dropped_repeated_index, "dropped: a vertex is named twice");
  faces(mesh.dropped_zero_area, "dropped: no area");
  faces(mesh.triangulated_concave, "cut into triangles: not convex");
  faces(mesh.triangulated_warped, "cut into triangles: not planar");
  faces(mesh.duplicate_faces, "with the vertices of an earlier face: kept");
  faces(mesh.non_manifold_faces,
        "on an edge that more than two share or with opposite orientation: kept");
  // Areas are then off by up to twice that, 1/50 of what is asked for by default.
  constexpr double kCoarse = 1e-4;
  if (loaded.read.float_grid_step > kCoarse)
    lines.push_back(concat("coordinates are rounded to 32-bit floats, which are ",
                           loaded.read.float_grid_step,
                           " of a mesh's size apart where it stands: save it nearer to 0"));
  const DiscontinuityReport& cut = loaded.discontinuities;
  const auto beyond = [&lines](std::uint64_t count, const char* what, std::uint64_t limit) {
    if (count != 0)
      lines.push_back(concat(count, what, limit));
  };
  beyond(cut.wedges_skipped, " wedges of shadows not followed: the limit is ",
         cut.limits.max_wedges);
  beyond(cut.lines_skipped, " weaker borders of shadows not cut: the limit of elements is ",
         cut.limits.max_elements);
  return lines;
}

} // namespace hemicube::radiosity::cli
