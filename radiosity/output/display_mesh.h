#pragma once

#include "radiosity/output/corner_vertices.h"
#include "radiosity/scene/scene.h"

#include <span>
#include <vector>

namespace hemicube::radiosity {

/// Triangles that show the light of a mesh, given at their vertices.
struct DisplayMesh {
  std::vector<float> positions; ///< [vertex][3] metres: those of CornerVertices, then added ones
  std::vector<float> radiances; ///< [vertex][3] red, green, blue of L = B / pi, W/(m^2 sr)
  std::vector<std::uint32_t> triangles; ///< [triangle][3] vertices, by material, then by patch
  std::vector<std::size_t> first;       ///< [material + 1] into triangles

  std::size_t vertex_count() const noexcept { return positions.size() / 3; }
};

/// Cuts patches into triangles. A quad is cut along the diagonal whose ends differ less in
/// radiance, the shorter one if there is no difference. A patch with straight corners becomes a fan
/// about its centre, an added vertex with the interpolated radiance: so every hanging vertex is a
/// corner of triangles on both sides, and none of them is flat. Other patches become a fan about
/// their first corner. Triangles that have no area in float positions are left out.
/// @return kOutOfMemory
Status build_display_mesh(const Scene& scene, const PatchSet& patches,
                          const CornerVertices& vertices, DisplayMesh* mesh);

} // namespace hemicube::radiosity
