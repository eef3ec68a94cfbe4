#include "radiosity/form_factor/area_quadrature.h"

#include "radiosity/elementary.h"
#include "radiosity/form_factor/gauss_legendre.h"
#include "radiosity/form_factor/lambert.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr int kMaxPoints = 512;
constexpr double kNone = 1e300;
/// Jacobians that vary by less are constant.
constexpr double kNoBend = 0x1p-40;

double larger(double a, double b) {
  return a > b ? a : b;
}

/// A piece of a polygon as a bilinear map of [-1,1]^2: middle + u e + v f + u v g.
struct Piece {
  Vec3 middle, e, f, g;

  /// The piece with corners 0, k-1, k, k+1 of a polygon; the last of an odd number is a triangle.
  Piece(const ConvexPolygon& polygon, int k) {
    const Vec3 &a = polygon.corners[0], &b = polygon.corners[k - 1], &c = polygon.corners[k];
    const Vec3& d = polygon.corners[k + 1 < polygon.count ? k + 1 : k];
    middle = ((a + b) + (c + d)) * 0.25;
    e = ((b - a) + (c - d)) * 0.25;
    f = ((d - a) + (c - b)) * 0.25;
    g = ((a - b) + (c - d)) * 0.25;
  }
};

/// The orders tried, and the mean of the squared monic Legendre polynomial of that degree: what the
/// Gauss rule gets wrong in x^2n.
struct Order {
  int order;
  double constant;
};
constexpr Order kOrders[] = {
    {1, 0x1.5555555555555p-2},   {2, 0x1.6c16c16c16c17p-4},  {3, 0x1.767dce434a9b1p-6},
    {4, 0x1.7c6f8c751f177p-8},   {5, 0x1.80474d3ad46a7p-10}, {6, 0x1.82f73da871a64p-12},
    {7, 0x1.84f341e9a2ce8p-14},  {8, 0x1.8679bba548169p-16}, {10, 0x1.88aa84b1ac9cdp-20},
    {12, 0x1.8a29d2be150fdp-24}, {16, 0x1.8c13f2574e09fp-32}};

double smaller(double a, double b) {
  return a < b ? a : b;
}

/// 1 / sin^2 of the smallest angle between an axis and any line between the two polygons.
double steepness_of(const AreaShape& shape, const Vec3& axis, const Vec3& between, double distance,
                    double spread) {
  if (shape.bend > 0)
    return kAnySteepness;
  const Vec3 across = glm::cross(between, axis);
  const double offset = std::sqrt(glm::dot(across, across) / glm::dot(axis, axis)) - spread;
  if (!(offset > 0))
    return kAnySteepness;
  const double sine = offset / (distance + spread);
  return 1 / (sine * sine);
}

int piece_count(const AreaShape& shape) {
  return (shape.polygon.count - 1) / 2;
}

bool choose_for(const AreaShape& shape, const AreaShape& other, const Vec3& between,
                double distance, double limit, int* order_u, int* order_v, double* bound) {
  const double spread = shape.radius + other.radius;
  *order_u = smallest_order(shape.half_u, distance - shape.half_v - other.radius,
                            steepness_of(shape, shape.axis_u, between, distance, spread),
                            shape.tilt, shape.bend, limit, bound);
  *order_v = smallest_order(shape.half_v, distance - shape.half_u - other.radius,
                            steepness_of(shape, shape.axis_v, between, distance, spread),
                            shape.tilt, shape.bend, limit, bound);
  return *order_u != 0 && *order_v != 0 && piece_count(shape) * *order_u * *order_v <= kMaxPoints;
}

/// Points and weights on a polygon, by coordinate; the weight holds the height over the other
/// plane.
struct Rule {
  int count = 0;
  double x[kMaxPoints], y[kMaxPoints], z[kMaxPoints], weight[kMaxPoints];

  Rule() {} // the arrays stay unset

