#pragma once

#include "radiosity/scene/file_mesh.h"
#include "radiosity/scene/read_report.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>

namespace hemicube::radiosity {

/// A material of an MTL file, in the bands r, g, b.
struct MtlMaterial {
  std::string file; ///< where its newmtl stands
  std::uint64_t line = 0;
  std::uint64_t reflectance_line = 0;  ///< of its Kd; 0: it has none, and reflects nothing
  std::uint64_t exitance_line = 0;     ///< of its Ke; 0: it has none, and emits nothing
  std::array<double, 3> reflectance{}; ///< Kd, 0..1
  std::array<double, 3> exitance{};    ///< Ke, W/m^2, >= 0
};

using MtlLibrary = std::map<std::string, MtlMaterial>; ///< by name

/// Adds the materials of one Wavefront MTL file to a library: `newmtl`, `Kd`, `Ke`; counts all
/// other statements in report->skipped.
/// @return kBadScene `PATH:LINE: ...` for a file that is missing or no MTL file, a value that is no
///         finite number or out of range, a spectral or xyz colour, a statement given twice, a name
///         that the library has already; kIo; kOutOfMemory
Status read_mtl(const std::string& path, MtlLibrary* library, ReadReport* report);

/// Reads the libraries that the mtllib statements of an OBJ file name, relative to its folder. What
/// follows mtllib is one file name, spaces included, if there is such a file, else several.
/// @return also kBadScene `OBJ:LINE: ...` for a library that does not exist
Status read_libraries(const std::string& obj_path, const FileMesh& mesh, MtlLibrary* library,
                      ReadReport* report);

} // namespace hemicube::radiosity
