#include "radiosity/form_factor/ladder_row.h"

#include "radiosity/form_factor/lambert.h"
#include "radiosity/hemicube/five_views.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Below this many pixels of a patch, their count says little about how much of it is seen.
constexpr double kFewPixels = 16;

/// One point stands badly for a patch near by: a form factor f is wrong by about this times f^2.
constexpr double kNearness = 0.25;
/// A visible share s that was seen from one point may be wrong by this times s (1 - s), and more.
constexpr double kOneView = 1, kUnseenShare = 0.03;

/// Nanoseconds, about what they took once.
constexpr std::uint64_t kTestCost = 60, kPointCost = 800, kPairCost = 60;

raster::View view_of(const PatchSet& patches, const RowPlace& place) {
  return place.patch == RowPlace::kNoPatch ? hemicube_view(place.position, place.normal)
         : place.part.empty()              ? hemicube_view(patches, place.patch)
                                           : hemicube_view(patches, place.patch, place.part);
}

/// Of the areas of a pair; with it the larger of its two form factors, the same for both rows.
double smaller_area(const PatchPiece& receiver, const SeenTarget& target) {
  return !target.is_back() && target.piece->area < receiver.area ? target.piece->area
                                                                 : receiver.area;
}

bool is_point(const Facet& receiver) {
  return receiver.corners.size() == 1;
}

} // namespace

Status LadderRow::init(const LadderSetup& setup) {
  if (setup.needs_hemicubes())
    HC_TRY(hemicube_.init(setup.hemicube));
  if (setup.setting.rung != Rung::kHemicube) {
    const std::size_t count = setup.geometry->patches().patch_count();
    HC_TRY(entries_.resize(count, {0, 0}));
    HC_TRY(touched_.reserve(count));
    HC_TRY(pixels_.resize(count));
    HC_TRY(columns_.resize(count));
    HC_TRY(values_.resize(count));
    HC_TRY(integrator_.init(setup.geometry->facets().face_count(),
                            setup.geometry->facets().tolerance()));
    if (setup.looks_first())
      HC_TRY(seen_faces_.resize(setup.geometry->facets().face_count()));
  }
  setup_ = &setup;
  return {};
}

Status LadderRow::build(const RowPlace& place, RowView* row, RowFacts* facts) {
  *facts = {};
  if (setup_->setting.rung != Rung::kHemicube) {
    HC_TRY(find_exchange(place, false, facts));
    return assemble(exchange_, {}, row, facts);
  }
  *row = hemicube_.build(view_of(setup_->geometry->patches(), place));
  facts->hemicubes = 1;
  facts->raw_sum = row_sum(*row); // integer sums close by themselves
  facts->item_hash = hemicube_.item_hash();
  doubt_squares_ = 0;
  for (std::size_t k = 0; k < row->columns.size(); ++k) {
    const double value = row->scale * static_cast<double>(row->values[k]);
    add_doubt(row->columns[k], kNearness * value * value);
  }
  facts->doubt = std::sqrt(doubt_squares_);
  return {};
}

void LadderRow::add_doubt(std::uint32_t patch, double doubt) noexcept {
  if (setup_->light.empty())
    return;
  const double wrong = doubt * setup_->light[patch];
  doubt_squares_ += wrong * wrong;
}

Status LadderRow::find_pairs(std::uint32_t patch, ReceiverExchange* exchange, RowFacts* facts) {
  *facts = {};
  HC_TRY(find_exchange({patch}, true, facts));
  *exchange = exchange_;
  return {};
}

