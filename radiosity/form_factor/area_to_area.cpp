#include "radiosity/form_factor/area_to_area.h"

#include "radiosity/elementary.h"
#include "radiosity/form_factor/area_quadrature.h"
#include "radiosity/form_factor/edge_integrals.h"
#include "radiosity/form_factor/far_exchange.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace hemicube::radiosity {
namespace {

/// One unit in the last place of 1, halved.
constexpr double kRounding = 0x1p-53;

// Nanoseconds, roughly: what the methods' parts take.
constexpr double kKernelCost = 1.1, kLambertEdgeCost = 20, kClosedFormCost = 150, kGradedCost = 600;
/// Of what comes before the method, and of the quick way for pairs well apart.
constexpr double kOverhead = 400, kQuickCost = 150;
/// Quadrature cheaper than this is taken without a look at the other methods.
constexpr double kCheap = 300;
/// Relative errors below this are not worth splitting a polygon.
constexpr double kFinest = 1e-11;

double larger(double a, double b) {
  return a > b ? a : b;
}

/// Whether p comes first in an order that does not depend on which argument it was.
bool comes_first(std::span<const Vec3> p, std::span<const Vec3> q) {
  if (p.size() != q.size())
    return p.size() < q.size();
  for (std::size_t k = 0; k < p.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      if (p[k][axis] != q[k][axis])
        return p[k][axis] < q[k][axis];
  return true;
}

/// How a polygon lies to another's plane.
struct Sides {
  double side[ConvexPolygon::kMaxCorners];
  double tolerance = 0;
  bool any_front = false, any_back = false;

  Sides(const ConvexPolygon& polygon, const PreparedArea& base, double coordinate) {
    double reach = 0;
    const Vec3 origin = base.corners[0];
    for (int k = 0; k < polygon.count; ++k) {
      const Vec3 arm = polygon.corners[k] - origin;
      side[k] = glm::dot(base.normal, arm);
      reach = larger(reach, glm::dot(arm, arm));
    }
    tolerance = height_tolerance(coordinate, std::sqrt(reach), base.width);
    for (int k = 0; k < polygon.count; ++k) {
      any_front |= side[k] > tolerance;
      any_back |= side[k] < -tolerance;
    }
  }
};

/// Copies a polygon relative to an origin, times a power of two.
void localise(const ConvexPolygon& from, const Vec3& origin, double scale, AreaShape* shape) {
  shape->polygon.count = from.count;
  for (int k = 0; k < from.count; ++k)
    shape->polygon.corners[k] = (from.corners[k] - origin) * scale;
}

/// The power of two below x > 0.
double power_of_two_below(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000);
}

/// What contour integration takes: edges that are all parallel or perpendicular have closed forms.
double contour_cost(const AreaShape& p, const AreaShape& q) {
  const double pairs = static_cast<double>(p.polygon.count) * q.polygon.count;
  if (p.polygon.count != 4 || q.polygon.count != 4 || p.bend > 0 || q.bend > 0)
    return pairs * kGradedCost;
  double cost = 0;
  for (const Vec3& e : {p.axis_u, p.axis_v})
    for (const Vec3& f : {q.axis_u, q.axis_v}) {
      const double cosine = std::fabs(glm::dot(e, f)) / std::sqrt(glm::dot(e, e) * glm::dot(f, f));
      cost += cosine < 0x1p-49 ? 0 : 4 * (cosine > 1 - 0x1p-49 ? kClosedFormCost : kGradedCost);
    }
  return cost;
}

/// The exchange area to a factor of some ten, for the choice of a method.
double rough_value(const AreaShape& p, const AreaShape& q, double square) {
  const double spread = square + (p.area + q.area) / kPi;
  return p.area * q.area * p.height * q.height / (kPi * spread * spread);
}

/// One of the two parts of a polygon: a quadrilateral is halved across its longer parameter, a
/// triangle across its longest edge, others along a diagonal.
AreaShape half_of(const AreaShape& shape, int half) {
  const ConvexPolygon& from = shape.polygon;
  const int count = from.count;
  AreaShape made;
  made.normal = shape.normal;
  if (count > 4) {
    const int first = half == 0 ? 0 : count / 2, last = half == 0 ? count / 2 : count;
    for (int k = first; k <= last; ++k)
      made.polygon.append(from.corners[k == count ? 0 : k]);
  } else if (count == 4) {
    const Vec3* c = from.corners;
    const int turn = shape.half_u >= shape.half_v ? 0 : 1;
    const Vec3 &c0 = c[turn], &c1 = c[1 + turn], &c2 = c[2 + turn], &c3 = c[(3 + turn) & 3];
    const Vec3 one = (c0 + c1) * 0.5, two = (c2 + c3) * 0.5;
    for (const Vec3& corner :
         half == 0 ? std::array{c0, one, two, c3} : std::array{one, c1, c2, two})
      made.polygon.append(corner);
  } else {
    int longest = 0;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = from.corners[(k + 1) % 3] - from.corners[k];
      if (glm::dot(edge, edge) > square) {
        square = glm::dot(edge, edge);
        longest = k;
      }
    }
    const Vec3 &a = from.corners[longest], &b = from.corners[(longest + 1) % 3];
    const Vec3 middle = (a + b) * 0.5;
    made.polygon.append(half == 0 ? a : middle);
    made.polygon.append(half == 0 ? middle : b);
    made.polygon.append(from.corners[(longest + 2) % 3]);
  }
  measure(&made);
  return made;
}

