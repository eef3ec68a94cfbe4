#include "radiosity/form_factor/scene_facets.h"

#include "radiosity/elementary.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Beyond this many faces, comparing each with each would cost more than it saves.
constexpr std::uint32_t kMostComparedFaces = 1u << 15;

/// Parts that two faces share and that are smaller than this, relative to the smaller one, are
/// rounding.
constexpr double kLeastOverlap = 0x1p-30;

bool share_area(const Facet& a, const Facet& b) {
  ConvexPolygon common(a.corners);
  const std::size_t count = b.corners.size();
  for (std::size_t k = 0; k < count && !common.empty(); ++k) {
    const Vec3 edge = b.corners[k + 1 == count ? 0 : k + 1] - b.corners[k];
    common = clip(common, {b.corners[k], glm::cross(b.plane.normal, edge)}, 0);
  }
  const double smaller =
      min_number(glm::length(area_vector(a.corners)), glm::length(area_vector(b.corners)));
  return glm::length(area_vector(common.span())) > kLeastOverlap * smaller;
}

} // namespace

Status SceneFacets::build(const PatchSet& patches) {
  HC_TRY(faces_.build(patches));
  HC_TRY(fill_pieces(patches));
  HC_TRY(fill_faces());
  HC_TRY(tree_.build(faces_));
  HC_TRY(find_blocking());
  HC_TRY(find_overlaps());
  for (PatchPiece& piece : pieces_)
    for (const std::uint32_t other : overlaps_of(face_of(piece.patch)))
      if (patches_of(other)[0] < piece.patch &&
          glm::dot(face(other).plane.normal, piece.facet.plane.normal) > 0)
        piece.is_covered = true;
  anything_hides_ = !overlaps_.empty();
  for (const std::uint8_t can_block : can_block_)
    anything_hides_ = anything_hides_ || can_block != 0;
  return {};
}

Status SceneFacets::fill_pieces(const PatchSet& patches) {
  constexpr std::size_t kMost = OccluderFaces::kMostCorners;
  struct Range {
    std::size_t begin, end;
  };
  Buffer<Range> ranges;
  double largest = 0;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    HC_TRY(piece_offsets_.push_back(static_cast<std::uint32_t>(pieces_.size())));
    const auto corners = patches.corners_of(i);
    for (const std::uint32_t corner : corners) {
      const Vec3& v = patches.vertices[corner];
      largest = max_number(largest,
                           max_number(std::fabs(v.x), max_number(std::fabs(v.y), std::fabs(v.z))));
    }
    // A fan of pieces around the first corner.
    for (std::size_t k = 1; k + 1 < corners.size(); k += kMost - 2) {
      const std::size_t begin = piece_corners_.size();
      HC_TRY(piece_corners_.push_back(patches.vertices[corners[0]]));
      for (std::size_t m = k; m < corners.size() && m < k + kMost - 1; ++m)
        HC_TRY(piece_corners_.push_back(patches.vertices[corners[m]]));
      HC_TRY(ranges.push_back({begin, piece_corners_.size()}));
      PatchPiece piece;
      piece.patch = i;
      HC_TRY(pieces_.push_back(piece));
    }
  }
  HC_TRY(piece_offsets_.push_back(static_cast<std::uint32_t>(pieces_.size())));
  for (std::size_t k = 0; k < pieces_.size(); ++k) { // the corners stay where they are from here on
    PatchPiece& piece = pieces_[k];
    const auto corners =
        piece_corners_.span().subspan(ranges[k].begin, ranges[k].end - ranges[k].begin);
    piece.facet = Facet::of(corners, patches.normal[piece.patch]);
    piece.prepared = prepare_area(corners, patches.normal[piece.patch]);
    // A plane through the centroid is as near to all corners of a warped patch as can be.
    piece.facet.plane.origin = patches.centre[piece.patch];
    piece.area = pieces_of(piece.patch).size() == 1 ? patches.area[piece.patch]
                                                    : glm::length(area_vector(corners));
  }
  tolerance_ = largest * 0x1p-46;
  return {};
}

PatchPiece SceneFacets::part_of(std::uint32_t patch, std::span<const Vec3> corners) const noexcept {
  const PatchPiece& whole = pieces_of(patch)[0];
  PatchPiece part;
  part.patch = patch;
  part.is_covered = whole.is_covered;
  part.facet = Facet::of(corners, whole.facet.plane.normal);
  part.prepared = prepare_area(corners, whole.facet.plane.normal);
  part.area = glm::length(area_vector(corners));
  return part;
}

Status SceneFacets::fill_faces() {
  HC_TRY(face_facets_.resize(face_count()));
  for (std::uint32_t f = 0; f < face_count(); ++f)
    face_facets_[f] = Facet::of(faces_.corners_of(f), faces_.normal[f]);
  return {};
}

Status SceneFacets::find_blocking() {
  const std::uint32_t count = face_count();
  can_block_.clear();
  HC_TRY(can_block_.resize(count, 1));
  if (count > kMostComparedFaces)
    return {};
  for (std::uint32_t f = 0; f < count; ++f) {
    bool all_front = true, all_behind = true;
    for (std::uint32_t g = 0; g < count && (all_front || all_behind); ++g) {
      all_front = all_front && face(f).has_in_front(face(g), tolerance_);
      all_behind = all_behind && face(f).has_behind(face(g), tolerance_);
    }
    can_block_[f] = all_front || all_behind ? 0 : 1;
  }
  return {};
}

Status SceneFacets::find_overlaps() {
  overlaps_.clear();
  overlap_offsets_.clear();
  HC_TRY(overlap_offsets_.push_back(0));
  Buffer<std::uint32_t> found;
  for (std::uint32_t f = 0; f < face_count(); ++f) {
    const Facet& a = face(f);
    found.clear();
    Status status;
    const Vec3 margin(tolerance_, tolerance_, tolerance_);
    tree_.for_each_in_box(a.low - margin, a.high + margin, [&](std::uint32_t g) {
      const Facet& b = face(g);
      if (g == f || !a.has_in_front(b, tolerance_) || !a.has_behind(b, tolerance_) ||
          !share_area(a, b))
        return true;
      status = found.push_back(g);
      return status.ok();
    });
    HC_TRY(status);
    // The tree's order is its own.
    for (std::size_t k = 1; k < found.size(); ++k)
      for (std::size_t m = k; m > 0 && found[m] < found[m - 1]; --m)
        std::swap(found[m], found[m - 1]);
    HC_TRY(overlaps_.append(found.span()));
    HC_TRY(overlap_offsets_.push_back(static_cast<std::uint32_t>(overlaps_.size())));
  }
  return {};
}

} // namespace hemicube::radiosity
