#pragma once

#include "radiosity/form_factor/scene_facets.h"
#include "raster/polygon_tree.h"

namespace hemicube::radiosity {

/// What rows of a scene are found in, whatever their rung and resolution. Built once, read by every
/// worker.
class RowGeometry {
public:
  /// @param patches  outlive this
  Status init(const PatchSet& patches) noexcept;

  /// Builds what item buffers need, or what the rungs above need, unless it is there.
  Status need_tree();
  Status need_facets();

  const PatchSet& patches() const noexcept { return *patches_; }
  const raster::PolygonTree& tree() const noexcept { return tree_; }
  const SceneFacets& facets() const noexcept { return facets_; }

private:
  const PatchSet* patches_ = nullptr;
  raster::PolygonTree tree_;
  SceneFacets facets_;
  bool has_tree_ = false, has_facets_ = false;
};

} // namespace hemicube::radiosity
