#pragma once

#include "radiosity/form_factor/occluder_faces.h"
#include "radiosity/form_factor/occluder_tree.h"
#include "radiosity/form_factor/prepared_area.h"
#include "radiosity/form_factor/shaft.h"
#include "radiosity/mesh/patch_set.h"

namespace hemicube::radiosity {

/// A convex piece of a patch, all of it unless it has more than OccluderFaces::kMostCorners
/// corners.
struct PatchPiece {
  std::uint32_t patch = 0;
  bool is_covered = false; ///< a front of a lower id may lie in the same place as some of it: it is
                           ///< seen less than it sees
  double area = 0;
  Facet facet;
  PreparedArea prepared;
};

/// The patches of a scene as facets, the faces they make up, and which of these can hide anything.
/// Built once, read by every worker.
class SceneFacets {
public:
  /// @param patches  outlive this
  Status build(const PatchSet& patches);

  std::uint32_t face_count() const noexcept { return faces_.face_count(); }
  std::span<const PatchPiece> pieces_of(std::uint32_t patch) const noexcept {
    return pieces_.span().subspan(piece_offsets_[patch],
                                  piece_offsets_[patch + 1] - piece_offsets_[patch]);
  }
  /// A part of a patch as a receiver. @param corners  convex, in its plane; must outlive the piece
  PatchPiece part_of(std::uint32_t patch, std::span<const Vec3> corners) const noexcept;

  const Facet& face(std::uint32_t index) const noexcept { return face_facets_[index]; }
  std::uint32_t face_of(std::uint32_t patch) const noexcept { return faces_.face_of_patch[patch]; }
  std::span<const std::uint32_t> patches_of(std::uint32_t face) const noexcept {
    return faces_.patches_of(face);
  }
  /// The face itself, or the first of several that one patch of many corners is cut into.
  std::uint32_t first_face_of(std::uint32_t face) const noexcept {
    return face_of(faces_.patches_of(face)[0]);
  }

  /// False for a face that has the whole scene on one side: nothing passes through it.
  bool can_block(std::uint32_t face) const noexcept { return can_block_[face] != 0; }

  /// False if every pair of patches that face each other see each other whole.
  bool anything_hides() const noexcept { return anything_hides_; }

  /// Faces in the plane of a face that cover some of the same points, ascending.
  std::span<const std::uint32_t> overlaps_of(std::uint32_t face) const noexcept {
    return overlaps_.span().subspan(overlap_offsets_[face],
                                    overlap_offsets_[face + 1] - overlap_offsets_[face]);
  }

  const OccluderTree& tree() const noexcept { return tree_; }

  /// Points closer than this to a plane lie in it: 64 units in the last place of the largest
  /// coordinate, metres.
  double tolerance() const noexcept { return tolerance_; }

private:
  Status fill_pieces(const PatchSet& patches);
  Status fill_faces();
  Status find_blocking();
  Status find_overlaps();

  OccluderFaces faces_;
  OccluderTree tree_;
  Buffer<Vec3> piece_corners_; ///< of all pieces, one after the other
  Buffer<std::uint32_t> piece_offsets_;
  Buffer<PatchPiece> pieces_;
  Buffer<Facet> face_facets_;
  Buffer<std::uint8_t> can_block_;
  Buffer<std::uint32_t> overlap_offsets_, overlaps_;
  double tolerance_ = 0;
  bool anything_hides_ = false;
};

} // namespace hemicube::radiosity
