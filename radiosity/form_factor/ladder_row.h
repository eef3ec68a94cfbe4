#pragma once

#include "radiosity/form_factor/row_builder.h"
#include "radiosity/form_factor/rung.h"
#include "radiosity/form_factor/seen_patches.h"
#include "radiosity/form_factor/visible_share.h"

namespace hemicube::radiosity {

/// What all rows of a scene share on any rung. Built once, read by every worker.
struct LadderSetup {
  Rung rung = Rung::kHemicube;
  double target = 0.01; ///< relative RMS error of a row, for rung adaptive
  const PatchSet* patches = nullptr;
  RowSetup hemicube;
  SceneFacets facets; ///< not built on rung hemicube

  /// @param patches_in  outlive this
  Status init(const PatchSet& patches_in, Rung rung_in, double target_in,
              std::uint32_t resolution, const raster::Kernels& kernels, bool hash_items);
};

/// Where a row is computed: on a patch, or at a point.
struct RowPlace {
  static constexpr std::uint32_t kNoPatch = 0xffffffffu;

  std::uint32_t patch = kNoPatch;
  Vec3 position{0, 0, 0}, normal{0, 0, 1}; ///< without a patch; normal of any length > 0
};

/// How a row came about.
struct RowFacts {
  std::uint32_t hemicubes = 0;
  std::uint32_t subpixel_patches = 0; ///< seen without a pixel of their own
  double raw_sum = 0;                 ///< of the row, before closure
  double error = 0; ///< estimated: root of the sum of the squared errors of the entries
  std::uint64_t item_hash = 0;
};

/// Builds rows on any rung. One per worker.
class LadderRow {
public:
  /// @param setup  outlives this
  Status init(const LadderSetup& setup);
  bool ready() const noexcept { return setup_ != nullptr; }

  /// row + space + back side is 1 to rounding, and never above.
  /// @param row  its spans are valid until the next call
  Status build(const RowPlace& place, RowView* row, RowFacts* facts);

private:
  /// What a patch gets: what provably nothing is in front of, and what was estimated.
  struct Entry {
    double proven, estimated;
  };

  Status build_by_facets(const raster::View& view, const RowPlace& place, RowFacts* facts);
  Status mark_seen_faces(const raster::View& view, RowFacts* facts);
  Status add_receiver(const raster::View& view, const Facet& receiver, double area, double part,
                      std::uint32_t own_face, RowFacts* facts);
  Status find_whole(const Facet& receiver, double area, const SeenTarget& target, double* whole);
  Status find_share(const raster::View& view, const Facet& receiver, double area,
                    const SeenTarget& target, double whole, VisibleShare* share,
                    RowFacts* facts);
  Status integrate_share(const Facet& receiver, double area, const SeenTarget& target,
                         double tolerance, std::uint32_t max_points, VisibleShare* share);
  Status render(const raster::View& view, RowFacts* facts);
  Status add(std::uint32_t patch, double proven, double estimated);
  void close(RowFacts* facts);
  void scale(double proven, double estimated);
  RowView store();

  const LadderSetup* setup_ = nullptr;
  RowBuilder hemicube_;
  SeenTargets seen_;
  ShareIntegrator integrator_;
  VisiblePart visible_;

  Buffer<Entry> entries_;           ///< [patch] zero between rows
  Buffer<std::uint32_t> touched_;   ///< patches with an entry, in the order they came
  double space_ = 0, back_side_ = 0;
  double error_sum_ = 0, error_squares_ = 0;
  bool rendered_ = false; ///< space, back side and pixels_ come from an item buffer
  Buffer<float> pixels_;  ///< [patch] its share of the hemicube; zero between rows
  Buffer<std::uint32_t> pixel_patches_;
  Buffer<std::uint8_t> seen_faces_; ///< [face]; empty: all are looked at

  Buffer<std::uint32_t> columns_;
  Buffer<float> values_;
};

} // namespace hemicube::radiosity
