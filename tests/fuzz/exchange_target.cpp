// What two polygons exchange with nothing between them: against Lambert's formula in long double
// under quadrature, against the sum of their parts, and against itself where it must not change.

#include "radiosity/elementary.h"
#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/gauss_legendre.h"
#include "radiosity/form_factor/lambert.h"
#include "tests/fuzz/polygon_decoder.h"
#include "tests/fuzz/polygon_pair.h"
#include "tests/fuzz/target.h"
#include "tests/support/lambert.h"
#include "tests/support/polygon_shapes.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hemicube::test {
namespace {

using radiosity::AreaIntegral;
using radiosity::ConvexPolygon;

AreaIntegral exchange(const Polygon& p, const Vec3& normal_p, const Polygon& q,
                      const Vec3& normal_q, double relative_error) {
  return radiosity::exchange_area(ConvexPolygon(p), normal_p, ConvexPolygon(q), normal_q,
                                  relative_error);
}

/// The integral over a triangle of Lambert's form factor to `q`, by a rule of 8 x 8 points.
double over_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const PairSide& p,
                     const PairSide& q) {
  constexpr int kOrder = 8;
  const auto* nodes = radiosity::gauss_legendre(kOrder);
  const double area = glm::length(glm::cross(b - a, c - a)) / 2;
  double sum = 0;
  for (int i = 0; i < kOrder; ++i)
    for (int j = 0; j < kOrder; ++j) {
      const double u = (nodes[i].x + 1) / 2, v = (nodes[j].x + 1) / 2;
      const Vec3 point = a + (b - a) * u + (c - b) * (u * v);
      sum += nodes[i].weight * nodes[j].weight * 2 * u *
             lambert_form_factor(point, p.normal, q.corners);
    }
  return area * sum;
}

struct Estimate {
  double value = 0, error = 0;
};

/// Over what of p sees the front of q, where the form factor is smooth: on triangles, and on four
/// times as many. The error of the second rule is taken for the difference.
Estimate by_lambert(const PairSide& p, const PairSide& q) {
  const Polygon seeing = clipped(p.corners, q.corners[0], q.normal);
  double coarse = 0, fine = 0;
  for (std::size_t k = 2; k < seeing.size(); ++k) {
    const Vec3 &a = seeing[0], &b = seeing[k - 1], &c = seeing[k];
    const Vec3 ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    coarse += over_triangle(a, b, c, p, q);
    fine += over_triangle(a, ab, ca, p, q) + over_triangle(ab, b, bc, p, q) +
            over_triangle(ca, bc, c, p, q) + over_triangle(bc, ca, ab, p, q);
  }
  return {fine, std::fabs(fine - coarse)};
}

/// Both polygons in halves.
Estimate by_parts(const PairSide& p, const PairSide& q, double relative_error) {
  Estimate sum;
  for (const Polygon& part_p : halves(p.corners, 0.4))
    for (const Polygon& part_q : halves(q.corners, 0.6)) {
      const AreaIntegral one = exchange(part_p, p.normal, part_q, q.normal, relative_error);
      sum.value += one.value;
      sum.error += one.error;
    }
  return sum;
}

std::string differ(const char* what, double found, double expected, double allowed) {
  if (std::fabs(found - expected) <= allowed)
    return "";
  std::ostringstream text;
  text.precision(17);
  text << what << ": " << found << ", expected " << expected << " to " << allowed;
  return text.str();
}

std::string invariance_problem(const PairSide& p, const PairSide& q, const AreaIntegral& whole,
                               double asked) {
  const AreaIntegral back = exchange(q.corners, q.normal, p.corners, p.normal, asked);
  if (back.value != whole.value || back.error != whole.error)
    return differ("exchanged", back.value, whole.value, -1);
  for (const int power : {-20, 13}) {
    const double scale = std::ldexp(1.0, power);
    Polygon scaled_p = p.corners, scaled_q = q.corners;
    for (Polygon* polygon : {&scaled_p, &scaled_q})
      for (Vec3& corner : *polygon)
        corner *= scale;
    const AreaIntegral scaled = exchange(scaled_p, p.normal, scaled_q, q.normal, asked);
    if (scaled.value != whole.value * scale * scale)
      return differ("scaled", scaled.value / (scale * scale), whole.value, -1);
  }
  return "";
}

std::string point_problem(const Vec3& eye, const PairSide& p, const PairSide& q) {
  const double expected = lambert_form_factor(eye, p.normal, q.corners);
  const double found = radiosity::point_to_polygon(eye, p.normal, q.corners);
  // A small area at `eye` whose coordinates are rounded, too; the nearest it can be is unknown, so
  // only where it is not near.
  const double distance = glm::length(eye - q.centre) - q.radius;
  const double rounding = 0x1p-49 * std::max(p.coordinate, q.coordinate);
  if (distance <= 0)
    return found >= -1 && found <= 1 ? "" : differ("near point", found, expected, 1);
  return differ("point", std::max(found, 0.0), expected,
                1e-12 * expected + 1e-15 +
                    4 * rounding * q.perimeter / (radiosity::kPi * distance * distance));
}

std::string pair_problem(const PairSide& p, const PairSide& q, double asked) {
  const AreaIntegral whole = exchange(p.corners, p.normal, q.corners, q.normal, asked);
  const double rounding = rounding_of(p, q);
  if (!(whole.value >= 0 && whole.error >= 0 && std::isfinite(whole.error)))
    return differ("no amount", whole.value, 0, whole.error);
  if (whole.value > std::min(p.area, q.area) + whole.error + rounding)
    return differ("more than all", whole.value, std::min(p.area, q.area), whole.error + rounding);
  std::string problem = invariance_problem(p, q, whole, asked);
  if (!problem.empty())
    return problem;
  if (lie_in_one_plane(p, q))
    return "";
  const Estimate parts = by_parts(p, q, 1e-10);
  problem = differ("parts", whole.value, parts.value, whole.error + parts.error + rounding);
  if (!problem.empty() || !are_well_apart(p, q))
    return problem;
  const Estimate lambert = p.area <= q.area ? by_lambert(p, q) : by_lambert(q, p);
  return differ("Lambert", whole.value, lambert.value,
                whole.error + 4 * lambert.error + 1e-12 * lambert.value + rounding);
}

} // namespace

Verdict judge_exchange(Bytes bytes) {
  ByteReader reader(bytes);
  static constexpr double kAsked[] = {1e-2, 1e-3, 1e-5, 1e-8, 1e-10};
  const double asked = kAsked[reader.below(5)];
  const bool are_neighbours = reader.below(2) == 1;
  PolygonList polygons = {decode_polygon(&reader)};
  polygons.push_back(are_neighbours ? decode_neighbour(&reader, polygons[0])
                                    : decode_polygon(&reader));
  if (reader.below(4) == 3)
    polygons = moved(polygons, 1, reader.point() * 1000.0);
  const auto patches = patches_if_kept(polygons);
  if (!patches)
    return {"", false};
  const PairSide p(*patches, 0), q(*patches, 1);
  std::string problem = pair_problem(p, q, asked);
  const Vec3 corner = p.corners[reader.byte() % p.corners.size()];
  for (const Vec3& eye : {p.centre, corner, (p.centre + corner) * 0.5})
    if (problem.empty())
      problem = point_problem(eye, p, q);
  return {problem};
}

} // namespace hemicube::test
