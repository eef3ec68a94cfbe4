#pragma once

#include "radiosity/mesh/patch_set.h"

#include <span>
#include <unordered_map>
#include <vector>

namespace hemicube::radiosity {

/// The vertices of a mesh that is being cut, and what its edges share: the vertex that cuts one,
/// whoever cut it, and what light does across it. Edges go by the positions of their ends, so that
/// polygons with vertices of their own at one place share them, too. Everything is looked up only,
/// never walked: the order of cuts alone decides.
class SplitEdges {
public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  const std::vector<Vec3>& positions() const noexcept { return positions_; }
  std::uint32_t vertex_count() const noexcept {
    return static_cast<std::uint32_t>(positions_.size());
  }
  const Vec3& operator[](std::uint32_t vertex) const noexcept { return positions_[vertex]; }
  /// The first vertex at the same position.
  std::uint32_t place(std::uint32_t vertex) const noexcept { return places_[vertex]; }

  std::uint32_t add_vertex(const Vec3& position);

  /// The vertex that cuts an edge first; kNone if none does.
  std::uint32_t split(std::uint32_t a, std::uint32_t b) const;
  /// Lets a vertex cut an edge, unless one does.
  void set_split(std::uint32_t a, std::uint32_t b, std::uint32_t vertex);
  /// The vertices between the ends of an edge, from a to b.
  void append_hanging(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>* corners) const;

  EdgeLight light_across(std::uint32_t a, std::uint32_t b) const;
  /// Of several the most that light does.
  void note_light(std::uint32_t a, std::uint32_t b, EdgeLight light);
  /// Appends what light does across each edge of a polygon.
  Status append_lights(std::span<const std::uint32_t> polygon, Buffer<EdgeLight>* lights) const;

private:
  struct PositionHash {
    std::size_t operator()(const Vec3& position) const noexcept;
  };

  std::uint64_t key(std::uint32_t a, std::uint32_t b) const noexcept;

  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> places_;
  std::unordered_map<Vec3, std::uint32_t, PositionHash> vertex_at_;
  std::unordered_map<std::uint64_t, std::uint32_t> splits_;
  std::unordered_map<std::uint64_t, EdgeLight> lights_; ///< where it is not smooth
};

} // namespace hemicube::radiosity
