#pragma once

#include "raster/math.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// What the scene readers read, and what they read over without using it.
struct ReadReport {
  std::map<std::string, std::uint64_t> skipped; ///< statements by reason, as in "textures (map_Kd)"
  std::uint64_t faces_without_material = 0;     ///< they got reflectance 0.5
  double float_grid_step = 0;                   ///< the coarsest of the meshes (float_grid.h)
  std::vector<std::string> files;               ///< every file read, once, in order

  void add_file(const std::string& path);

  /// Of vertices as a file has them, before they are moved.
  void add_float_grid(std::span<const Vec3> vertices);
};

/// Counts statements that are read over, by keyword.
class KeywordCounts {
public:
  void count(std::string_view keyword, std::uint64_t times = 1);

  /// Adds each count to report->skipped under "MEANING (KEYWORD)", in printable ASCII.
  void add_to(ReadReport* report, std::string_view (*meaning)(std::string_view keyword)) const;

private:
  std::map<std::string, std::uint64_t, std::less<>> counts_;
};

} // namespace hemicube::radiosity
