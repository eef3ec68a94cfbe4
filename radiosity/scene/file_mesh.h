#pragma once

#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hemicube::radiosity {

/// The polygons of one mesh file, with the names it uses; what the names mean is not its matter.
struct FileMesh {
  /// A name and the line of the statement that gave it.
  struct Name {
    std::string text;
    std::uint64_t line = 0;
  };

  Buffer<Vec3> vertices; ///< as in the file, bit for bit
  Buffer<std::uint64_t>
      corner_offsets;            ///< [face_count + 1]; face f has corners offsets[f]..offsets[f+1]
  Buffer<std::uint32_t> corners; ///< vertex indices from 0, in the file's order
  Buffer<std::uint32_t> face_material; ///< [face], into materials
  Buffer<std::uint32_t> face_group;    ///< [face], into groups

  std::vector<Name> materials; ///< in order of first use by a face; "" on line 0: none is given
  std::vector<Name> groups;    ///< in order of first use by a face; "" where none is given
  std::vector<Name> libraries; ///< the mtllib statements of an OBJ file: all behind the keyword

  std::size_t face_count() const noexcept { return corner_offsets.size() - 1; }
};

/// How much geometry fits: with all faces two-sided, patch ids still fit 32 bits.
struct MeshLimits {
  std::uint64_t faces = 0x7ffffffe;
  std::uint64_t vertices = 0xfffffffe;
};

} // namespace hemicube::radiosity
