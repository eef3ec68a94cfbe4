#include "radiosity/form_factor/ladder_row.h"

#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/lambert.h"
#include "radiosity/hemicube/five_views.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Below this many pixels of a patch, their count says little about how much of it is seen.
constexpr double kFewPixels = 16;

/// Scenes of more faces are looked at through an item buffer first: of what it does not show, the
/// geometry is not asked.
constexpr std::uint32_t kManyFaces = 2048;

/// What rung exact leaves of the visible share of a pair, and what integrals over unobstructed
/// areas may be off by, relative.
constexpr double kExactShare = 1e-6;
constexpr double kExactIntegral = 1e-10;
constexpr double kFineIntegral = 1e-6;

/// The errors of the shares of pairs are estimated from above and add up as squares.
constexpr double kSharePerTarget = 0.25;

constexpr std::uint32_t kFewPoints = 4, kManyPoints = 4096, kMostPoints = 1u << 20;

ConvexPolygon polygon_of(const Facet& facet) {
  ConvexPolygon polygon;
  for (const Vec3& corner : facet.corners)
    polygon.append(corner);
  return polygon;
}

bool is_point(const Facet& receiver) {
  return receiver.corners.size() == 1;
}

} // namespace

const char* rung_name(Rung rung) noexcept {
  constexpr const char* kNames[] = {"hemicube", "analytic", "area", "adaptive", "exact"};
  return kNames[static_cast<int>(rung)];
}

Status LadderSetup::init(const PatchSet& patches_in, Rung rung_in, double target_in,
                         std::uint32_t resolution, const raster::Kernels& kernels,
                         bool hash_items) {
  rung = rung_in;
  target = target_in;
  patches = &patches_in;
  HC_TRY(hemicube.init(polygons_of(patches_in), resolution, kernels, hash_items));
  return rung == Rung::kHemicube ? Status() : facets.build(patches_in);
}

Status LadderRow::init(const LadderSetup& setup) {
  HC_TRY(hemicube_.init(setup.hemicube));
  if (setup.rung != Rung::kHemicube) {
    const std::size_t count = setup.patches->patch_count();
    HC_TRY(entries_.resize(count, {0, 0}));
    HC_TRY(touched_.reserve(count));
    HC_TRY(pixels_.resize(count));
    HC_TRY(columns_.resize(count));
    HC_TRY(values_.resize(count));
    if (setup.facets.face_count() > kManyFaces)
      HC_TRY(seen_faces_.resize(setup.facets.face_count()));
  }
  setup_ = &setup;
  return {};
}

Status LadderRow::build(const RowPlace& place, RowView* row, RowFacts* facts) {
  *facts = {};
  const raster::View view = place.patch != RowPlace::kNoPatch
                                ? hemicube_view(*setup_->patches, place.patch)
                                : hemicube_view(place.position, place.normal);
  if (setup_->rung != Rung::kHemicube) {
    HC_TRY(build_by_facets(view, place, facts));
    *row = store();
    return {};
  }
  *row = hemicube_.build(view);
  facts->hemicubes = 1;
  facts->raw_sum = row_sum(*row); // integer sums close by themselves
  facts->item_hash = hemicube_.item_hash();
  return {};
}

Status LadderRow::build_by_facets(const raster::View& view, const RowPlace& place,
                                  RowFacts* facts) {
  space_ = back_side_ = error_sum_ = error_squares_ = 0;
  rendered_ = false;
  touched_.clear();
  if (!seen_faces_.empty())
    HC_TRY(mark_seen_faces(view, facts));
  const std::uint32_t own_face = place.patch == RowPlace::kNoPatch
                                     ? SeenTargets::kNoFace
                                     : setup_->facets.face_of(place.patch);
  if (place.patch == RowPlace::kNoPatch || setup_->rung == Rung::kAnalytic) {
    const Facet eye = Facet::of({&view.eye, 1}, view.axis_z);
    HC_TRY(add_receiver(view, eye, 0, 1, own_face, facts));
  } else {
    const double area = setup_->patches->area[place.patch];
    for (const PatchPiece& piece : setup_->facets.pieces_of(place.patch))
      HC_TRY(add_receiver(view, piece.facet, piece.area, piece.area / area, own_face, facts));
  }
  facts->error = std::sqrt(error_squares_);
  close(facts);
  for (const std::uint32_t patch : pixel_patches_)
    pixels_[patch] = 0;
  pixel_patches_.clear();
  return {};
}

