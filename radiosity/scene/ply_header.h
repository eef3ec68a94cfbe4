#pragma once

#include "raster/status.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t byte_count(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8; ///< of a list: how its length is written
  PlyType type = PlyType::kFloat32;     ///< of the value, or of each value of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t line = 0;
  std::uint64_t count = 0; ///< how many items the header says there are
  std::vector<PlyProperty> properties;
};

/// What the header of a PLY file says.
struct PlyHeader {
  enum class Encoding { kText, kLittleEndian, kBigEndian };

  Encoding encoding = Encoding::kText;
  std::vector<PlyElement> elements; ///< in file order
  std::uint64_t line_count = 0;     ///< lines of the header, end_header included
  std::size_t size = 0;             ///< bytes of the header: where the values begin
};

/// Reads the header of a PLY file.
/// @param bytes  of the whole file
/// @return kBadScene `PATH:LINE: ...`
Status parse_ply_header(std::string_view bytes, const std::string& path, PlyHeader* header);

} // namespace hemicube::radiosity