Status LadderRow::find_exchange(const RowPlace& place, bool own_only, RowFacts* facts) {
  const raster::View view = view_of(setup_->geometry->patches(), place);
  const bool on_patch = place.patch != RowPlace::kNoPatch;
  const std::uint64_t tests = seen_.test_count(), points = integrator_.point_count();
  integral_work_ = 0;
  pairs_.clear();
  exchange_ = {};
  if (!seen_faces_.empty())
    HC_TRY(mark_seen_faces(view, facts));
  const std::uint32_t own_face = on_patch ? facets().face_of(place.patch) : SeenTargets::kNoFace;
  if (!place.part.empty() && setup_->setting.rung != Rung::kAnalytic) {
    const PatchPiece part = facets().part_of(place.patch, place.part);
    exchange_.area = part.area;
    HC_TRY(add_receiver(view, part, own_face, nullptr, facts));
  } else if (on_patch && setup_->setting.rung != Rung::kAnalytic) {
    exchange_.area = setup_->geometry->patches().area[place.patch];
    for (const PatchPiece& piece : facets().pieces_of(place.patch))
      HC_TRY(add_receiver(view, piece, own_face, own_only ? &piece : nullptr, facts));
  } else {
    const PatchPiece eye{place.patch, false, 1, Facet::of({&view.eye, 1}, view.axis_z), {}};
    HC_TRY(add_receiver(view, eye, own_face, nullptr, facts));
  }
  exchange_.pairs = pairs_.span();
  facts->work = kTestCost * (seen_.test_count() - tests) +
                kPointCost * (integrator_.point_count() - points) + kPairCost * pairs_.size() +
                static_cast<std::uint64_t>(integral_work_);
  clear_pixels();
  return {};
}

/// Renders hemicubes and keeps the mean of what they show.
Status LadderRow::render(std::span<const raster::View> views, RowFacts* facts) {
  clear_pixels();
  const double part = 1 / static_cast<double>(views.size());
  space_ = back_side_ = 0;
  for (const raster::View& view : views) {
    const RowView row = hemicube_.build(view);
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      float& pixels = pixels_[row.columns[k]];
      if (pixels == 0)
        HC_TRY(pixel_patches_.push_back(row.columns[k]));
      pixels += static_cast<float>(part * row.scale * static_cast<double>(row.values[k]));
    }
    space_ += part * row.space;
    back_side_ += part * row.back_side;
    facts->item_hash ^= hemicube_.item_hash();
    ++facts->hemicubes;
  }
  return {};
}

void LadderRow::clear_pixels() noexcept {
  for (const std::uint32_t patch : pixel_patches_)
    pixels_[patch] = 0;
  pixel_patches_.clear();
}

/// Renders where a row needs it: at the centre on rungs that see from there, else at the points of
/// a piece of the receiver.
Status LadderRow::render_for(const raster::View& view, const PatchPiece& receiver,
                             RowFacts* facts) {
  views_[0] = view;
  view_count_ = 1;
  if (setup_->setting.rung > Rung::kArea && !is_point(receiver.facet)) {
    Vec3 points[ShareIntegrator::kCellPoints];
    view_count_ = ShareIntegrator::points_on(receiver.facet, points);
    for (std::size_t k = 0; k < view_count_; ++k) {
      views_[k] = hemicube_view(points[k], receiver.facet.plane.normal);
      views_[k].skip = receiver.patch;
    }
  }
  return render(std::span<const raster::View>(views_, view_count_), facts);
}

Status LadderRow::mark_seen_faces(const raster::View& view, RowFacts* facts) {
  HC_TRY(render({&view, 1}, facts));
  seen_faces_.fill(0);
  for (const std::uint32_t patch : pixel_patches_)
    seen_faces_[facets().face_of(patch)] = 1;
  return {};
}

