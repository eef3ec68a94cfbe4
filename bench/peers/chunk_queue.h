#pragma once

#include "bench/peers/chunked_mesh.h"
#include "raster/face_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace hemicube::bench {

/// A face of a hemicube seen from the centre of the scene: directions in its axes, and the eye.
struct FaceFrame {
  Vec3 right, up, forward;
  Vec3 eye; ///< relative to the centre of the scene
  bool side;
};

inline FaceFrame face_frame(const raster::View& view, raster::Face face, const Vec3& centre) {
  const auto axis = [&](const Vec3& v) {
    const Vec3 a = raster::from_face(face, v);
    return view.axis_x * a.x + view.axis_y * a.y + view.axis_z * a.z;
  };
  return {axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1}), view.eye - centre,
          face != raster::Face::kTop};
}

/// Clip coordinates of points relative to the centre of the scene. The eye is folded in before
/// anything is rounded to float. A side shows 0 <= up <= forward, the top |up| <= forward. Depth is
/// near / forward: 1 at the near plane, 0 at infinity.
inline std::array<float, 16> clip_matrix(const FaceFrame& frame, double near) {
  const Vec3 y = frame.side ? frame.up * 2.0 - frame.forward : frame.up;
  const Vec3* rows[] = {&frame.right, &y, nullptr, &frame.forward};
  std::array<float, 16> matrix{}; // column after column
  for (std::size_t row = 0; row < 4; ++row) {
    if (rows[row] == nullptr)
      continue;
    for (int column = 0; column < 3; ++column)
      matrix[static_cast<std::size_t>(column) * 4 + row] = static_cast<float>((*rows[row])[column]);
    matrix[12 + row] = static_cast<float>(-glm::dot(*rows[row], frame.eye));
  }
  matrix[14] = static_cast<float>(near);
  return matrix;
}

/// Whether all of a box is where a linear function of the direction from the eye is negative.
inline bool is_outside(const Vec3& normal, const Vec3& centre, const Vec3& half) {
  return glm::dot(normal, centre) + std::fabs(normal.x) * half.x + std::fabs(normal.y) * half.y +
             std::fabs(normal.z) * half.z <
         0;
}

/// The chunks that a face shows, nearest first.
class ChunkQueue {
public:
  struct Entry {
    float distance; ///< squared, to the nearest point of the box
    std::uint32_t chunk;
  };

  const std::vector<Entry>& sort(const ChunkedMesh& mesh, const FaceFrame& frame) {
    const Vec3 planes[] = {frame.forward + frame.right, frame.forward - frame.right,
                           frame.forward - frame.up,
                           frame.side ? frame.up : frame.forward + frame.up};
    entries_.clear();
    for (std::uint32_t k = 0; k < mesh.chunks.size(); ++k) {
      const Chunk& chunk = mesh.chunks[k];
      const Vec3 centre = chunk.centre - frame.eye;
      if (std::any_of(std::begin(planes), std::end(planes),
                      [&](const Vec3& normal) { return is_outside(normal, centre, chunk.half); }))
        continue;
      double squared = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double gap = std::max(0.0, std::fabs(centre[axis]) - chunk.half[axis]);
        squared += gap * gap;
      }
      entries_.push_back({static_cast<float>(squared), k});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.distance < b.distance || (a.distance == b.distance && a.chunk < b.chunk);
    });
    return entries_;
  }

private:
  std::vector<Entry> entries_;
};

} // namespace hemicube::bench
