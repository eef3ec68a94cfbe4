#pragma once

#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// What light does across an edge of a patch, where another patch goes on beside it.
enum class EdgeLight : std::uint8_t {
  kSmooth, ///< nothing
  kBends,  ///< its slope changes: the border of a shadow
  kJumps   ///< its value changes: something stands on the surface there
};

/// Planar convex polygons that emit and reflect from their front: the unknowns. Structure of
/// arrays, indexed by patch. Order: fronts in file order of their faces (pieces of one face
/// consecutive), then the backs of two-sided faces in the same order, each with reversed corners.
struct PatchSet {
  Buffer<Vec3> vertices;                ///< metres
  Buffer<std::uint32_t> corner_offsets; ///< [patch_count + 1]
  Buffer<std::uint32_t> corners;        ///< vertex indices, counter-clockwise seen from the front

  /// [corner] of the edge from this corner to the next, the same from both sides; empty = all
  /// smooth
  Buffer<EdgeLight> edge_light;

  Buffer<std::uint32_t> face;     ///< 0-based number of the input face, dropped faces counted
  Buffer<std::uint32_t> parent;   ///< the patch before subdivision that this one is a part of
  Buffer<std::uint32_t> material; ///< index into Scene::materials
  Buffer<std::uint32_t> group;    ///< index into Scene::groups

  Buffer<double> area; ///< m^2, > 0
  Buffer<Vec3> centre; ///< area centroid
  Buffer<Vec3> normal; ///< unit, Newell

  std::uint32_t front_count = 0; ///< patches before the first back of a two-sided face

  std::uint32_t patch_count() const noexcept { return static_cast<std::uint32_t>(area.size()); }
  std::span<const std::uint32_t> corners_of(std::uint32_t patch) const noexcept {
    return corners.span().subspan(corner_offsets[patch],
                                  corner_offsets[patch + 1] - corner_offsets[patch]);
  }
  EdgeLight light_across(std::size_t corner) const noexcept {
    return edge_light.empty() ? EdgeLight::kSmooth : edge_light[corner];
  }
};

/// What meshing changed or noticed, in faces.
struct MeshReport {
  std::uint64_t dropped_repeated_index = 0; ///< faces that name a vertex twice
  std::uint64_t dropped_zero_area = 0;      ///< faces without area
  std::uint64_t triangulated_concave = 0; ///< faces cut into triangles because they are not convex
  std::uint64_t triangulated_warped = 0;  ///< faces cut into triangles because they are not planar
  std::uint64_t duplicate_faces = 0;      ///< faces with the vertex set of an earlier face (kept)
  std::uint64_t non_manifold_faces = 0; ///< faces the half-edge structure could not connect (kept)
};

} // namespace hemicube::radiosity
