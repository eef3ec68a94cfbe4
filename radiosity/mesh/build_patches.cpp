#include "radiosity/mesh/build_patches.h"

#include "radiosity/mesh/polygon_shape.h"
#include "radiosity/mesh/triangulate.h"
#include "radiosity/mesh/weld.h"
#include "raster/fp_environment.h"
#include "raster/types.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

// Ear clipping takes quadratic time: some seconds at this size.
constexpr std::size_t kMaxClippedCorners = 65536;

std::span<const std::uint32_t> corners_of_face(const Scene& scene, std::size_t face) {
  const std::uint64_t begin = scene.corner_offsets[face];
  return scene.corners.span().subspan(begin, scene.corner_offsets[face + 1] - begin);
}

class PatchBuilder {
public:
  PatchBuilder(const Scene& scene, PatchSet* patches, MeshReport* report)
      : scene_(scene), patches_(*patches), report_(*report) {}

  Status run() {
    const std::size_t faces = scene_.face_count();
    HC_TRY(
        check_mesh_size(faces, scene_.corners.size(), scene_.vertices.size(), "split the scene"));
    HC_TRY(patches_.vertices.assign(scene_.vertices));
    HC_TRY(patches_.corner_offsets.push_back(0));
    for (std::size_t face = 0; face < faces; ++face)
      HC_TRY(add_face(static_cast<std::uint32_t>(face)));
    if (patches_.face.empty())
      return Status::error(StatusCode::kBadScene, "no face of the scene has an area: all ", faces,
                           " were dropped (", report_.dropped_repeated_index, " repeated index, ",
                           report_.dropped_zero_area, " zero area)");
    return {};
  }

private:
  Status add_face(std::uint32_t face) {
    const std::span<const std::uint32_t> corners = corners_of_face(scene_, face);
    HC_TRY(find_repeated_index(corners));
    if (repeated_) {
      ++report_.dropped_repeated_index;
      return {};
    }
    HC_TRY(gather(corners));
    if (points_.size() < 3) {
      ++report_.dropped_zero_area;
      return {};
    }
    const PolygonShape shape = measure_polygon(points_.span());
    if (!has_area(points_.span(), shape)) {
      ++report_.dropped_zero_area;
      return {};
    }
    const bool planar = is_planar(points_.span(), shape);
    const bool convex = points_.size() == 3 || is_convex(points_.span(), shape);
    return planar && convex ? add_patch(face, indices_.span())
                            : add_triangles(face, shape, planar, convex);
  }

  Status add_triangles(std::uint32_t face, const PolygonShape& shape, bool planar, bool convex) {
    triangles_.clear();
    if (points_.size() > kMaxClippedCorners)
      return Status::error(StatusCode::kBadScene, "face ", face, ": ", points_.size(),
                           " corners of a concave or warped face, at most ", kMaxClippedCorners,
                           " can be cut into triangles: split it");
    if (points_.size() == 4 && convex)
      HC_TRY(cut_quad(points_.span(), &triangles_));
    else
      HC_TRY(clip_ears(points_.span(), shape, &triangles_));
    const std::size_t patches_before = patches_.face.size();
    for (std::size_t t = 0; t + 2 < triangles_.size(); t += 3) {
      const std::uint32_t* corner = &triangles_[t];
      const Vec3 points[3] = {points_[corner[0]], points_[corner[1]], points_[corner[2]]};
      if (has_area(points, measure_polygon(points))) {
        const std::uint32_t indices[3] = {indices_[corner[0]], indices_[corner[1]],
                                          indices_[corner[2]]};
        HC_TRY(add_patch(face, indices));
      }
    }
    if (patches_.face.size() == patches_before)
      ++report_.dropped_zero_area;
    else
      ++(planar ? report_.triangulated_concave : report_.triangulated_warped);
    return {};
  }

  Status find_repeated_index(std::span<const std::uint32_t> corners) {
    HC_TRY(sorted_.assign(corners));
    std::sort(sorted_.begin(), sorted_.end()); // equal numbers cannot be told apart
    repeated_ = std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
    return {};
  }

