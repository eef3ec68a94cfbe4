#pragma once

#include "radiosity/mesh/patch_set.h"

#include <span>

namespace hemicube::radiosity {

/// Cuts patches into smaller ones until every edge is at most as long as the patches on both sides
/// of it ask for. Edges are halved, round by round, and always for all patches on them, so that
/// shared edges stay shared and no vertex ends up in the middle of a neighbour's edge. To that end
/// a cut edge also cuts the opposite edge of a quad and all edges of any other polygon, in patches
/// with max_edge 0 as well. Patches are neighbours where the places of their vertices are the same,
/// whatever the indices; a new vertex is shared by index where both ends are.
///
/// A quad becomes 2 or 4 quads, a triangle 4 triangles, a larger polygon one quad per corner about
/// the mean of its vertices (which, unlike other centres, always leaves convex quads). The pieces
/// take the place of their patch, in the order of its corners (the middle triangle last), each with
/// the corner it keeps at that corner's position. They inherit face, material and group; vertices
/// of the coarse set keep their index.
///
/// @param coarse    fronts only, measured (build_patches)
/// @param max_edge  [patch of coarse] metres, 0 = no limit
/// @param fine      another set than coarse; parent = patch of coarse; measured; unspecified after
/// an error
/// @param report    non_manifold_faces is set: faces with a piece in `coarse` that the half-edges
/// cannot
///                  connect (a third patch on an edge, opposite orientation); they are cut all the
///                  same, to match their neighbours, but share no new vertices there by index
///                  unless both ends are shared. Nothing is counted where no patch has a limit.
/// @return kInvalidArgument for a wrong size, backs in `coarse`, or a max_edge that is negative or
/// not
///         finite; kBadScene for a max_edge that makes more patches than can be numbered, or pieces
///         smaller than double precision resolves; kOutOfMemory
/// Deterministic: + - * / sqrt only.
Status subdivide(const PatchSet& coarse, std::span<const double> max_edge, PatchSet* fine,
                 MeshReport* report);

} // namespace hemicube::radiosity
