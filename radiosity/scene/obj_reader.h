#pragma once

#include "radiosity/scene/read_report.h"
#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hemicube::radiosity {

/// The polygons of one Wavefront OBJ file, with the names it uses; what the names mean is not its
/// matter.
struct ObjMesh {
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

  std::vector<Name> materials; ///< in order of first use by a face; "" on line 0: before any usemtl
  std::vector<Name> groups;    ///< in order of first use by a face; "" where none is given
  std::vector<Name> libraries; ///< the mtllib statements: all that follows the keyword

  std::size_t face_count() const noexcept { return corner_offsets.size() - 1; }
};

/// How much geometry fits: with all faces two-sided, patch ids still fit 32 bits.
struct ObjLimits {
  std::uint64_t faces = 0x7ffffffe;
  std::uint64_t vertices = 0xfffffffe;
};

/// Reads `v`, `f`, `g`, `usemtl` and `mtllib`; counts all other statements in report->skipped.
/// @return kBadScene `PATH:LINE: ...` for a file that is missing, no OBJ file, has no faces, or
/// says
///         something wrong: a coordinate that is not a finite number, a vertex index that is 0 or
///         names no vertex, a face with fewer than 3 corners; kIo; kOutOfMemory
Status read_obj(const std::string& path, ObjMesh* mesh, ReadReport* report,
                const ObjLimits& limits = {});

} // namespace hemicube::radiosity