/// Renders the hemicube of the row, once.
Status LadderRow::render(const raster::View& view, RowFacts* facts) {
  if (facts->hemicubes != 0)
    return {};
  const RowView row = hemicube_.build(view);
  facts->hemicubes = 1;
  facts->item_hash = hemicube_.item_hash();
  for (std::size_t k = 0; k < row.columns.size(); ++k)
    pixels_[row.columns[k]] = static_cast<float>(row.scale * static_cast<double>(row.values[k]));
  HC_TRY(pixel_patches_.assign(row.columns));
  space_ = row.space;
  back_side_ = row.back_side;
  return {};
}

Status LadderRow::mark_seen_faces(const raster::View& view, RowFacts* facts) {
  HC_TRY(render(view, facts));
  seen_faces_.fill(0);
  for (const std::uint32_t patch : pixel_patches_)
    seen_faces_[setup_->facets.face_of(patch)] = 1;
  return {};
}

/// Adds what one piece of the receiver, `part` of its area, sees.
Status LadderRow::add_receiver(const raster::View& view, const Facet& receiver, double area,
                               double part, std::uint32_t own_face, RowFacts* facts) {
  HC_TRY(seen_.find(setup_->facets, receiver, own_face, seen_faces_.span()));
  const bool by_pixels = setup_->rung <= Rung::kArea;
  if (by_pixels)
    for (const SeenTarget& target : seen_.targets())
      rendered_ |= target.blocker_count != 0;
  if (rendered_)
    HC_TRY(render(view, facts));
  for (const SeenTarget& target : seen_.targets()) {
    if (target.is_back() && rendered_)
      continue; // the item buffer shows them
    double whole = 0;
    HC_TRY(find_whole(receiver, area, target, &whole));
    if (!(whole > 0))
      continue;
    VisibleShare share;
    if (target.blocker_count != 0)
      HC_TRY(find_share(view, receiver, area, target, whole, &share, facts));
    const double value = part * whole * share.share;
    const double error = part * whole * share.error;
    error_sum_ += error;
    error_squares_ += error * error;
    if (target.is_back())
      back_side_ += value;
    else if (value > 0)
      HC_TRY(target.blocker_count == 0 ? add(target.piece->patch, value, 0)
                                       : add(target.piece->patch, 0, value));
  }
  return {};
}

Status LadderRow::find_whole(const Facet& receiver, double area, const SeenTarget& target,
                             double* whole) {
  ConvexPolygon corners;
  const Facet facet = target.is_back() ? reversed(setup_->facets.face(target.face), &corners)
                                       : target.piece->facet;
  if (is_point(receiver)) {
    *whole = point_to_polygon(receiver.corners[0], receiver.plane.normal, facet.corners);
    return {};
  }
  const double accuracy = setup_->rung == Rung::kExact ? kExactIntegral : kFineIntegral;
  const AreaIntegral integral =
      exchange_area(polygon_of(receiver), receiver.plane.normal, polygon_of(facet),
                    facet.plane.normal, accuracy);
  *whole = integral.value / area;
  error_sum_ += integral.error / area;
  error_squares_ += integral.error / area * (integral.error / area);
  return {};
}

/// How much of a target gets past what may be in between.
Status LadderRow::find_share(const raster::View& view, const Facet& receiver, double area,
                             const SeenTarget& target, double whole, VisibleShare* share,
                             RowFacts* facts) {
  const bool by_pixels = setup_->rung <= Rung::kArea;
  if (!by_pixels) {
    const bool exact = setup_->rung == Rung::kExact;
    return integrate_share(receiver, area, target,
                           exact ? kExactShare : kSharePerTarget * setup_->target,
                           exact ? kMostPoints : kManyPoints, share);
  }
  const double pixel = 1 / (3 * static_cast<double>(setup_->hemicube.delta.resolution()) *
                            setup_->hemicube.delta.resolution());
  const std::uint32_t patch = target.piece->patch;
  const bool has_one_piece = setup_->facets.pieces_of(patch).size() == 1;
  const double from_eye = point_to_polygon(view.eye, view.axis_z, target.piece->facet.corners);
  if (has_one_piece && from_eye > kFewPixels * pixel) {
    share->share = std::fmin(1, static_cast<double>(pixels_[patch]) / from_eye);
    return {};
  }
  HC_TRY(integrate_share(receiver, area, target, 1, kFewPoints, share));
  share->error = 0;
  facts->subpixel_patches += pixels_[patch] == 0 && share->share * whole > 0 ? 1 : 0;
  return {};
}

