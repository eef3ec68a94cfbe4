#pragma once

#include "radiosity/discontinuity/side_changes.h"
#include "radiosity/discontinuity/split_edges.h"

#include <span>
#include <vector>

namespace hemicube::radiosity {

/// Cuts patches into convex cells along lines. A cut goes on to the border of the cell it is in.
/// Patches that share an edge keep sharing it: a vertex that one of them gets there is a corner of
/// the other one, too.
class PatchCutter {
public:
  /// @param patches  fronts only; outlive this
  Status init(const PatchSet& patches);

  std::uint64_t cell_count() const noexcept { return cell_count_; }

  /// Cuts the cells of a patch that a line runs through. Corners closer to it than `snap` are taken
  /// to lie on it, so that no edge shorter than `snap` comes about; where it runs along an edge,
  /// nothing is cut.
  /// @param light  across the line; where it jumps, the ends become vertices
  /// @param snap   metres, more than the resolution of the coordinates
  void cut(std::uint32_t patch, const Vec3& begin, const Vec3& end, EdgeLight light, double snap);

  /// Notes what light does across the edges of cells that a line takes up, closer to it than
  /// `snap`: after all cuts, for a cut that goes on beyond the line is not of it.
  void note_light(std::uint32_t patch, const Vec3& begin, const Vec3& end, EdgeLight light,
                  double snap);

  /// The cells as a mesh of fronts, those of a patch one after the other, with its face and parent.
  /// @return as measure_patches
  Status make_mesh(PatchSet* cells) const;

private:
  using Cell = std::vector<std::uint32_t>; ///< vertices, counter-clockwise

  struct Line;

  /// How a line meets a cell that it runs through.
  struct Crossing {
    SideChange enters, leaves; ///< in the order of corners
    double begin = 0, end = 0; ///< of the chord, metres along the line
  };

  bool may_touch(const Cell& cell, const Line& line, double snap) const;
  bool find_crossing(const Cell& cell, const Line& line, double snap, Crossing* crossing) const;
  bool cut_cell(std::uint32_t patch, std::size_t cell, const Crossing& crossing,
                std::uint32_t ends[2]);
  void split_at(std::uint32_t a, std::uint32_t b, const Line& line, double along, double snap);
  bool has_resolved_area(const Cell& cell) const;

  void insert_hanging(Cell* cell) const;
  std::uint32_t split_edge(std::uint32_t a, std::uint32_t b, double share);

  const PatchSet* patches_ = nullptr;
  std::vector<std::vector<Cell>> cells_; ///< [patch]
  SplitEdges vertices_;                  ///< those of the patches first
  std::uint64_t cell_count_ = 0;
};

} // namespace hemicube::radiosity