  // The face's corners without those at the place of the one before.
  Status gather(std::span<const std::uint32_t> corners) {
    indices_.clear();
    points_.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t before = corners[i == 0 ? corners.size() - 1 : i - 1];
      if (scene_.vertices[corners[i]] == scene_.vertices[before])
        continue;
      HC_TRY(indices_.push_back(corners[i]));
      HC_TRY(points_.push_back(scene_.vertices[corners[i]]));
    }
    return {};
  }

  Status add_patch(std::uint32_t face, std::span<const std::uint32_t> corners) {
    HC_TRY(check_mesh_size(patches_.face.size() + 1, patches_.corners.size() + corners.size(), 0,
                           "split the scene"));
    HC_TRY(patches_.corners.append(corners));
    HC_TRY(patches_.corner_offsets.push_back(static_cast<std::uint32_t>(patches_.corners.size())));
    HC_TRY(patches_.parent.push_back(static_cast<std::uint32_t>(patches_.face.size())));
    HC_TRY(patches_.face.push_back(face));
    HC_TRY(patches_.material.push_back(scene_.face_material[face]));
    return patches_.group.push_back(scene_.face_group[face]);
  }

  const Scene& scene_;
  PatchSet& patches_;
  MeshReport& report_;

  bool repeated_ = false;
  Buffer<std::uint32_t> sorted_;
  Buffer<std::uint32_t> indices_; // of the corners of the face at hand
  Buffer<Vec3> points_;           // their places
  Buffer<std::uint32_t> triangles_;
};

// Faces with the places of an earlier face, in any order. Dropped faces do not count.
class DuplicateCounter {
public:
  DuplicateCounter(const Scene& scene, const PatchSet& patches)
      : scene_(scene), patches_(patches) {}

  Status run(std::uint64_t* count) {
    HC_TRY(collect());
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const int places = compare(a, b);
      return places != 0 ? places < 0 : a < b;
    });
    *count = 0;
    for (std::size_t i = 1; i < order_.size(); ++i)
      *count += compare(order_[i - 1], order_[i]) == 0;
    return {};
  }

private:
  // Writes down the sorted places of every face that became a patch.
  Status collect() {
    Buffer<std::uint32_t> first;
    HC_TRY(weld_positions(scene_.vertices, &first));
    HC_TRY(offsets_.push_back(0));
    for (std::size_t patch = 0; patch < patches_.face.size(); ++patch) {
      const std::uint32_t face = patches_.face[patch];
      if (patch > 0 && face == patches_.face[patch - 1])
        continue;
      const std::size_t begin = places_.size();
      for (const std::uint32_t corner : corners_of_face(scene_, face))
        HC_TRY(places_.push_back(first[corner]));
      std::sort(places_.begin() + begin, places_.end());
      const std::uint32_t* end = std::unique(places_.begin() + begin, places_.end());
      HC_TRY(places_.resize(static_cast<std::size_t>(end - places_.begin())));
      HC_TRY(order_.push_back(static_cast<std::uint32_t>(order_.size())));
      HC_TRY(offsets_.push_back(places_.size()));
    }
    return {};
  }

  int compare(std::uint32_t a, std::uint32_t b) const {
    const std::size_t a_count = offsets_[a + 1] - offsets_[a];
    const std::size_t b_count = offsets_[b + 1] - offsets_[b];
    if (a_count != b_count)
      return a_count < b_count ? -1 : 1;
    for (std::size_t i = 0; i < a_count; ++i) {
      const std::uint32_t left = places_[offsets_[a] + i], right = places_[offsets_[b] + i];
      if (left != right)
        return left < right ? -1 : 1;
    }
    return 0;
  }

  const Scene& scene_;
  const PatchSet& patches_;
  Buffer<std::uint32_t> places_;
  Buffer<std::size_t> offsets_;
  Buffer<std::uint32_t> order_;
};

Status add_back(std::uint32_t front, std::uint32_t parent, PatchSet* patches) {
  const std::uint32_t begin = patches->corner_offsets[front];
  const std::uint32_t end = patches->corner_offsets[front + 1];
  HC_TRY(patches->corners.push_back(patches->corners[begin]));
  for (std::uint32_t i = end - 1; i > begin; --i)
    HC_TRY(patches->corners.push_back(patches->corners[i]));
  if (!patches->edge_light.empty())
    for (std::uint32_t i = end; i-- > begin;) // the last edge of the front is the back's first
      HC_TRY(patches->edge_light.push_back(patches->edge_light[i]));
  HC_TRY(patches->corner_offsets.push_back(static_cast<std::uint32_t>(patches->corners.size())));
  HC_TRY(patches->face.push_back(patches->face[front]));
  HC_TRY(patches->parent.push_back(parent));
  HC_TRY(patches->material.push_back(patches->material[front]));
  HC_TRY(patches->group.push_back(patches->group[front]));
  HC_TRY(patches->area.push_back(patches->area[front]));
  HC_TRY(patches->centre.push_back(patches->centre[front]));
  return patches->normal.push_back(-patches->normal[front]);
}