Status LadderRow::integrate_share(const Facet& receiver, double area, const SeenTarget& target,
                                  double tolerance, std::uint32_t max_points,
                                  VisibleShare* share) {
  const auto blockers = seen_.blockers_of(target);
  ConvexPolygon corners;
  const Facet facet = target.is_back() ? reversed(setup_->facets.face(target.face), &corners)
                                       : target.piece->facet;
  if (is_point(receiver)) {
    PointFormFactors at;
    HC_TRY(visible_.find(receiver.corners[0], receiver.plane.normal, facet, blockers, &at));
    share->share = at.whole > 0 ? at.visible / at.whole : 0;
    return {};
  }
  // The points lie on the smaller of the two, where less varies; both rows of a pair choose alike.
  const bool from_target =
      !target.is_back() &&
      (target.piece->area < area ||
       (target.piece->area == area && target.piece->facet.corners.data() < receiver.corners.data()));
  return from_target ? integrator_.find(facet, receiver, blockers, tolerance, max_points, share)
                     : integrator_.find(receiver, facet, blockers, tolerance, max_points, share);
}

Status LadderRow::add(std::uint32_t patch, double proven, double estimated) {
  Entry& entry = entries_[patch];
  if (entry.proven == 0 && entry.estimated == 0)
    HC_TRY(touched_.push_back(patch));
  entry.proven += proven;
  entry.estimated += estimated;
  return {};
}

void LadderRow::scale(double proven, double estimated) {
  for (const std::uint32_t patch : touched_) {
    entries_[patch].proven *= proven;
    entries_[patch].estimated *= estimated;
  }
}

/// Makes row + space + back side 1. What is proven stands; what is estimated shares one factor,
/// unless there is none or the factor would say that the estimates are worthless: then all share it.
void LadderRow::close(RowFacts* facts) {
  std::sort(touched_.begin(), touched_.end());
  double proven = 0, estimated = 0;
  for (const std::uint32_t patch : touched_) {
    proven += entries_[patch].proven;
    estimated += entries_[patch].estimated;
  }
  facts->raw_sum = proven + estimated;
  if (!rendered_) {
    // No item buffer says what is space. What is missing beyond all errors is.
    const double missing = 1 - (proven + estimated + back_side_);
    constexpr double kRounding = 0x1p-40;
    space_ = missing > 2 * error_sum_ + kRounding ? missing : 0;
    if (space_ != 0)
      return;
  }
  const double lost = rendered_ ? space_ + back_side_ : 0;
  const double fixed = rendered_ ? proven : proven + back_side_;
  const double factor = estimated + lost > 0 ? (1 - fixed) / (estimated + lost) : 0;
  if (factor >= 0.5 && factor <= 2) {
    scale(1, factor);
    if (rendered_) {
      space_ *= factor;
      back_side_ *= factor;
    }
    return;
  }
  const double all = proven + estimated + space_ + back_side_;
  if (!(all > 0)) {
    space_ = 1;
    return;
  }
  scale(1 / all, 1 / all);
  space_ /= all;
  back_side_ /= all;
}

RowView LadderRow::store() {
  std::size_t count = 0;
  for (const std::uint32_t patch : touched_) {
    const double value = entries_[patch].proven + entries_[patch].estimated;
    entries_[patch] = {0, 0};
    columns_[count] = patch;
    values_[count] = static_cast<float>(value);
    count += values_[count] > 0 ? 1 : 0;
  }
  RowView row;
  row.columns = columns_.span().first(count);
  row.values = values_.span().first(count);
  row.space = space_;
  row.back_side = back_side_;
  fit_scale(1 - space_ - back_side_, &row);
  return row;
}

} // namespace hemicube::radiosity
