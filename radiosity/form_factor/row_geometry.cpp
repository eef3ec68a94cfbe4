#include "radiosity/form_factor/row_geometry.h"

#include "radiosity/hemicube/five_views.h"

namespace hemicube::radiosity {

Status RowGeometry::init(const PatchSet& patches) noexcept {
  patches_ = &patches;
  has_tree_ = has_facets_ = false;
  return {};
}

Status RowGeometry::need_tree() {
  if (!has_tree_)
    HC_TRY(tree_.build(polygons_of(*patches_)));
  has_tree_ = true;
  return {};
}

Status RowGeometry::need_facets() {
  if (!has_facets_)
    HC_TRY(facets_.build(*patches_));
  has_facets_ = true;
  return {};
}

} // namespace hemicube::radiosity