/// What is left to split when no method is good enough.
constexpr int kMaxSplits = 8;

AreaIntegral integrate(const AreaShape& p, const AreaShape& q, double relative_error, int splits);

/// The larger of the two areas in halves.
AreaIntegral integrate_halves(const AreaShape& p, const AreaShape& q, double relative_error,
                              int splits) {
  AreaIntegral sum;
  const bool first = p.radius >= q.radius;
  for (int half = 0; half < 2; ++half) {
    AreaShape part = half_of(first ? p : q, half), other = first ? q : p;
    measure_height(&part, {other.polygon.corners[0], other.normal});
    measure_height(&other, {part.polygon.corners[0], part.normal});
    const AreaIntegral one = first ? integrate(part, other, relative_error, splits + 1)
                                   : integrate(other, part, relative_error, splits + 1);
    sum.value += one.value;
    sum.error += one.error;
    sum.work += one.work;
  }
  return sum;
}

AreaIntegral integrate(const AreaShape& p, const AreaShape& q, double relative_error, int splits) {
  const TensorOrders both = choose_orders(p, q, relative_error);
  double best = both.evaluations * kKernelCost;
  if (best <= kCheap) {
    const double value = tensor_exchange(p, q, both);
    return {value, value * (both.bound + 16 * kRounding), best + kOverhead};
  }
  const Vec3 between = q.centre - p.centre;
  const double rough = rough_value(p, q, glm::dot(between, between));
  const TensorOrders on_p =
      choose_outer_orders(p, distance_to_polygon(p.centre, q), relative_error);
  const TensorOrders on_q =
      choose_outer_orders(q, distance_to_polygon(q.centre, p), relative_error);
  const double p_cost = on_p.evaluations * q.polygon.count * kLambertEdgeCost;
  const double q_cost = on_q.evaluations * p.polygon.count * kLambertEdgeCost;
  double edges_cost = contour_cost(p, q);
  // Terms of the contour sum are of the size of the polygons' circumferences; they cancel.
  if (16 * kRounding * p.radius * q.radius > relative_error * rough)
    edges_cost *= 1000;
  best = best < p_cost ? best : p_cost;
  best = best < q_cost ? best : q_cost;
  if (edges_cost <= best) {
    const ContourSum sum =
        contour_exchange(p.polygon, q.polygon,
                         larger(0.25 * relative_error * rough, kRounding * p.radius * q.radius));
    const double error = sum.error + 8 * kRounding * sum.magnitude;
    if (error > 16 * larger(relative_error, kFinest) * sum.value && splits < kMaxSplits)
      return integrate_halves(p, q, relative_error, splits);
    return {larger(sum.value, 0), error, edges_cost + kOverhead};
  }
  if (p_cost == best) {
    const double value = larger(outer_exchange(p, q, on_p), 0);
    return {value, value * (on_p.bound + 16 * kRounding) + 4 * kRounding * p.area,
            p_cost + kOverhead};
  }
  if (q_cost == best) {
    const double value = larger(outer_exchange(q, p, on_q), 0);
    return {value, value * (on_q.bound + 16 * kRounding) + 4 * kRounding * q.area,
            q_cost + kOverhead};
  }
  const double value = tensor_exchange(p, q, both);
  return {value, value * (both.bound + 16 * kRounding), best + kOverhead};
}

