#pragma once

#include "radiosity/form_factor/convex_polygon.h"
#include "radiosity/mesh/patch_set.h"

namespace hemicube::radiosity {

inline constexpr std::uint32_t kNoHalfEdge = 0xffffffff;

/// A planar convex polygon that stands for the patches that tile it.
struct Cell {
  Plane plane;           ///< unit Newell normal, through the mean of the corners
  double resolution = 0; ///< lengths below this are rounding of its coordinates
  double slack = 0;      ///< how far its patches may lie off its plane and outline; <= resolution
  bool can_join = false; ///< false if it has too many corners, or is not planar within rounding
};

/// Cells over shared vertices. Corners are vertices of the patches, the lowest at each place.
struct CellSet {
  static constexpr std::uint32_t kMostCorners = 32;

  Buffer<Cell> cells;
  Buffer<std::uint32_t> offsets; ///< [cell + 1]
  Buffer<std::uint32_t> corners; ///< vertices, counter-clockwise seen from the front

  std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(cells.size()); }
  std::span<const std::uint32_t> corners_of(std::uint32_t cell) const noexcept {
    return corners.span().subspan(offsets[cell], offsets[cell + 1] - offsets[cell]);
  }
  Status append(const Cell& cell, std::span<const std::uint32_t> corners_of_cell) noexcept;

  /// One cell per patch. @return kOutOfMemory
  Status init(const PatchSet& patches);
};

/// How the cells of a set hang together in their planes. Half-edge h runs from corners[h] to
/// corners[next(h)] with its cell on the left.
class CoplanarMesh {
public:
  explicit CoplanarMesh(std::span<const Vec3> vertices) : vertices_(vertices) {}

  /// Pairs the half-edges of coplanar cells of one orientation that run along each other; where
  /// more than two could be paired (coincident cells), none is.
  /// @param cells  must outlive the mesh's use
  /// @param split  also pairs an edge with a chain of several: it gets the chain's vertices as
  ///               corners (of the mesh, not of the set)
  /// @return kOutOfMemory
  Status connect(const CellSet& cells, bool split);

  const Vec3& position(std::uint32_t vertex) const noexcept { return vertices_[vertex]; }
  std::size_t vertex_count() const noexcept { return vertices_.size(); }
  std::uint32_t cell_count() const noexcept { return set_->count(); }
  std::uint32_t half_edge_count() const noexcept {
    return static_cast<std::uint32_t>(corners_.size());
  }
  const Cell& cell(std::uint32_t index) const noexcept { return set_->cells[index]; }
  /// What splitting an edge moved it by; adds to the slack of its cell.
  double split_slack(std::uint32_t cell) const noexcept { return split_slack_[cell]; }

  std::uint32_t begin(std::uint32_t cell) const noexcept { return offsets_[cell]; }
  std::uint32_t end(std::uint32_t cell) const noexcept { return offsets_[cell + 1]; }
  std::uint32_t next(std::uint32_t h) const noexcept {
    const std::uint32_t c = cell_of_[h];
    return h + 1 == offsets_[c + 1] ? offsets_[c] : h + 1;
  }
  std::uint32_t from(std::uint32_t h) const noexcept { return corners_[h]; }
  std::uint32_t to(std::uint32_t h) const noexcept { return corners_[next(h)]; }
  Vec3 vector(std::uint32_t h) const noexcept { return vertices_[to(h)] - vertices_[from(h)]; }
  std::uint32_t cell_of(std::uint32_t h) const noexcept { return cell_of_[h]; }
  /// The half-edge along the other side, of a coplanar cell, or kNoHalfEdge.
  std::uint32_t twin(std::uint32_t h) const noexcept { return twin_[h]; }
  /// Separates a half-edge from its twin.
  void part(std::uint32_t h) noexcept {
    twin_[twin_[h]] = kNoHalfEdge;
    twin_[h] = kNoHalfEdge;
  }

private:
  bool coplanar(std::uint32_t a, std::uint32_t b) const;
  bool lies_in(std::uint32_t cell, const Plane& plane, double tolerance) const;
  Status name_cells();
  Status bucket_by_vertex(bool unpaired_from);
  Status pair();
  void pair_run(std::span<const std::uint32_t> half_edges);
  Status find_chains(bool* any);
  std::size_t chain_along(std::uint32_t h, double* off);
  std::uint32_t link(std::uint32_t h, std::uint32_t at, double* off) const;
  Status insert_chains();

  std::span<const Vec3> vertices_;
  const CellSet* set_ = nullptr;
  Buffer<std::uint32_t> offsets_, corners_, cell_of_, twin_;
  Buffer<std::uint32_t> bucket_begin_, bucket_;      ///< half-edges by a vertex
  Buffer<std::uint32_t> chain_begin_, chain_length_; ///< [half-edge] into chains_
  Buffer<std::uint32_t> chains_;                     ///< vertices, from the end of the edge back
  Buffer<double> split_slack_;                       ///< [cell]
};

} // namespace hemicube::radiosity
