#include "radiosity/form_factor/visible_share.h"

#include "radiosity/elementary.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// The four points of a cell, from 0 to 1: exact for cubics, as the tensor Gauss rule, which this
/// is turned by 18 degrees. Shadows mostly run along edges: here no two points share a coordinate,
/// and coordinates are equally far apart.
constexpr double kFar = 0.38729833462074168852, kNear = 0.12909944487358056284;
constexpr double kPoints[4][2] = {{0.5 + kFar, 0.5 + kNear},
                                  {0.5 - kNear, 0.5 + kFar},
                                  {0.5 - kFar, 0.5 - kNear},
                                  {0.5 + kNear, 0.5 - kFar}};

/// Two rules that differ by d leave about a quarter of it in the finer one, where the integrand has
/// kinks; half of it is said.
constexpr double kErrorLeft = 0.5;

/// What a few points that show the same may have missed.
constexpr double kUnseen = 0.03;

/// A point of a quadrilateral, and how much area belongs to a unit of u and v there, as a vector.
struct Spot {
  Vec3 point, area;
};
Spot spot_of(const Vec3* corners, double u, double v) {
  const Vec3& a = corners[0];
  const Vec3 ab = corners[1] - a, ad = corners[3] - a;
  const Vec3 twist = corners[2] - corners[1] - ad;
  return {a + ab * u + ad * v + twist * (u * v), glm::cross(ab + twist * v, ad + twist * u)};
}

} // namespace

/// Near an edge that both share, the kernel grows beyond what a few points can integrate. The whole
/// is known, and where it grows most all is seen or all is hidden: what is proven to be the one is
/// found as what the rest leaves.
double ShareIntegrator::Totals::share(double whole) const noexcept {
  double share = 1;
  if (seen == 0 && hidden == 0)
    share = open > 0 ? open_visible / open : 1;
  else if (seen >= hidden)
    share = 1 - (hidden + (open - open_visible)) / whole;
  else
    share = (seen + open_visible) / whole;
  return share < 0 ? 0 : share > 1 ? 1 : share;
}

double ShareIntegrator::missed_per_whole(double met, double whole) const noexcept {
  if (!(met > 0))
    return 0;
  const double missed = std::fabs(met - whole) / all_;
  return (missed < 1 ? missed : 1) / met;
}

Status ShareIntegrator::init(std::uint32_t face_count, double tolerance) {
  plane_tolerance_ = tolerance;
  for (KeptShadows& kept : kept_)
    HC_TRY(kept.index_of_face.resize(face_count));
  return {};
}

/// A fan of quadrilaterals, the last maybe a triangle with a corner twice.
int ShareIntegrator::split(const ConvexPolygon& polygon, Vec3 (*cells)[4]) noexcept {
  int count = 0;
  for (int k = 1; k + 1 < polygon.count; k += 2, ++count) {
    cells[count][0] = polygon.corners[0];
    cells[count][1] = polygon.corners[k];
    cells[count][2] = polygon.corners[k + 1];
    cells[count][3] = polygon.corners[k + 2 < polygon.count ? k + 2 : 0];
  }
  return count;
}

std::size_t ShareIntegrator::points_on(const Facet& facet, Vec3 (&points)[kCellPoints]) noexcept {
  Vec3 cells[kMaxCells][4];
  const ConvexPolygon polygon(facet.corners);
  if (polygon.count > 4) {
    points[0] = facet.centre;
    return 1;
  }
  split(polygon, cells);
  for (int k = 0; k < kCellPoints; ++k)
    points[k] = spot_of(cells[0], kPoints[k][0], kPoints[k][1]).point;
  return kCellPoints;
}

void ShareIntegrator::set_receiver(const Facet& receiver) noexcept {
  receiver_ = &receiver;
  for (KeptShadows& kept : kept_) {
    kept.shadows.clear();
    kept.faces.clear();
  }
}