/// Adds what one piece of the receiver exchanges.
Status LadderRow::add_receiver(const raster::View& view, const PatchPiece& receiver,
                               std::uint32_t own_face, const PatchPiece* owner, RowFacts* facts) {
  const bool by_pixels = setup_->setting.rung <= Rung::kArea;
  // What an item buffer says is not the same for both rows of a pair: each asks its own.
  HC_TRY(seen_.find(facets(), receiver.facet, own_face, seen_faces_.span(),
                    by_pixels ? nullptr : owner));
  integrator_.set_receiver(receiver.facet);
  bool renders = false;
  for (const SeenTarget& target : seen_.targets())
    renders |= target.is_crowded || (by_pixels && !target.is_whole());
  if (renders) {
    HC_TRY(render_for(view, receiver, facts));
    exchange_.is_rendered = true;
    exchange_.space = exchange_.area * space_;
    exchange_.back_side = exchange_.area * back_side_;
    exchange_.back_side_error = 0;
  }
  for (const SeenTarget& target : seen_.targets()) {
    if (target.is_back() && exchange_.is_rendered)
      continue; // the item buffer shows them
    const bool is_mutual = !target.is_back() && are_mutual(receiver, *target.piece) &&
                           (!by_pixels || target.is_whole());
    if (is_mutual && owner != nullptr && !owns_pair(*owner, *target.piece))
      continue;
    ConvexPolygon corners;
    const Facet facet =
        target.is_back() ? reversed(facets().face(target.face), &corners) : target.piece->facet;
    const AreaIntegral whole = find_whole(receiver, target, facet);
    integral_work_ += whole.work;
    if (!(whole.value > 0))
      continue;
    VisibleShare share;
    if (!target.is_whole())
      HC_TRY(find_share(receiver, target, facet, whole.value, &share, facts));
    const double value = whole.value * share.share;
    const double error = whole.error + whole.value * share.error;
    double doubt = whole.value * share.doubt;
    if (setup_->setting.rung == Rung::kAnalytic)
      doubt += kNearness * value * value;
    if (target.is_back()) {
      exchange_.back_side += value;
      exchange_.back_side_error += error;
    } else if (value > 0 || doubt > 0) {
      const std::uint32_t flags = (target.is_whole() ? 0 : PairExchange::kEstimated) |
                                  (is_mutual ? PairExchange::kMutual : 0);
      HC_TRY(pairs_.push_back({target.piece->patch, static_cast<float>(error),
                               static_cast<float>(doubt), flags, value}));
    }
  }
  return {};
}

AreaIntegral LadderRow::find_whole(const PatchPiece& receiver, const SeenTarget& target,
                                   const Facet& facet) const {
  const Facet& from = receiver.facet;
  if (is_point(from))
    return {point_to_polygon(from.corners[0], from.plane.normal, facet.corners), 0};
  return exchange_area(receiver.prepared,
                       target.is_back() ? prepare_area(facet.corners, facet.plane.normal)
                                        : target.piece->prepared,
                       setup_->integral_error());
}

/// How much of a target gets past what may be in between.
Status LadderRow::find_share(const PatchPiece& receiver, const SeenTarget& target,
                             const Facet& facet, double whole, VisibleShare* share,
                             RowFacts* facts) {
  if (setup_->setting.rung > Rung::kArea && !target.is_crowded)
    return integrate_share(receiver, target, facet, whole,
                           setup_->effort(whole / smaller_area(receiver, target)), share);
  const double resolution = setup_->hemicube.delta.resolution();
  const double pixel = 1 / (3 * resolution * resolution);
  const std::uint32_t patch = target.piece->patch;
  const bool has_one_piece = facets().pieces_of(patch).size() == 1;
  double from_eyes = 0;
  for (std::size_t k = 0; k < view_count_; ++k)
    from_eyes += std::max(0.0, point_to_polygon(views_[k].eye, views_[k].axis_z, facet.corners) /
                                   static_cast<double>(view_count_));
  if (target.is_crowded || (has_one_piece && from_eyes > kFewPixels * pixel)) {
    const double seen = from_eyes > 0 ? static_cast<double>(pixels_[patch]) / from_eyes : 0;
    share->share = seen < 1 ? seen : 1;
    share->doubt = kUnseenShare + kOneView * share->share * (1 - share->share);
    if (target.is_crowded)
      share->error = share->doubt / 2;
    return {};
  }
  HC_TRY(integrate_share(receiver, target, facet, whole, {1, 1, 1}, share));
  facts->subpixel_patches += pixels_[patch] == 0 && share->share > 0 ? 1 : 0;
  return {};
}

