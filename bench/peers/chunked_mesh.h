#pragma once

#include "radiosity/mesh/patch_set.h"

#include <cstdint>
#include <vector>

namespace hemicube::bench {

/// A vertex as a graphics driver takes it.
struct GlVertex {
  float x, y, z;    ///< relative to the centre of the scene
  std::uint32_t id; ///< of the patch whose triangles start at it
};

/// Neighbouring patches: what is culled, sorted and drawn as one.
struct Chunk {
  Vec3 centre{0, 0, 0}, half{0, 0, 0}; ///< box, relative to the centre of the scene
  std::uint32_t first_index = 0, end_index = 0;
};

/// The patches of a scene as chunks of triangles. Patches of a chunk share vertices; the first
/// vertex of a triangle (its provoking vertex) belongs to its patch alone and holds its number.
struct ChunkedMesh {
  Vec3 centre{0, 0, 0};
  double size = 0; ///< diagonal of the scene's box
  std::vector<GlVertex> vertices;
  std::vector<std::uint32_t> indices; ///< triangles
  std::vector<Chunk> chunks;
  std::vector<std::uint32_t> chunk_of;    ///< [patch]
  std::vector<std::uint32_t> first_index; ///< [patch] of its triangles, which are consecutive
};

ChunkedMesh build_chunks(const radiosity::PatchSet& patches, std::uint32_t chunk_size);

} // namespace hemicube::bench
