#pragma once

#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>

namespace hemicube::raster {

/// What grouping needs to know of a polygon.
struct Groupable {
  Vec3 low{0, 0, 0}, high{0, 0, 0}; ///< its box
  std::uint8_t direction = 0;       ///< of its front: one of kDirections
  std::uint8_t corner_class = 0;    ///< polygons of different classes never share a group
};

inline constexpr int kDirections = 6;

/// Polygons order[first .. first + count): one of the nodes of a binary tree.
struct Group {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::uint32_t first = 0, count = 0;
  std::uint32_t halves[2] = {kNone, kNone}; ///< groups; none if it is small enough to be a cluster
  std::uint32_t clusters = 1;               ///< into which it is divided
  double area = 0;                          ///< of its box

  bool is_cluster() const noexcept { return halves[0] == kNone; }
};

/// Divides polygons, from all of them down to groups of at most kBatch, so that the boxes of the
/// groups are small: the chance that a hemicube has to look into a box grows with its surface
/// (the surface area heuristic), and so do groups that face in several directions: one of them
/// is mostly hidden.
/// @param order   permuted
/// @param groups  the first holds everything; empty without polygons
/// Source: Goldsmith and Salmon 1987; binning as in Wald 2007, "On fast construction of SAH-based
/// bounding volume hierarchies".
Status group_polygons(std::span<const Groupable> polygons, std::span<std::uint32_t> order,
                      Buffer<Group>* groups);

} // namespace hemicube::raster