Status LadderRow::integrate_share(const PatchPiece& receiver, const SeenTarget& target,
                                  const Facet& facet, double whole, const Effort& effort,
                                  VisibleShare* share) {
  const auto blockers = seen_.blockers_of(target);
  if (is_point(receiver.facet))
    return integrator_.find_at_point(facet, blockers, share);
  if (target.is_back() || !are_mutual(receiver, *target.piece) ||
      owns_pair(receiver, *target.piece))
    return integrator_.find(facet, blockers, whole, effort, share);
  integrator_.set_receiver(facet);
  const Status status = integrator_.find(receiver.facet, blockers, whole, effort, share);
  integrator_.set_receiver(receiver.facet);
  return status;
}

Status LadderRow::assemble(const ReceiverExchange& own, std::span<const PairExchange> others,
                           RowView* row, RowFacts* facts) {
  touched_.clear();
  error_sum_ = error_squares_ = doubt_squares_ = 0;
  space_ = own.space / own.area;
  for (const auto pairs : {own.pairs, others})
    for (const PairExchange& pair : pairs)
      HC_TRY(add(pair, own.area));
  back_side_ = own.back_side / own.area;
  const double back_side_error = own.back_side_error / own.area;
  error_sum_ += back_side_error;
  error_squares_ += back_side_error * back_side_error;
  facts->error = std::sqrt(error_squares_);
  facts->doubt = std::sqrt(doubt_squares_);
  close(own.is_rendered, facts);
  *row = store();
  return {};
}

Status LadderRow::add(const PairExchange& pair, double area) {
  const double error = static_cast<double>(pair.error) / area;
  error_sum_ += error;
  error_squares_ += error * error;
  add_doubt(pair.patch, static_cast<double>(pair.doubt) / area);
  if (!(pair.value > 0))
    return {};
  Entry& entry = entries_[pair.patch];
  if (entry.proven == 0 && entry.estimated == 0)
    HC_TRY(touched_.push_back(pair.patch));
  (pair.is_estimated() ? entry.estimated : entry.proven) += pair.value / area;
  return {};
}

void LadderRow::scale(double proven, double estimated) {
  for (const std::uint32_t patch : touched_) {
    entries_[patch].proven *= proven;
    entries_[patch].estimated *= estimated;
  }
}

/// Makes row + space + back side 1. What is proven stands; what is estimated shares one factor,
/// unless there is none or the factor would say that the estimates are worthless: then all share
/// it.
void LadderRow::close(bool is_rendered, RowFacts* facts) {
  std::sort(touched_.begin(), touched_.end());
  double proven = 0, estimated = 0;
  for (const std::uint32_t patch : touched_) {
    proven += entries_[patch].proven;
    estimated += entries_[patch].estimated;
  }
  facts->raw_sum = proven + estimated;
  if (!is_rendered) {
    // No item buffer says what is space. What is missing beyond all errors is.
    const double missing = 1 - (proven + estimated + back_side_);
    constexpr double kRounding = 0x1p-40;
    space_ = missing > 2 * error_sum_ + kRounding ? missing : 0;
    if (space_ != 0)
      return;
  }
  const double lost = is_rendered ? space_ + back_side_ : 0;
  const double fixed = is_rendered ? proven : proven + back_side_;
  const double factor = estimated + lost > 0 ? (1 - fixed) / (estimated + lost) : 0;
  if (factor >= 0.5 && factor <= 2) {
    scale(1, factor);
    if (is_rendered) {
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
  // What is left of 1 is known to 2^-53. Of a row that sees hardly anything the entries know more.
  constexpr double kHardlyAnything = 0x1p-10;
  std::size_t count = 0;
  double sum = 0;
  for (const std::uint32_t patch : touched_) {
    const double value = entries_[patch].proven + entries_[patch].estimated;
    entries_[patch] = {0, 0};
    columns_[count] = patch;
    values_[count] = static_cast<float>(value);
    sum += value;
    count += values_[count] > 0 ? 1 : 0;
  }
  RowView row;
  row.columns = columns_.span().first(count);
  row.values = values_.span().first(count);
  row.space = space_;
  row.back_side = back_side_;
  fit_scale(sum < kHardlyAnything ? sum : 1 - space_ - back_side_, &row);
  return row;
}

} // namespace hemicube::radiosity
