#pragma once

#include "radiosity/scene/name_table.h"
#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// A pinhole camera, in the unit of the vertices; the picture has `up` up and looks along target -
/// position.
struct Camera {
  static constexpr std::uint32_t kMaxSize = 16384; ///< pixels along either side of a picture
  /// `up` must be off the line of sight by at least this sine to say which way is up.
  static constexpr double kMinUpSine = 1e-6;

  Vec3 position{0, 0, 0};
  Vec3 target{0, 0, -1};
  Vec3 up{0, 1, 0};
  double vertical_field_of_view = 40; ///< degrees, 0 < v < 180, of the whole picture height
  std::uint32_t width = 600;          ///< pixels
  std::uint32_t height = 600;         ///< pixels
};

/// Surfaces and light as read from a file, before any meshing. Plain data; filled by a reader,
/// which has checked it: indices in range, coordinates finite, 0 <= reflectance <= 1, exitance >=
/// 0.
struct Scene {
  NameTable bands;     ///< at least one; default r, g, b
  NameTable materials; ///< unique
  NameTable groups;    ///< unique; the OBJ `g` names, "" where none was given

  Buffer<double> reflectance;     ///< [material][band], 0..1
  Buffer<double> exitance;        ///< [material][band], W/m^2, >= 0
  Buffer<std::uint8_t> two_sided; ///< [material], 0 or 1
  Buffer<double> space_exitance; ///< [band], W/m^2: what an unblocked direction radiates; default 0

  Buffer<Vec3> vertices; ///< metres: a reader has applied the scene's units
  Buffer<std::uint64_t>
      corner_offsets;            ///< [face_count + 1]; face f has corners offsets[f]..offsets[f+1]
  Buffer<std::uint32_t> corners; ///< vertex indices, counter-clockwise seen from the front
  Buffer<std::uint32_t> face_material; ///< [face]
  Buffer<std::uint32_t> face_group;    ///< [face]
  Buffer<double> face_max_edge;        ///< [face], 0 = not subdivided; empty = none is

  bool has_camera = false;
  Camera camera;

  std::size_t face_count() const noexcept {
    return corner_offsets.empty() ? 0 : corner_offsets.size() - 1;
  }
  std::uint32_t band_count() const noexcept { return bands.size(); }
};

} // namespace hemicube::radiosity
