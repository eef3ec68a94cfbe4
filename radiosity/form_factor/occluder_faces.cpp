#include "radiosity/form_factor/occluder_faces.h"

#include "radiosity/form_factor/cell_merger.h"
#include "radiosity/mesh/polygon_shape.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

static_assert(OccluderFaces::kMostCorners == CellSet::kMostCorners);

/// Writes faces one after another.
class FaceWriter {
public:
  FaceWriter(const PatchSet& patches, OccluderFaces* faces) : set_(patches), faces_(*faces) {}

  Status begin();
  /// One face, with the corners of the cell.
  Status add_union(const Cell& cell, std::span<const std::uint32_t> corners,
                   std::span<const std::uint32_t> patches);
  /// The face or faces of one patch.
  Status add_patch(std::uint32_t patch);

private:
  Status add_fan(std::uint32_t patch, std::span<const Vec3> points);
  Status add(std::span<const Vec3> corners, const Vec3& normal,
             std::span<const std::uint32_t> patches);

  const PatchSet& set_;
  OccluderFaces& faces_;
  Buffer<Vec3> points_;
};

Status FaceWriter::begin() {
  faces_.corners.clear();
  faces_.corner_offsets.clear();
  faces_.normal.clear();
  faces_.face_of_patch.clear();
  faces_.patch_offsets.clear();
  faces_.patches.clear();
  HC_TRY(faces_.face_of_patch.resize(set_.patch_count()));
  HC_TRY(faces_.corner_offsets.push_back(0));
  return faces_.patch_offsets.push_back(0);
}

Status FaceWriter::add(std::span<const Vec3> corners, const Vec3& normal,
                       std::span<const std::uint32_t> patches) {
  HC_TRY(faces_.corners.append(corners));
  HC_TRY(faces_.corner_offsets.push_back(static_cast<std::uint32_t>(faces_.corners.size())));
  HC_TRY(faces_.normal.push_back(normal));
  HC_TRY(faces_.patches.append(patches));
  return faces_.patch_offsets.push_back(static_cast<std::uint32_t>(faces_.patches.size()));
}

Status FaceWriter::add_union(const Cell& cell, std::span<const std::uint32_t> corners,
                             std::span<const std::uint32_t> patches) {
  for (const std::uint32_t patch : patches)
    faces_.face_of_patch[patch] = faces_.face_count();
  points_.clear();
  for (const std::uint32_t corner : corners)
    HC_TRY(points_.push_back(set_.vertices[corner]));
  return add(points_.span(), cell.plane.normal, patches);
}

Status FaceWriter::add_patch(std::uint32_t patch) {
  faces_.face_of_patch[patch] = faces_.face_count();
  points_.clear();
  for (const std::uint32_t corner : set_.corners_of(patch))
    HC_TRY(points_.push_back(set_.vertices[corner]));
  if (points_.size() <= OccluderFaces::kMostCorners)
    return add(points_.span(), set_.normal[patch], {&patch, 1});
  return add_fan(patch, points_.span());
}

/// Cuts a polygon around its first corner. Pieces without area, along an edge with corners on it,
/// are left out.
Status FaceWriter::add_fan(std::uint32_t patch, std::span<const Vec3> points) {
  constexpr std::size_t kStep = OccluderFaces::kMostCorners - 2;
  Vec3 piece[OccluderFaces::kMostCorners];
  const std::uint32_t first_face = faces_.face_count();
  piece[0] = points[0];
  for (std::size_t begin = 1; begin + 1 < points.size(); begin += kStep) {
    const std::size_t end = std::min(begin + kStep + 1, points.size());
    std::copy(points.begin() + static_cast<std::ptrdiff_t>(begin),
              points.begin() + static_cast<std::ptrdiff_t>(end), piece + 1);
    const std::span<const Vec3> corners(piece, end - begin + 1);
    if (has_area(corners, measure_polygon(corners)))
      HC_TRY(add(corners, set_.normal[patch], {&patch, 1}));
  }
  // Area so small that none is left in the pieces: any of them stands for the patch.
  return faces_.face_count() > first_face
             ? Status()
             : add({piece, OccluderFaces::kMostCorners}, set_.normal[patch], {&patch, 1});
}

} // namespace

Status OccluderFaces::build(const PatchSet& patch_set) {
  FaceWriter writer(patch_set, this);
  HC_TRY(writer.begin());
  CellSet cells;
  Buffer<std::uint32_t> cell_of;
  HC_TRY(cells.init(patch_set));
  HC_TRY(CellMerger(patch_set.vertices.span()).merge(&cells, &cell_of));

  Buffer<std::uint32_t> begin, members; // the patches of each cell, by counting
  HC_TRY(begin.resize(std::size_t{cells.count()} + 2));
  HC_TRY(members.resize(patch_set.patch_count()));
  for (const std::uint32_t cell : cell_of)
    ++begin[cell + 2];
  for (std::size_t c = 2; c < begin.size(); ++c)
    begin[c] += begin[c - 1];
  for (std::uint32_t patch = 0; patch < patch_set.patch_count(); ++patch)
    members[begin[cell_of[patch] + 1]++] = patch;

  for (std::uint32_t c = 0; c < cells.count(); ++c) {
    const auto patches_of_cell = members.span().subspan(begin[c], begin[c + 1] - begin[c]);
    HC_TRY(patches_of_cell.size() == 1
               ? writer.add_patch(patches_of_cell[0])
               : writer.add_union(cells.cells[c], cells.corners_of(c), patches_of_cell));
  }
  return {};
}

} // namespace hemicube::radiosity