  void fill(const AreaShape& shape, int order_u, int order_v, const Plane* plane) {
    const GaussNode *us = gauss_legendre(order_u), *vs = gauss_legendre(order_v);
    for (int k = 2; k < shape.polygon.count; k += 2) {
      const Piece piece(shape.polygon, k);
      const double jacobian = glm::dot(shape.normal, glm::cross(piece.e, piece.f)) * 4;
      const double jacobian_u = glm::dot(shape.normal, glm::cross(piece.e, piece.g)) * 4;
      const double jacobian_v = glm::dot(shape.normal, glm::cross(piece.g, piece.f)) * 4;
      for (int i = 0; i < order_u; ++i) {
        const double u = us[i].x;
        const Vec3 start = piece.middle + piece.e * u, step = piece.f + piece.g * u;
        for (int j = 0; j < order_v; ++j) {
          const double v = vs[j].x;
          const Vec3 point = start + step * v;
          x[count] = point.x;
          y[count] = point.y;
          z[count] = point.z;
          weight[count] = us[i].weight * vs[j].weight *
                          (jacobian + u * jacobian_u + v * jacobian_v) *
                          (plane != nullptr ? plane->side(point) : 1.0);
          ++count;
        }
      }
    }
  }

  /// An even number of points, for two lanes: the last repeated without weight.
  void pad() {
    if (count % 2 == 0 || count == kMaxPoints)
      return;
    x[count] = x[count - 1];
    y[count] = y[count - 1];
    z[count] = z[count - 1];
    weight[count] = 0;
    ++count;
  }
};

} // namespace

int smallest_order(double half, double distance, double steepness, double tilt, double bend,
                   double limit, double* bound) noexcept {
  if (!(distance > half * 1.25))
    return 0;
  // 1 / r^4 is the sum of C_k(cos) t^k, C_k the Gegenbauer polynomials of index 2. With
  // t = 2 / (ratio's ellipse of convergence), or a little more, the rule's constant holds for all
  // of the tail.
  const double t = half * distance / (distance * distance - 0.31 * half * half), square = t * t;
  const double room = 1 - 0.25 * square, enough = limit * room;
  const double either = (tilt + bend) * t, product = tilt * bend;
  double power = 1;
  for (const Order& rule : kOrders) {
    if (rule.order <= 8) {
      if (rule.order > 1)
        power *= square;
    } else {
      power *= square * square;
      if (rule.order == 16)
        power *= square * square;
    }
    const double n = 2 * rule.order;
    // |C_k| is at most (k+1)(k+2)(k+3)/6 along the line and (k+1) / sin^2 across it.
    const double at_n = (n + 1) * smaller((n + 2) * (n + 3) * (1.0 / 6), steepness);
    const double at_n1 = n * smaller((n + 1) * (n + 2) * (1.0 / 6), steepness);
    const double at_n2 = (n - 1) * smaller(n * (n + 1) * (1.0 / 6), steepness);
    const double here = rule.constant * power * (at_n * square + either * at_n1 + product * at_n2);
    if (here <= enough) {
      *bound += here / room;
      return rule.order;
    }
  }
  return 0;
}

void measure(AreaShape* shape) noexcept {
  const ConvexPolygon& polygon = shape->polygon;
  Vec3 sum(0, 0, 0);
  for (int k = 0; k < polygon.count; ++k)
    sum += polygon.corners[k];
  shape->centre = sum * (1.0 / polygon.count);
  shape->area = glm::dot(area_vector(polygon.span()), shape->normal);
  double square = 0;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3 arm = polygon.corners[k] - shape->centre;
    square = larger(square, glm::dot(arm, arm));
  }
  shape->radius = std::sqrt(square);
  double square_u = 0, square_v = 0;
  for (int k = 2; k < polygon.count; k += 2) {
    const Piece piece(polygon, k);
    const Vec3 u0 = piece.e + piece.g, u1 = piece.e - piece.g, v0 = piece.f + piece.g,
               v1 = piece.f - piece.g;
    square_u = larger(square_u, larger(glm::dot(u0, u0), glm::dot(u1, u1)));
    square_v = larger(square_v, larger(glm::dot(v0, v0), glm::dot(v1, v1)));
    const double flat = std::fabs(glm::dot(shape->normal, glm::cross(piece.e, piece.f)));
    const double bent = larger(std::fabs(glm::dot(shape->normal, glm::cross(piece.e, piece.g))),
                               std::fabs(glm::dot(shape->normal, glm::cross(piece.g, piece.f))));
    shape->bend = larger(shape->bend, bent >= flat ? 1.0 : bent / flat);
    shape->axis_u = piece.e;
    shape->axis_v = piece.f;
  }
  if (shape->bend < kNoBend)
    shape->bend = 0;
  shape->half_u = std::sqrt(square_u);
  shape->half_v = std::sqrt(square_v);
}