/// Fills in_the_way_ with the shadows of blockers seen from a point.
/// @param kept  what was found at this point before; null for other points
Status ShareIntegrator::find_shadows(const Vec3& eye, Range blockers, KeptShadows* kept) {
  in_the_way_.clear();
  shadows_.clear();
  const auto keeps = [&](const Blocker& blocker) {
    return kept != nullptr && !blocker.in_target_plane;
  };
  for (std::size_t k = blockers.begin; k < blockers.end; ++k) {
    const Blocker& blocker = blockers_[k];
    if (!keeps(blocker)) {
      HC_TRY(shadows_.push_back(Shadow(eye, blocker)));
      continue;
    }
    std::uint32_t& index = kept->index_of_face[blocker.face];
    if (index < kept->faces.size() && kept->faces[index] == blocker.face)
      continue;
    index = static_cast<std::uint32_t>(kept->faces.size());
    HC_TRY(kept->faces.push_back(blocker.face));
    HC_TRY(kept->shadows.push_back(Shadow(eye, blocker)));
  }
  std::size_t own = 0; // now that nothing moves any more
  for (std::size_t k = blockers.begin; k < blockers.end; ++k)
    HC_TRY(in_the_way_.push_back(keeps(blockers_[k])
                                     ? &kept->shadows[kept->index_of_face[blockers_[k].face]]
                                     : &shadows_[own++]));
  return {};
}

Status ShareIntegrator::sample(const Cell& cell, Range blockers, bool keeps, Sums* sums) {
  const Vec3& normal = receiver_->plane.normal;
  for (int k = 0; k < kCellPoints; ++k) {
    const Spot spot = spot_of(cell.corners, cell.u + kPoints[k][0] * cell.size,
                              cell.v + kPoints[k][1] * cell.size);
    const double weight = glm::dot(spot.area, normal) * cell.size * cell.size / kCellPoints;
    HC_TRY(find_shadows(spot.point, blockers, keeps ? &kept_[k] : nullptr));
    PointFormFactors seen;
    HC_TRY(visible_.find(spot.point, normal, *to_, in_the_way_.span(), &seen));
    ++point_count_;
    if (!(seen.whole > 0))
      continue;
    const double share = seen.visible / seen.whole;
    sums->least = share < sums->least ? share : sums->least;
    sums->most = share > sums->most ? share : sums->most;
    sums->whole += weight * seen.whole;
    sums->visible += weight * seen.visible;
  }
  return {};
}

/// Asks of a part of the receiver what was asked of all of it.
Status ShareIntegrator::narrow(const Cell& cell, Range blockers, Range* narrowed, Fate* fate) {
  const double u = cell.u, v = cell.v, size = cell.size;
  const Vec3 corners[4] = {
      spot_of(cell.corners, u, v).point, spot_of(cell.corners, u + size, v).point,
      spot_of(cell.corners, u + size, v + size).point, spot_of(cell.corners, u, v + size).point};
  const Facet facet = Facet::of(corners, receiver_->plane.normal);
  Shaft shaft(facet, *to_, plane_tolerance_);
  narrowed->begin = blockers_.size();
  *fate = Fate::kOpen;
  for (std::size_t k = blockers.begin; k < blockers.end; ++k) {
    const Blocker blocker = blockers_[k];
    const Shaft::Verdict verdict =
        blocker.in_target_plane ? Shaft::Verdict::kMayBlock : shaft.test(*blocker.facet);
    if (verdict == Shaft::Verdict::kBlocksAll) {
      *fate = Fate::kHidden;
      break;
    }
    if (verdict == Shaft::Verdict::kMayBlock)
      HC_TRY(blockers_.push_back(blocker));
  }
  narrowed->end = blockers_.size();
  if (*fate == Fate::kOpen && narrowed->begin == narrowed->end)
    *fate = Fate::kSeen;
  return {};
}

