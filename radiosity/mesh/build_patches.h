#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/scene/scene.h"

namespace hemicube::radiosity {

// The order of calls: build_patches, then subdivide (openmesh_subdivide.h) where wanted, then
// add_back_sides. All are deterministic (+ - * / sqrt only); after an error the patches are
// unspecified.

/// Turns the faces of a scene into patches, in file order, vertices kept bit for bit. Faces that
/// name a vertex twice or have no area are dropped; faces whose vertices lie further than 1e-3 of
/// their size from their best-fit plane (warped), and else those that are not convex (concave), are
/// cut into triangles. A corner at the very place of the one before it is left out: the polygon is
/// the same.
/// @param patches  face = number of the face in the scene; parent = own number; no backs yet
/// @param report   set; all counts are of faces
/// @return kBadScene if no patch is left, if an area is too large for a double, if a concave face
/// has
///         more than 65536 corners, or for more patches or corners than can be numbered;
///         kOutOfMemory
Status build_patches(const Scene& scene, PatchSet* patches, MeshReport* report);

/// Fills area, centre and normal from vertices and corners.
/// @return kBadScene if a patch has no area in double precision; kOutOfMemory
Status measure_patches(PatchSet* patches);

/// Adds the backs of the patches whose material is two-sided, after all fronts: corners reversed
/// (the first stays first), normal negated, all else the same bits; parent as if the backs had been
/// added before subdivision.
/// @return kBadScene for more patches or corners than can be numbered; kOutOfMemory
Status add_back_sides(const Scene& scene, PatchSet* patches);

/// kBadScene if a mesh of that size cannot be numbered: patches by the item buffers
/// (kMaxPolygonCount, a number less), corners and vertices by 32 bits.
/// @param remedy  ends the message: what to do about it
Status check_mesh_size(std::uint64_t patches, std::uint64_t corners, std::uint64_t vertices,
                       const char* remedy);

} // namespace hemicube::radiosity
