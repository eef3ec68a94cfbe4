#include "radiosity/form_factor/far_exchange.h"

#include "radiosity/elementary.h"
#include "radiosity/form_factor/area_quadrature.h"
#include "radiosity/form_factor/gauss_legendre.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr int kMaxOrder = 6, kMaxPoints = 36;
/// Kernel evaluations; more are left to the choice among all methods.
constexpr int kMaxEvaluations = 260;

/// How a parallelogram stands over the other's plane.
struct Height {
  double middle, u, v, spread;

  Height(double height, const PreparedArea& area, const Vec3& normal)
      : middle(height), u(glm::dot(normal, area.half_u)), v(glm::dot(normal, area.half_v)),
        spread(std::fabs(u) + std::fabs(v)) {}
};

/// 1 / sin^2 of the smallest angle between an edge and any line between the two, or more.
/// @param along  of the line between the centres, along the edge, times the edge's length
double steepness(double square, double along, double length, double distance, double spread) {
  const double offset = std::sqrt(square * length * length - along * along) - spread * length;
  if (!(offset > 0))
    return kAnySteepness;
  const double inverse = (distance + spread) * length / offset;
  return inverse * inverse;
}

struct Orders {
  int u = 0, v = 0;
};

Orders orders_for(const PreparedArea& one, const PreparedArea& other, const Vec3& between,
                  double square, double distance, double tilt, double limit, double* bound) {
  const double spread = one.radius + other.radius;
  const auto order = [&](const Vec3& half, double length, double other_length) {
    const double steep = steepness(square, glm::dot(between, half), length, distance, spread);
    return smallest_order(length, distance - other_length - other.radius, steep, tilt, 0, limit,
                          bound);
  };
  return {order(one.half_u, one.length_u, one.length_v),
          order(one.half_v, one.length_v, one.length_u)};
}

/// The points of a rule on a parallelogram by coordinate, an even number, and their weights times
/// heights, which sum to the mean height.
struct Points {
  int count = 0;
  double x[kMaxPoints], y[kMaxPoints], z[kMaxPoints], weight[kMaxPoints];

  Points(const PreparedArea& area, const Height& height, const Vec3& shift, Orders orders) {
    const GaussNode *us = gauss_legendre(orders.u), *vs = gauss_legendre(orders.v);
    for (int i = 0; i < orders.u; ++i) {
      const Vec3 start = shift + area.half_u * us[i].x;
      const double above = height.middle + height.u * us[i].x;
      for (int j = 0; j < orders.v; ++j) {
        const double v = vs[j].x;
        x[count] = start.x + area.half_v.x * v;
        y[count] = start.y + area.half_v.y * v;
        z[count] = start.z + area.half_v.z * v;
        weight[count] = us[i].weight * vs[j].weight * (above + height.v * v);
        ++count;
      }
    }
    if (count % 2 != 0) {
      x[count] = x[count - 1];
      y[count] = y[count - 1];
      z[count] = z[count - 1];
      weight[count] = 0;
      ++count;
    }
  }
};

double mean_kernel(const Points& p, const Points& q) {
  double received[kMaxPoints];
  const int count = p.count;
  for (int i = 0; i < count; ++i)
    received[i] = 0;
  for (int j = 0; j < q.count; j += 2) {
    const double x0 = q.x[j], y0 = q.y[j], z0 = q.z[j], w0 = q.weight[j];
    const double x1 = q.x[j + 1], y1 = q.y[j + 1], z1 = q.z[j + 1], w1 = q.weight[j + 1];
    for (int i = 0; i < count; ++i) {
      const double dx0 = p.x[i] - x0, dy0 = p.y[i] - y0, dz0 = p.z[i] - z0;
      const double dx1 = p.x[i] - x1, dy1 = p.y[i] - y1, dz1 = p.z[i] - z1;
      const double square0 = dx0 * dx0 + dy0 * dy0 + dz0 * dz0;
      const double square1 = dx1 * dx1 + dy1 * dy1 + dz1 * dz1;
      const double r0 = square0 * square0, r1 = square1 * square1;
      received[i] += (w0 * r1 + w1 * r0) / (r0 * r1); // two kernels, one division
    }
  }
  double sum = 0;
  for (int i = 0; i < count; ++i)
    sum += p.weight[i] * received[i];
  return sum;
}

} // namespace

bool far_exchange(const PreparedArea& p, const PreparedArea& q, double relative_error,
                  AreaIntegral* result) noexcept {
  if (!p.parallelogram || !q.parallelogram)
    return false;
  const Vec3 between = q.centre - p.centre;
  const double square = glm::dot(between, between), distance = std::sqrt(square);
  const Height p_height(-glm::dot(q.normal, between), p, q.normal);
  const Height q_height(glm::dot(p.normal, between), q, p.normal);
  const double reach = distance + p.radius + q.radius;
  const double coordinate = p.coordinate > q.coordinate ? p.coordinate : q.coordinate;
  const double p_tolerance = height_tolerance(coordinate, reach, q.width);
  const double q_tolerance = height_tolerance(coordinate, reach, p.width);
  if (p_height.middle + p_height.spread <= p_tolerance ||
      q_height.middle + q_height.spread <= q_tolerance) {
    *result = {};
    return true;
  }
  if (p_height.middle - p_height.spread < -p_tolerance ||
      q_height.middle - q_height.spread < -q_tolerance)
    return false;
  const double p_tilt = p_height.spread < p_height.middle ? p_height.spread / p_height.middle : 1;
  const double q_tilt = q_height.spread < q_height.middle ? q_height.spread / q_height.middle : 1;
  double bound = 0;
  const double limit = 0.25 * relative_error;
  const Orders on_p = orders_for(p, q, between, square, distance, p_tilt, limit, &bound);
  const Orders on_q = orders_for(q, p, between, square, distance, q_tilt, limit, &bound);
  const int p_count = on_p.u * on_p.v, q_count = on_q.u * on_q.v;
  if (p_count == 0 || q_count == 0 || p_count > kMaxPoints || q_count > kMaxPoints ||
      p_count * q_count > kMaxEvaluations)
    return false;
  const Points p_points(p, p_height, Vec3(0, 0, 0), on_p), q_points(q, q_height, between, on_q);
  const double mean = mean_kernel(p_points, q_points) * (1 / kPi);
  const double value = mean > 0 ? p.area * q.area * mean : 0;
  *result = {value, value * (bound + 0x1p-48)};
  return true;
}

} // namespace hemicube::radiosity