void measure_height(AreaShape* shape, const Plane& plane) noexcept {
  double low = plane.side(shape->polygon.corners[0]), high = low;
  for (int k = 1; k < shape->polygon.count; ++k) {
    const double side = plane.side(shape->polygon.corners[k]);
    low = side < low ? side : low;
    high = side > high ? side : high;
  }
  low = low > 0 ? low : 0;
  shape->height = 0.5 * (low + high);
  shape->tilt = high > 0 ? (high - low) / (high + low) : 1;
}

TensorOrders choose_orders(const AreaShape& p, const AreaShape& q, double relative_error) noexcept {
  TensorOrders orders;
  const Vec3 between = q.centre - p.centre;
  const double distance = glm::length(between), limit = 0.25 * relative_error;
  orders.evaluations = kNone;
  if (choose_for(p, q, between, distance, limit, &orders.p_u, &orders.p_v, &orders.bound) &&
      choose_for(q, p, between, distance, limit, &orders.q_u, &orders.q_v, &orders.bound))
    orders.evaluations = static_cast<double>(piece_count(p) * orders.p_u * orders.p_v) *
                         (piece_count(q) * orders.q_u * orders.q_v);
  return orders;
}

TensorOrders choose_outer_orders(const AreaShape& p, double distance,
                                 double relative_error) noexcept {
  TensorOrders orders;
  const double limit = 0.5 * relative_error;
  orders.p_u = smallest_order(p.half_u, distance - p.half_v, kAnySteepness, p.tilt, p.bend, limit,
                              &orders.bound);
  orders.p_v = smallest_order(p.half_v, distance - p.half_u, kAnySteepness, p.tilt, p.bend, limit,
                              &orders.bound);
  orders.evaluations = orders.p_u == 0 || orders.p_v == 0
                           ? kNone
                           : static_cast<double>(piece_count(p) * orders.p_u * orders.p_v);
  if (orders.evaluations > kMaxPoints)
    orders.evaluations = kNone;
  return orders;
}

double tensor_exchange(const AreaShape& p, const AreaShape& q,
                       const TensorOrders& orders) noexcept {
  const Plane plane_p{p.polygon.corners[0], p.normal}, plane_q{q.polygon.corners[0], q.normal};
  Rule on_p, on_q;
  on_p.fill(p, orders.p_u, orders.p_v, &plane_q);
  on_p.pad();
  on_q.fill(q, orders.q_u, orders.q_v, &plane_p);
  double received[kMaxPoints];
  const int count = on_p.count;
  for (int i = 0; i < count; ++i)
    received[i] = 0;
  for (int j = 0; j < on_q.count; ++j) {
    const double x = on_q.x[j], y = on_q.y[j], z = on_q.z[j], weight = on_q.weight[j];
    for (int i = 0; i < count; ++i) {
      const double dx = on_p.x[i] - x, dy = on_p.y[i] - y, dz = on_p.z[i] - z;
      const double square = dx * dx + dy * dy + dz * dz;
      received[i] += weight / (square * square);
    }
  }
  double sum = 0;
  for (int i = 0; i < count; ++i)
    sum += on_p.weight[i] * received[i];
  // Heights of points next to the other's plane may round below 0.
  return sum > 0 ? sum * (1 / kPi) : 0;
}

double outer_exchange(const AreaShape& p, const AreaShape& q, const TensorOrders& orders) noexcept {
  Rule on_p;
  on_p.fill(p, orders.p_u, orders.p_v, nullptr);
  double sum = 0;
  for (int i = 0; i < on_p.count; ++i)
    sum += on_p.weight[i] *
           point_to_polygon(Vec3(on_p.x[i], on_p.y[i], on_p.z[i]), p.normal, q.polygon.span());
  return sum;
}

double distance_to_polygon(const Vec3& point, const AreaShape& shape) noexcept {
  const ConvexPolygon& polygon = shape.polygon;
  const double height = glm::dot(shape.normal, point - polygon.corners[0]);
  double nearest = -1;
  bool inside = true;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3 &a = polygon.corners[k], &b = polygon.corners[k + 1 == polygon.count ? 0 : k + 1];
    const Vec3 edge = b - a, arm = point - a;
    inside &= glm::dot(shape.normal, glm::cross(edge, arm)) >= 0;
    const double square = glm::dot(edge, edge);
    double t = square > 0 ? glm::dot(arm, edge) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    const Vec3 rest = arm - edge * t;
    const double here = glm::dot(rest, rest);
    nearest = nearest < 0 || here < nearest ? here : nearest;
  }
  return inside ? std::fabs(height) : std::sqrt(nearest);
}

} // namespace hemicube::radiosity
