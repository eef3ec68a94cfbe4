#pragma once

#include "radiosity/mesh/patch_set.h"

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include <cstdint>
#include <vector>

namespace hemicube::radiosity {

/// The patches of a set as half-edges. Face handle k is patch k. Vertices at the same place are one
/// vertex here, whatever their index, so that patches of files that repeat vertices are connected.
struct HalfEdges {
  OpenMesh::PolyConnectivity mesh;
  /// [corner of the patch set] the half-edge that leaves this corner inside its patch
  std::vector<OpenMesh::HalfedgeHandle> leaving;
  /// Patches the kernel cannot connect: those with a third patch on an edge, a neighbour of the
  /// opposite orientation, or a crowded vertex. They are faces with vertices of their own.
  /// Ascending.
  std::vector<std::uint32_t> unconnected;
  /// [edge] the next edge with the same two end places, in a ring; an edge of its own follows
  /// itself
  std::vector<OpenMesh::EdgeHandle> next_coincident;
};

/// Connects the patches of a set, in patch order, so that the result does not depend on anything
/// else.
/// @param half_edges  a new one
/// @return kBadScene for more than 2^30 corners, which OpenMesh cannot number; kOutOfMemory
/// Nothing is printed; not to be run beside other users of OpenMesh's message streams.
Status build_half_edges(const PatchSet& patches, HalfEdges* half_edges);

} // namespace hemicube::radiosity
