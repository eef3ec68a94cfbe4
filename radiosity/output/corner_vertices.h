#pragma once

#include "radiosity/mesh/patch_set.h"

#include <span>
#include <vector>

namespace hemicube::radiosity {

/// The vertices of a mesh file: corners of equal position and light, as floats, are one vertex.
struct CornerVertices {
  std::size_t width = 0;                ///< floats a vertex: x, y, z in metres, then B per band
  std::vector<float> values;            ///< [vertex][width], in the order of their first corners
  std::vector<std::uint32_t> of_corner; ///< [corner] its vertex

  std::size_t count() const noexcept { return values.size() / width; }
  const float* position(std::size_t vertex) const noexcept { return &values[vertex * width]; }
  const float* radiosity(std::size_t vertex) const noexcept { return position(vertex) + 3; }
};

/// @param corner_radiosity  from vertex_radiosities(), [corner][band]
CornerVertices gather_corner_vertices(const PatchSet& patches,
                                      std::span<const float> corner_radiosity,
                                      std::uint32_t band_count);

} // namespace hemicube::radiosity