AreaIntegral exchange_ordered(const PreparedArea& p, const PreparedArea& q, double relative_error);

/// A polygon without room for the corner that a cut adds, in two parts.
AreaIntegral exchange_halves(const PreparedArea& whole, const PreparedArea& q,
                             double relative_error) {
  const ConvexPolygon p(whole.corners);
  AreaIntegral sum;
  for (int half = 0; half < 2; ++half) {
    ConvexPolygon part;
    const int first = half == 0 ? 0 : p.count / 2, last = half == 0 ? p.count / 2 : p.count;
    for (int k = first; k <= last; ++k)
      part.append(p.corners[k == p.count ? 0 : k]);
    const AreaIntegral one =
        exchange_ordered(prepare_area(part.span(), whole.normal), q, relative_error);
    sum.value += one.value;
    sum.error += one.error;
    sum.work += one.work;
  }
  return sum;
}

AreaIntegral exchange_ordered(const PreparedArea& of_p, const PreparedArea& of_q,
                              double relative_error) {
  const double coordinate = larger(of_p.coordinate, of_q.coordinate);
  const ConvexPolygon p(of_p.corners), q(of_q.corners);
  const Sides p_sides(p, of_q, coordinate), q_sides(q, of_p, coordinate);
  if (!p_sides.any_front || !q_sides.any_front)
    return {};
  if (p_sides.any_back && p.is_full())
    return exchange_halves(of_p, of_q, relative_error);
  if (q_sides.any_back && q.is_full())
    return exchange_halves(of_q, of_p, relative_error);
  ConvexPolygon cut_p, cut_q;
  const ConvexPolygon *front_p = &p, *front_q = &q;
  if (p_sides.any_back) {
    cut(p, p_sides.side, p_sides.tolerance, &cut_p, nullptr);
    front_p = &cut_p;
  }
  if (q_sides.any_back) {
    cut(q, q_sides.side, q_sides.tolerance, &cut_q, nullptr);
    front_q = &cut_q;
  }
  const Vec3 origin = p.corners[0];
  double size = 0;
  for (const ConvexPolygon* one : {front_p, front_q})
    for (int k = 0; k < one->count; ++k) {
      const Vec3 arm = one->corners[k] - origin;
      size = larger(size, glm::dot(arm, arm));
    }
  const double unit_length = power_of_two_below(std::sqrt(size));
  AreaShape shape_p, shape_q;
  localise(*front_p, origin, 1 / unit_length, &shape_p);
  localise(*front_q, origin, 1 / unit_length, &shape_q);
  shape_p.normal = of_p.normal;
  shape_q.normal = of_q.normal;
  measure(&shape_p);
  measure(&shape_q);
  if (!(shape_p.area > 0 && shape_q.area > 0))
    return {};
  measure_height(&shape_p, {shape_q.polygon.corners[0], of_q.normal});
  measure_height(&shape_q, {shape_p.polygon.corners[0], of_p.normal});
  const AreaIntegral local = integrate(shape_p, shape_q, relative_error, 0);
  const double square = unit_length * unit_length;
  return {local.value * square, local.error * square, local.work};
}

} // namespace

AreaIntegral exchange_area(const PreparedArea& p, const PreparedArea& q,
                           double relative_error) noexcept {
  if (!(p.area > 0 && q.area > 0))
    return {};
  const bool in_order = comes_first(p.corners, q.corners);
  const PreparedArea &first = in_order ? p : q, &second = in_order ? q : p;
  AreaIntegral result;
  if (!far_exchange(first, second, relative_error, &result))
    return exchange_ordered(first, second, relative_error);
  result.work = kQuickCost;
  return result;
}

AreaIntegral exchange_area(const ConvexPolygon& p, const Vec3& normal_p, const ConvexPolygon& q,
                           const Vec3& normal_q, double relative_error) noexcept {
  return exchange_area(prepare_area(p.span(), normal_p), prepare_area(q.span(), normal_q),
                       relative_error);
}

} // namespace hemicube::radiosity