/// Adds the integral over a cell, whose points are `sums`, to `refined`.
/// @param missed  what its points may have missed: see missed_per_whole
/// @param budget  points that may be spent; quarters that need more share it evenly
Status ShareIntegrator::refine(const Cell& cell, Range blockers, const Sums& sums, double missed,
                               double tolerance, double budget, Totals* refined, double* error) {
  const double part = sums.whole / all_;
  const double kink = sums.kink() / all_;
  const double unsure = max_number(kink, missed);
  if ((unsure <= tolerance && part <= largest_part_) || budget < 16) {
    refined->open += sums.whole;
    refined->open_visible += sums.visible;
    *error += unsure;
    return {};
  }
  Cell quarters[4];
  Sums parts[4], all;
  Range narrowed[4];
  Fate fates[4];
  const std::size_t blockers_before = blockers_.size();
  double rest = 0, open = 0;
  for (int k = 0; k < 4; ++k) {
    const double half = cell.size / 2;
    quarters[k] = {cell.corners, cell.u + (k % 2) * half, cell.v + (k / 2) * half, half};
    HC_TRY(narrow(quarters[k], blockers, &narrowed[k], &fates[k]));
    const bool is_open = fates[k] == Fate::kOpen;
    HC_TRY(sample(quarters[k], is_open ? narrowed[k] : Range(), false, &parts[k]));
    if (fates[k] == Fate::kHidden)
      parts[k].visible = parts[k].least = parts[k].most = 0;
    all.whole += parts[k].whole;
    all.visible += parts[k].visible;
    open += is_open ? parts[k].whole : 0;
    rest = parts[k].kink() / all_ > rest ? parts[k].kink() / all_ : rest;
  }
  const double coarse = sums.whole > 0 ? sums.visible / sums.whole : 0;
  const double fine = all.whole > 0 ? all.visible / all.whole : 0;
  const double left = kErrorLeft * std::fabs(fine - coarse) * part;
  const double gap = missed_per_whole(all.whole, sums.whole);
  // Two rules may agree by chance: what the quarters' own points show counts as well.
  rest = max_number(rest, gap * open);
  const bool agrees = left <= tolerance && rest <= tolerance;
  if (agrees)
    *error += left > rest ? left : rest;
  bool is_done[4];
  int left_open = 0;
  for (int k = 0; k < 4; ++k) {
    is_done[k] = fates[k] != Fate::kOpen || (agrees && parts[k].whole <= largest_part_ * all_);
    left_open += is_done[k] ? 0 : 1;
  }
  for (int k = 0; k < 4; ++k) {
    if (!is_done[k]) // errors of parts are independent: their squares add up
      HC_TRY(refine(quarters[k], narrowed[k], parts[k], gap * parts[k].whole, tolerance / 2,
                    (budget - 16) / left_open, refined, error));
    else if (fates[k] == Fate::kSeen)
      refined->seen += parts[k].whole;
    else if (fates[k] == Fate::kHidden)
      refined->hidden += parts[k].whole;
    else {
      refined->open += parts[k].whole;
      refined->open_visible += parts[k].visible;
    }
  }
  while (blockers_.size() > blockers_before)
    blockers_.pop_back();
  return {};
}

Status ShareIntegrator::find(const Facet& to, std::span<const Blocker> blockers, double whole,
                             const Effort& effort, VisibleShare* share) {
  *share = {};
  to_ = &to;
  all_ = whole;
  HC_TRY(blockers_.assign(blockers));
  const Range all_blockers{0, blockers.size()};
  largest_part_ = effort.largest_part;
  // Points behind the target see nothing of it: the rule's points go where there is something.
  const ConvexPolygon polygon(receiver_->corners);
  double side[ConvexPolygon::kMaxCorners];
  bool is_all_in_front = true;
  for (int k = 0; k < polygon.count; ++k) {
    side[k] = to.plane.side(polygon.corners[k]);
    is_all_in_front = is_all_in_front && side[k] >= 0;
  }
  ConvexPolygon seeing;
  cut(polygon, side, 0, &seeing, nullptr);
  Vec3 corners[kMaxCells][4];
  const int cells = split(seeing, corners);
  const bool keeps = is_all_in_front && cells == 1;
  Totals totals;
  double error = 0;
  Sums sums[kMaxCells];
  double all = 0;
  for (int k = 0; k < cells; ++k) {
    HC_TRY(sample({corners[k], 0, 0, 1}, all_blockers, keeps, &sums[k]));
    all += sums[k].whole;
  }
  const double missed = missed_per_whole(all, whole);
  for (int k = 0; k < cells; ++k)
    HC_TRY(refine({corners[k], 0, 0, 1}, all_blockers, sums[k], missed * sums[k].whole,
                  effort.tolerance, effort.max_points, &totals, &error));
  share->share = totals.share(whole);
  share->error = error;
  share->doubt = error > kUnseen ? error : kUnseen;
  return {};
}

Status ShareIntegrator::find_at_point(const Facet& to, std::span<const Blocker> blockers,
                                      VisibleShare* share) {
  *share = {};
  HC_TRY(blockers_.assign(blockers));
  const Vec3& eye = receiver_->corners[0];
  HC_TRY(find_shadows(eye, {0, blockers.size()}, nullptr));
  PointFormFactors seen;
  HC_TRY(visible_.find(eye, receiver_->plane.normal, to, in_the_way_.span(), &seen));
  if (seen.whole > 0)
    share->share = seen.visible / seen.whole;
  return {};
}

} // namespace hemicube::radiosity
