#pragma once

#include "raster/kernels.h"
#include "raster/polygons.h"

namespace hemicube::raster {

/// A set of polygons as the rasterizer walks it: clusters of up to kBatch polygons that lie close
/// together and mostly face the same way, their corners spread out for vectors, under nodes of up
/// to kBatch children, clusters or nodes. It copies what it needs; one tree serves any number of
/// rasterizers. About 200 bytes a quad. What is drawn never depends on how the polygons were
/// grouped.
class PolygonTree {
public:
  /// @return kInvalidArgument for too many polygons; kOutOfMemory
  Status build(const Polygons& polygons);

  std::uint32_t polygon_count() const noexcept { return static_cast<std::uint32_t>(place_.size()); }

  std::uint32_t cluster_count() const noexcept {
    return static_cast<std::uint32_t>(clusters_.size());
  }
  Cluster cluster(std::uint32_t index) const noexcept {
    const ClusterRecord& c = clusters_[index];
    const double* planes = numbers_.data() + c.numbers;
    return {planes + kPlaneNumbers * kBatch, planes, &ids_[std::size_t{index} * kBatch],
            c.corner_count, c.present};
  }
  /// Asks for a node or a cluster before it is needed.
  void prefetch(std::uint32_t index, bool is_cluster) const noexcept {
    const char* from = reinterpret_cast<const char*>(&nodes_[is_cluster ? 0 : index]);
    std::size_t bytes = sizeof(Node);
    if (is_cluster) {
      const ClusterRecord& c = clusters_[index];
      from = reinterpret_cast<const char*>(numbers_.data() + c.numbers);
      bytes = kPlaneNumbers * kBatch * sizeof(double); // the rest follows by itself
    }
    for (std::size_t k = 0; k < bytes; k += 64)
      __builtin_prefetch(from + k);
  }

  /// Corners of the polygon with the most, at least 3.
  std::int32_t most_corners() const noexcept { return most_corners_; }

  /// Nodes; the first is the root. Empty without polygons.
  std::span<const Node> nodes() const noexcept { return nodes_.span(); }
  /// What the boxes of the nodes are relative to, and the largest distance from it.
  const Vec3& origin() const noexcept { return origin_; }
  double radius() const noexcept { return radius_; }

  /// Normal and point of the plane of a polygon, as in Plane.
  void plane(std::uint32_t polygon, double normal[3], double point[3]) const noexcept;

private:
  friend class TreeBuilder;

  static constexpr std::size_t kPlaneNumbers = 7; ///< of Cluster::planes, per polygon

  struct ClusterRecord {
    std::uint64_t numbers; ///< index into numbers_ of the planes; the corners follow
    std::int32_t corner_count;
    std::uint32_t present;
  };

  Buffer<ClusterRecord> clusters_;
  Buffer<double> numbers_;
  Buffer<std::uint32_t> ids_;   ///< [cluster][kBatch]
  Buffer<std::uint32_t> place_; ///< [polygon] cluster * kBatch + lane
  Buffer<Node> nodes_;
  Vec3 origin_{0, 0, 0};
  double radius_ = 0;
  std::int32_t most_corners_ = 3;
};

} // namespace hemicube::raster