/// Depths are single-precision numbers and planes products of six coordinates: both must fit.
Status check_extent(const Scene& scene) {
  constexpr double kLargest = 0x1p100, kSmallest = 0x1p-100;
  double largest = 0;
  for (const Vec3& v : scene.vertices)
    for (const double x : {v.x, v.y, v.z})
      largest = std::max(largest, x < 0 ? -x : x);
  if (largest > kLargest || (largest < kSmallest && largest > 0))
    return Status::error(StatusCode::kBadScene, "the largest coordinate, ", largest,
                         ", is out of the range ", kSmallest, " to ", kLargest,
                         ": scale the scene");
  return {};
}

} // namespace

Status build_patches(const Scene& scene, PatchSet* patches, MeshReport* report) {
  const FloatEnvironment environment;
  *patches = PatchSet();
  *report = MeshReport();
  HC_TRY(check_extent(scene));
  HC_TRY(PatchBuilder(scene, patches, report).run());
  HC_TRY(DuplicateCounter(scene, *patches).run(&report->duplicate_faces));
  HC_TRY(measure_patches(patches));
  patches->front_count = patches->patch_count();
  return {};
}

Status measure_patches(PatchSet* patches) {
  const FloatEnvironment environment;
  const std::size_t count = patches->face.size();
  HC_TRY(patches->area.resize(count));
  HC_TRY(patches->centre.resize(count));
  HC_TRY(patches->normal.resize(count));
  Buffer<Vec3> points;
  for (std::uint32_t patch = 0; patch < count; ++patch) {
    points.clear();
    for (const std::uint32_t corner : patches->corners_of(patch))
      HC_TRY(points.push_back(patches->vertices[corner]));
    const PolygonShape shape = measure_polygon(points.span());
    if (!has_area(points.span(), shape))
      return Status::error(StatusCode::kBadScene, "patch ", patch, " of face ",
                           patches->face[patch], " has no area in double precision (size ",
                           shape.size, ")");
    patches->area[patch] = shape.area;
    patches->centre[patch] = centroid(points.span(), shape);
    patches->normal[patch] = shape.area_vector / shape.area;
  }
  return {};
}

Status add_back_sides(const Scene& scene, PatchSet* patches) {
  const std::uint32_t fronts = patches->patch_count();
  patches->front_count = fronts;
  std::uint64_t backs = 0, corners = patches->corners.size();
  for (std::uint32_t i = 0; i < fronts; ++i)
    if (scene.two_sided[patches->material[i]] != 0) {
      ++backs;
      corners += patches->corners_of(i).size();
    }
  if (backs == 0)
    return {};
  HC_TRY(check_mesh_size(fronts + backs, corners, 0, "make fewer materials two-sided"));
  // Parents count the fronts before subdivision, then their backs; the pieces of one are
  // consecutive.
  std::uint32_t parent = patches->parent[fronts - 1];
  std::uint32_t last_front = 0xffffffffu;
  for (std::uint32_t i = 0; i < fronts; ++i) {
    if (scene.two_sided[patches->material[i]] == 0)
      continue;
    parent += patches->parent[i] != last_front;
    last_front = patches->parent[i];
    HC_TRY(add_back(i, parent, patches));
  }
  return {};
}

Status check_mesh_size(std::uint64_t patches, std::uint64_t corners, std::uint64_t vertices,
                       const char* remedy) {
  constexpr std::uint64_t kMaxPatches = raster::kMaxPolygonCount - 1;
  constexpr std::uint64_t kMaxIndex = 0xffffffffu;
  if (patches > kMaxPatches)
    return Status::error(StatusCode::kBadScene, "the mesh would have ", patches,
                         " patches, at most ", kMaxPatches, " can be numbered: ", remedy);
  if (corners > kMaxIndex || vertices > kMaxIndex)
    return Status::error(StatusCode::kBadScene, "the mesh would have ", corners, " corners and ",
                         vertices, " vertices, at most ", kMaxIndex,
                         " of each can be numbered: ", remedy);
  return {};
}

} // namespace hemicube::radiosity
