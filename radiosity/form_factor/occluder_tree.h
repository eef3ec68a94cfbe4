#pragma once

#include "radiosity/form_factor/occluder_faces.h"

namespace hemicube::radiosity {

/// The bounding boxes of occluder faces in a binary tree, for shafts: which faces reach into a box.
/// It copies what it needs; queries are const and may run in parallel.
class OccluderTree {
public:
  /// @return kOutOfMemory
  Status build(const OccluderFaces& faces);

  std::uint32_t face_count() const noexcept { return static_cast<std::uint32_t>(boxes_.size()); }

  /// Calls visit(face) once for every face whose box properly overlaps the box [low, high]; returns
  /// false from visit to stop. Always in the same order, which is not ascending.
  ///
  /// Boxes overlap properly if they do so on each axis. The intervals [a, b] of a face and [c, d]
  /// of the query do if a < d and c < b: touching is not enough, for a face that lies in a side of
  /// the box blocks nothing inside. So the flat face a = b overlaps if c < a < d, and the flat
  /// query c = d if a < c < b; and two that are flat at the same place overlap: what a query in a
  /// plane asks for are the faces in that plane as well.
  /// @param low, high  low <= high on each axis
  template <typename Visit>
  void for_each_in_box(const Vec3& low, const Vec3& high, Visit visit) const;

private:
  struct Box {
    Vec3 low, high;

    void add(const Box& other) noexcept;
    bool overlaps(const Vec3& other_low, const Vec3& other_high) const noexcept;
    bool may_hold_overlapping(const Vec3& other_low, const Vec3& other_high) const noexcept;
  };

  /// The left child of an inner node follows it.
  struct Node {
    Box box;
    std::uint32_t first; ///< leaf: index into order_; else: the right child
    std::uint32_t count; ///< faces of a leaf; 0 for inner nodes
  };

  static constexpr std::size_t kLeafFaces = 4;
  static constexpr std::size_t kMostLevels = 40; ///< halves of 2^32 faces, and some to spare

  Status add_node(std::span<std::uint32_t> faces, std::uint32_t first);
  void halve(std::span<std::uint32_t> faces) const;

  Buffer<Box> boxes_;           ///< [face]
  Buffer<std::uint32_t> order_; ///< faces, leaf after leaf
  Buffer<Node> nodes_;          ///< the first is the root; none without faces
};

inline bool OccluderTree::Box::overlaps(const Vec3& other_low,
                                        const Vec3& other_high) const noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const bool proper = low[axis] < other_high[axis] && other_low[axis] < high[axis];
    const bool both_flat_here = low[axis] == high[axis] && other_low[axis] == other_high[axis] &&
                                low[axis] == other_low[axis];
    if (!proper && !both_flat_here)
      return false;
  }
  return true;
}

/// False only if no box inside of this one overlaps the other: where that is flat, one inside may
/// be flat as well.
inline bool OccluderTree::Box::may_hold_overlapping(const Vec3& other_low,
                                                    const Vec3& other_high) const noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const double a = low[axis], b = high[axis], c = other_low[axis], d = other_high[axis];
    if (c == d ? d < a || b < c : d <= a || b <= c)
      return false;
  }
  return true;
}

template <typename Visit>
void OccluderTree::for_each_in_box(const Vec3& low, const Vec3& high, Visit visit) const {
  if (nodes_.empty())
    return;
  std::uint32_t waiting[kMostLevels];
  std::size_t waiting_count = 0;
  waiting[waiting_count++] = 0;
  while (waiting_count > 0) {
    const std::uint32_t index = waiting[--waiting_count];
    const Node& node = nodes_[index];
    if (!node.box.may_hold_overlapping(low, high))
      continue;
    if (node.count == 0) {
      waiting[waiting_count++] = node.first;
      waiting[waiting_count++] = index + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      if (boxes_[order_[k]].overlaps(low, high) && !visit(order_[k]))
        return;
  }
}

} // namespace hemicube::radiosity
