#pragma once

#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/exchange_table.h"
#include "radiosity/form_factor/ladder_setup.h"
#include "radiosity/form_factor/seen_patches.h"

namespace hemicube::radiosity {

/// Where a row is computed: on a patch, on a part of one, or at a point.
struct RowPlace {
  static constexpr std::uint32_t kNoPatch = 0xffffffffu;

  std::uint32_t patch = kNoPatch;
  Vec3 position{0, 0, 0}, normal{0, 0, 1}; ///< without a patch; normal of any length > 0
  /// The corners of the part, convex, at most OccluderFaces::kMostCorners, counter-clockwise seen
  /// from the front; empty: the whole patch. Not owned.
  std::span<const Vec3> part = {};
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

  /// The first half of `build` where all rows are wanted: pairs that belong to a patch.
  /// @param exchange  its span is valid until the next call
  Status find_pairs(std::uint32_t patch, ReceiverExchange* exchange, RowFacts* facts);

  /// The second half.
  /// @param others  the pairs with it that belong to others
  Status assemble(const ReceiverExchange& own, std::span<const PairExchange> others, RowView* row,
                  RowFacts* facts);

private:
  /// What a patch gets: what provably nothing is in front of, and what was estimated.
  struct Entry {
    double proven, estimated;
  };

  const SceneFacets& facets() const noexcept { return setup_->geometry->facets(); }
  Status find_exchange(const RowPlace& place, bool own_only, RowFacts* facts);
  Status mark_seen_faces(const raster::View& view, RowFacts* facts);
  Status add_receiver(const raster::View& view, const PatchPiece& receiver, std::uint32_t own_face,
                      const PatchPiece* owner, RowFacts* facts);
  AreaIntegral find_whole(const PatchPiece& receiver, const SeenTarget& target,
                          const Facet& facet) const;
  Status find_share(const PatchPiece& receiver, const SeenTarget& target, const Facet& facet,
                    double whole, VisibleShare* share, RowFacts* facts);
  Status integrate_share(const PatchPiece& receiver, const SeenTarget& target, const Facet& facet,
                         double whole, const Effort& effort, VisibleShare* share);
  Status render(std::span<const raster::View> views, RowFacts* facts);
  Status render_for(const raster::View& view, const PatchPiece& receiver, RowFacts* facts);
  void clear_pixels() noexcept;
  Status add(const PairExchange& pair, double area);
  void add_doubt(std::uint32_t patch, double doubt) noexcept;
  void close(bool is_rendered, RowFacts* facts);
  void scale(double proven, double estimated);
  RowView store();

  const LadderSetup* setup_ = nullptr;
  RowBuilder hemicube_;
  SeenTargets seen_;
  ShareIntegrator integrator_;

  Buffer<PairExchange> pairs_;
  double integral_work_ = 0;
  ReceiverExchange exchange_;     ///< of the place at hand
  Buffer<Entry> entries_;         ///< [patch] zero between rows
  Buffer<std::uint32_t> touched_; ///< patches with an entry
  double space_ = 0, back_side_ = 0;
  double error_sum_ = 0, error_squares_ = 0, doubt_squares_ = 0;
  raster::View views_[ShareIntegrator::kCellPoints]; ///< that pixels_ were rendered from
  std::size_t view_count_ = 0;
  Buffer<float> pixels_; ///< [patch] its share of the hemicube; zero between rows
  Buffer<std::uint32_t> pixel_patches_;
  Buffer<std::uint8_t> seen_faces_; ///< [face]; empty: all are looked at

  Buffer<std::uint32_t> columns_;
  Buffer<float> values_;
};

} // namespace hemicube::radiosity
