#pragma once

#include "radiosity/mesh/patch_set.h"

namespace hemicube::radiosity {

/// The surfaces of a scene as few large convex polygons: coplanar patches that tile a convex
/// polygon are one occluder, which blocks light exactly as they do.
///
/// A face covers its patches and nothing else, up to the rounding of coordinates: 8 * 2^-52 times
/// the largest coordinate of its patches. Patches are joined only where they face the same way,
/// within that distance of one plane, and where their edges run along each other: vertices count
/// as one if their coordinates are equal, and an edge may meet a chain of several. Corners on the
/// edges of joined patches are gone. Grids, also of triangles, on a convex outline end as one face;
/// others as several, not always as few as possible. Coincident patches are not joined with
/// anything, nor are patches that are not planar within rounding: they are faces as they are.
///
/// Faces have at most kMostCorners corners. A patch that has more and is not joined is cut into
/// several faces around its first corner: consecutive ones, each with that one patch;
/// face_of_patch is then the first. Faces are in the order of their lowest patches.
struct OccluderFaces {
  static constexpr std::uint32_t kMostCorners = 32;

  Buffer<Vec3> corners;                 ///< of all faces, counter-clockwise seen from the front
  Buffer<std::uint32_t> corner_offsets; ///< [face_count + 1] into corners
  Buffer<Vec3> normal;                  ///< [face] unit
  Buffer<std::uint32_t> face_of_patch;  ///< [patch] the face that covers it
  Buffer<std::uint32_t> patch_offsets;  ///< [face_count + 1] into patches
  Buffer<std::uint32_t> patches;        ///< the patches of each face, ascending

  std::uint32_t face_count() const noexcept { return static_cast<std::uint32_t>(normal.size()); }
  std::span<const Vec3> corners_of(std::uint32_t face) const noexcept {
    return corners.span().subspan(corner_offsets[face],
                                  corner_offsets[face + 1] - corner_offsets[face]);
  }
  std::span<const std::uint32_t> patches_of(std::uint32_t face) const noexcept {
    return patches.span().subspan(patch_offsets[face],
                                  patch_offsets[face + 1] - patch_offsets[face]);
  }

  /// Fills all of it. Deterministic: + - * / sqrt only; the faces of odd outlines may depend on the
  /// order of the patches. Time grows as n log n for meshes, memory as n.
  /// @return kOutOfMemory; the faces are then unspecified
  Status build(const PatchSet& patch_set);
};

} // namespace hemicube::radiosity
