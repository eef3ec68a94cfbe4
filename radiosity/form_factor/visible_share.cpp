#include "radiosity/form_factor/visible_share.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// The two-point Gauss rule on 0..1.
constexpr double kGauss[2] = {0.21132486540518711775, 0.78867513459481288225};

/// A kink between the points of a cell moves their mean by at most about this part of the
/// difference between them.
constexpr double kKinkShare = 0.125;

/// Two rules that differ by d leave about a quarter of it in the finer one, where the integrand has
/// kinks; half of it is said.
constexpr double kErrorLeft = 0.5;

} // namespace

Status ShareIntegrator::sample(const Cell& cell, Sums* sums) {
  const Vec3& a = cell.corners[0];
  const Vec3 ab = cell.corners[1] - a, ad = cell.corners[3] - a;
  const Vec3 twist = cell.corners[2] - cell.corners[1] - ad;
  for (const double gu : kGauss)
    for (const double gv : kGauss) {
      const double u = cell.u + gu * cell.size, v = cell.v + gv * cell.size;
      const Vec3 along_u = ab + twist * v, along_v = ad + twist * u;
      const Vec3 point = a + ab * u + along_v * v;
      const double weight =
          glm::dot(glm::cross(along_u, along_v), normal_) * cell.size * cell.size;
      PointFormFactors at;
      HC_TRY(visible_.find(point, normal_, *to_, blockers_, &at));
      ++point_count_;
      if (!(at.whole > 0))
        continue;
      const double share = at.visible / at.whole;
      sums->least = std::fmin(sums->least, share);
      sums->most = std::fmax(sums->most, share);
      sums->whole += weight * at.whole;
      sums->visible += weight * at.visible;
    }
  return {};
}

Status ShareIntegrator::refine(const Cell& cell, const Sums& sums, double tolerance, Sums* refined,
                               double* error) {
  const double part = all_ > 0 ? sums.whole / all_ : 0;
  const double kink = kKinkShare * (sums.most - sums.least) * part;
  if (!(kink > tolerance) || point_count_ >= point_limit_) {
    refined->whole += sums.whole;
    refined->visible += sums.visible;
    *error += kink > 0 ? kink : 0;
    return {};
  }
  Cell quarters[4];
  Sums parts[4], all;
  for (int k = 0; k < 4; ++k) {
    const double half = cell.size / 2;
    quarters[k] = {cell.corners, cell.u + (k % 2) * half, cell.v + (k / 2) * half, half};
    HC_TRY(sample(quarters[k], &parts[k]));
    all.whole += parts[k].whole;
    all.visible += parts[k].visible;
  }
  const double coarse = sums.whole > 0 ? sums.visible / sums.whole : 0;
  const double fine = all.whole > 0 ? all.visible / all.whole : 0;
  const double left = kErrorLeft * std::fabs(fine - coarse) * part;
  if (left <= tolerance) {
    // Both agree by chance where the kinks of a cell cancel: what its quarters still show counts.
    double rest = 0;
    for (const Sums& quarter : parts)
      rest = std::fmax(rest, kKinkShare * (quarter.most - quarter.least) * quarter.whole / all_);
    if (rest <= tolerance) {
      refined->whole += all.whole;
      refined->visible += all.visible;
      *error += std::fmax(left, rest);
      return {};
    }
  }
  // Errors of parts are independent: their squares add up.
  for (int k = 0; k < 4; ++k)
    HC_TRY(refine(quarters[k], parts[k], tolerance / 2, refined, error));
  return {};
}

Status ShareIntegrator::find(const Facet& from, const Facet& to,
                             std::span<const Blocker> blockers, double tolerance,
                             std::uint32_t max_points, VisibleShare* share) {
  *share = {};
  normal_ = from.plane.normal;
  to_ = &to;
  blockers_ = blockers;
  point_limit_ = point_count_ + max_points;
  ConvexPolygon whole;
  for (const Vec3& corner : from.corners)
    whole.append(corner);
  // Points behind the target see nothing of it: the rule's points go where there is something.
  const ConvexPolygon seeing = clip(whole, to.plane, 0);
  constexpr int kMaxCells = ConvexPolygon::kMaxCorners / 2;
  Vec3 corners[kMaxCells][4];
  Sums sums[kMaxCells];
  int cells = 0;
  for (int k = 1; k + 1 < seeing.count; k += 2, ++cells) {
    corners[cells][0] = seeing.corners[0];
    corners[cells][1] = seeing.corners[k];
    corners[cells][2] = seeing.corners[k + 1];
    corners[cells][3] = seeing.corners[k + 2 < seeing.count ? k + 2 : 0];
  }
  all_ = 0;
  for (int k = 0; k < cells; ++k) {
    HC_TRY(sample({corners[k], 0, 0, 1}, &sums[k]));
    all_ += sums[k].whole;
  }
  if (!(all_ > 0))
    return {};
  Sums refined;
  double error = 0;
  for (int k = 0; k < cells; ++k)
    HC_TRY(refine({corners[k], 0, 0, 1}, sums[k], tolerance, &refined, &error));
  if (refined.whole > 0)
    share->share = refined.visible / refined.whole;
  share->error = error;
  return {};
}

} // namespace hemicube::radiosity
