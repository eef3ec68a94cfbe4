#pragma once

#include "radiosity/form_factor/coplanar_cells.h"

namespace hemicube::radiosity {

/// Tells whether cells of a mesh tile one convex polygon, and which.
///
/// Where half-edges are paired the cells lie side by side, so a point is covered as often as the
/// unpaired half-edges wind around it. If those form a single loop, and that is a convex polygon,
/// its inside is covered exactly once: holes and overlaps cannot hide from that.
class ConvexUnion {
public:
  /// @param mesh  must outlive the union's use; connect() it first
  /// @return kOutOfMemory
  Status init(const CoplanarMesh& mesh);

  /// @return true if the cells, at least one, tile a convex polygon of at most
  /// CellSet::kMostCorners corners, with all their corners within its resolution of its plane and
  /// none cut off or left over by more than that; then cell() and corners() describe it. Corners
  /// on its edges are gone.
  bool join(std::span<const std::uint32_t> cells);

  const Cell& cell() const noexcept { return cell_; }
  std::span<const std::uint32_t> corners() const noexcept { return {kept_, kept_count_}; }

private:
  bool find_outline(std::span<const std::uint32_t> cells);
  bool find_plane(std::span<const std::uint32_t> cells);
  bool find_corners();
  void measure_edges();
  bool corners_are_convex() const;

  const Vec3& outline(std::size_t place) const { return mesh_->position(outline_[place]); }
  const Vec3& corner(std::size_t k) const { return mesh_->position(kept_[k % kept_count_]); }

  const CoplanarMesh* mesh_ = nullptr;
  std::uint32_t stamp_ = 0;
  Buffer<std::uint32_t> member_;  ///< [cell] stamp of the last union with it
  Buffer<std::uint32_t> leaving_; ///< [vertex] half-edge of the outline from it
  Buffer<std::uint32_t> outline_; ///< vertices
  std::size_t outline_count_ = 0;
  Buffer<std::uint32_t> stack_; ///< places in the outline
  std::size_t stack_count_ = 0;

  Cell cell_;
  double off_ = 0; ///< how far a corner lies from where it should be, at most
  std::uint32_t kept_[CellSet::kMostCorners];
  std::size_t kept_count_ = 0;
};

} // namespace hemicube::radiosity
