#pragma once

#include "radiosity/form_factor/convex_union.h"

namespace hemicube::radiosity {

/// Joins the cells of a mesh to as few as it finds, in rounds: regions of paired edges as wholes;
/// when that ends, pairs across their longest edges.
class CellMerger {
public:
  explicit CellMerger(std::span<const Vec3> vertices) : mesh_(vertices) {}

  /// @param cells    becomes the joined cells, in the order of the lowest cell of each
  /// @param cell_of  receives [cell as it was] its number among the joined ones
  /// @return kOutOfMemory
  Status merge(CellSet* cells, Buffer<std::uint32_t>* cell_of);

private:
  Status begin_round();
  Status join_regions();
  Status collect_region(std::uint32_t start);
  Status join_pairs();
  Status try_join(std::span<const std::uint32_t> members, bool* joined);
  Status end_round(CellSet* cells, Buffer<std::uint32_t>* cell_of);

  CoplanarMesh mesh_;
  ConvexUnion union_;
  CellSet joined_;                 ///< what this round's unions became
  Buffer<std::uint32_t> leader_;   ///< [cell] lowest of the cells it is joined with
  Buffer<std::uint32_t> union_of_; ///< [cell] number in joined_, of a leader of others
  Buffer<std::uint32_t> region_;   ///< cells
  Buffer<std::uint8_t> visited_;   ///< [cell]
};

} // namespace hemicube::radiosity
