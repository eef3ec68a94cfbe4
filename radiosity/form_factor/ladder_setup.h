#pragma once

#include "radiosity/form_factor/row_builder.h"
#include "radiosity/form_factor/row_geometry.h"
#include "radiosity/form_factor/rung.h"
#include "radiosity/form_factor/visible_share.h"

namespace hemicube::radiosity {

/// What all rows of a scene share on any rung. Built once, read by every worker.
struct LadderSetup {
  RungSetting setting;
  const RowGeometry* geometry = nullptr;
  std::span<const double> light; ///< [patch] guess of what it sends out; may be empty
  RowSetup hemicube;

  /// @param geometry_in  outlives this; what the rung needs is built
  Status init(RowGeometry* geometry_in, const RungSetting& setting_in,
              const raster::Kernels& kernels, bool hash_items);

  /// True if both rows of a pair of patches say the same of it, so that it need be found only once.
  bool shares_pairs() const noexcept { return setting.rung >= Rung::kArea; }

  /// False where geometry alone tells everything.
  bool needs_hemicubes() const noexcept;

  /// True where a row starts with an item buffer, and faces that it does not show are left out:
  /// there are too many to look at all.
  bool looks_first() const noexcept;

  /// For a partly visible pair. @param form_factor  the larger of its two, if nothing were between
  Effort effort(double form_factor) const noexcept;

  /// Relative, of integrals over pairs with nothing in between.
  double integral_error() const noexcept;
};

} // namespace hemicube::radiosity
