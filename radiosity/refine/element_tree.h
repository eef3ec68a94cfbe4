#pragma once

#include "radiosity/discontinuity/split_edges.h"
#include "radiosity/scene/scene.h"

#include <vector>

namespace hemicube::radiosity {

/// Patches and the elements they are cut into (Cohen et al. 1986): a tree for every front, whose
/// leaves are the elements. Edges are halved, always by the same bits from both sides, or cut where
/// a straight corner of a patch is: the vertex of a neighbour. A quad becomes 4 quads, or 2 where
/// it is much longer than wide; a triangle 4 triangles; a larger polygon one quad per corner about
/// the mean of its vertices.
class ElementTree {
public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Begins with the patches themselves. @param patches  outlive this
  Status init(const Scene& scene, const PatchSet& patches);

  /// Elements of the mesh there is now: leaves, and the backs of two-sided ones.
  std::uint64_t element_count() const noexcept { return element_count_; }
  /// Of a leaf: 1, or 2 if its back is an element, too.
  std::uint32_t side_count(std::uint32_t node) const noexcept;
  std::size_t node_count() const noexcept { return nodes_.size(); }
  std::uint32_t patch_of(std::uint32_t node) const noexcept { return nodes_[node].patch; }
  std::uint32_t parent(std::uint32_t node) const noexcept { return nodes_[node].parent; }
  bool is_leaf(std::uint32_t node) const noexcept { return nodes_[node].child_count == 0; }
  /// [child] of a node that was split.
  std::uint32_t child(std::uint32_t node, std::uint32_t k) const noexcept {
    return nodes_[node].first_child + k;
  }
  std::uint32_t child_count(std::uint32_t node) const noexcept { return nodes_[node].child_count; }
  /// The corners of a node, counter-clockwise seen from the front, without hanging vertices.
  void corners_of(std::uint32_t node, std::vector<Vec3>* corners) const;

  /// Into how many elements a leaf would be cut; 0 if it cannot be: if that would leave edges
  /// shorter than min_edge, or pieces that double precision does not resolve.
  std::uint32_t pieces_of(std::uint32_t leaf, double min_edge) const;

  /// Cuts a leaf with pieces_of() > 0.
  void split(std::uint32_t leaf);

  /// Leaves, in the order of elements: of patches in ascending order, of children first to last.
  std::vector<std::uint32_t> leaves() const;

  /// Leaves with a side that has more than one hanging vertex: their neighbour is cut finer by more
  /// than one step.
  std::vector<std::uint32_t> uneven_leaves() const;

  /// The elements as a mesh without T-vertices of its own making: where the neighbour of an element
  /// is cut finer, the vertex in the middle of the common edge is a corner of both. The fronts are
  /// leaves(), the backs of two-sided ones follow in the same order; parent = patch.
  /// @return as add_back_sides
  Status make_mesh(PatchSet* elements) const;

private:
  struct Node {
    std::uint32_t patch;
    std::uint32_t parent = kNone;
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0;
    std::size_t first_corner = 0;
    std::uint32_t corner_count = 0;
  };
  /// Which edges of a polygon are halved, as a quad: those along 0 and 2, along 1 and 3.
  struct Cut {
    bool along_0 = true, along_1 = true;
  };

  void add_patch(std::uint32_t patch, std::span<const std::uint8_t> is_straight);
  void hang(std::span<const std::uint32_t> side);
  bool is_uneven_edge(std::uint32_t a, std::uint32_t b) const;
  std::span<const std::uint32_t> corners(std::uint32_t node) const noexcept;
  const Vec3& point(std::uint32_t node, std::size_t corner) const noexcept;
  double edge_length(std::uint32_t node, std::size_t k) const noexcept;
  Cut cut_of(std::uint32_t node) const noexcept;
  std::uint32_t make_middle(std::uint32_t a, std::uint32_t b);
  std::uint32_t make_centre(std::uint32_t node, std::span<const std::uint32_t> middles);
  void add_child(std::uint32_t parent, std::initializer_list<std::uint32_t> corners);

  const Scene* scene_ = nullptr;
  const PatchSet* patches_ = nullptr;
  std::vector<Node> nodes_; ///< the first are the fronts
  std::vector<std::uint32_t> corners_;
  SplitEdges vertices_;                ///< those of the patches first
  std::uint32_t first_own_vertex_ = 0; ///< those before are of the patches
  std::uint64_t element_count_ = 0;
};

} // namespace hemicube::radiosity
