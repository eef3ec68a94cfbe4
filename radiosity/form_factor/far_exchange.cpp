#include "radiosity/form_factor/far_exchange.h"

#include "radiosity/elementary.h"
#include "radiosity/form_factor/area_quadrature.h"
#include "radiosity/form_factor/gauss_legendre.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr int kMaxOrder = 5, kMaxPoints = 26;
/// Kernel evaluations; more are left to the choice among all methods.
constexpr int kMaxEvaluations = 260;

/// What the Gauss rule of each order gets wrong in x^2n, times 2n+1 and 2n, and how much more the
/// Gegenbauer polynomials of index 2 and those degrees may be along a line than across it.
struct BoundTerms {
  double at_n, at_n1, most_n, most_n1;
};
constexpr BoundTerms bound_terms(int order, double constant) {
  const double n = 2 * order;
  return {constant * (n + 1), constant * n, (n + 2) * (n + 3) / 6, (n + 1) * (n + 2) / 6};
}
constexpr BoundTerms kBoundTerms[kMaxOrder] = {
    bound_terms(1, 1.0 / 3), bound_terms(2, 4.0 / 45), bound_terms(3, 4.0 / 175),
    bound_terms(4, 64.0 / 11025), bound_terms(5, 64.0 / 43659)};

/// How a parallelogram stands over the other's plane.
struct Height {
  double middle, u, v, spread;

  Height(double height, const PreparedArea& area, const Vec3& normal)
      : middle(height), u(glm::dot(normal, area.half_u)), v(glm::dot(normal, area.half_v)),
        spread(std::fabs(u) + std::fabs(v)) {}
};

/// The orders along the parameters u and v of p, then of q.
struct Orders {
  double order[4];
  double bound = 0; ///< of the relative error; huge if no order is good enough
};

/// What smallest_order does, for four lines at once: as long as it is mostly loops of four, it
/// vectorises.
class OrderChoice {
public:
  OrderChoice(const PreparedArea& p, const PreparedArea& q, const Vec3& between, double square,
              double distance, double p_tilt, double q_tilt) {
    const double half[4] = {p.length_u, p.length_v, q.length_u, q.length_v};
    const double along[4] = {glm::dot(between, p.half_u), glm::dot(between, p.half_v),
                             glm::dot(between, q.half_u), glm::dot(between, q.half_v)};
    const double near[4] = {distance - p.length_v - q.radius, distance - p.length_u - q.radius,
                            distance - q.length_v - p.radius, distance - q.length_u - p.radius};
    const double tilt[4] = {p_tilt, p_tilt, q_tilt, q_tilt};
    const double spread = p.radius + q.radius, reach = distance + spread;
    for (int k = 0; k < 4; ++k)
      too_near_ |= !(near[k] > 1.25 * half[k]);
    for (int k = 0; k < 4; ++k) {
      const double t = half[k] * near[k] / (near[k] * near[k] - 0.31 * half[k] * half[k]);
      square_[k] = t * t;
      tilt_[k] = tilt[k] * t;
      // 1 / sin^2 of the smallest angle between the line and one to the other polygon.
      const double across = square * half[k] * half[k] - along[k] * along[k];
      const double offset = std::sqrt(across > 0 ? across : 0) - spread * half[k];
      const double most = reach * half[k], least = offset > 1e-100 * most ? offset : 1e-100 * most;
      steepness_[k] = most * most / (least * least);
    }
  }

  Orders choose(double limit) const {
    Orders found;
    double bound[4] = {0, 0, 0, 0}, power[4] = {square_[0], square_[1], square_[2], square_[3]},
           enough[4], order[4] = {1, 1, 1, 1};
    for (int k = 0; k < 4; ++k)
      enough[k] = limit * (1 - 0.25 * square_[k]);
    for (int n = 1; n < kMaxOrder; ++n) { // one node would hardly ever do
      const BoundTerms terms = kBoundTerms[n];
      for (int k = 0; k < 4; ++k) {
        const double along_n = terms.most_n < steepness_[k] ? terms.most_n : steepness_[k];
        const double along_n1 = terms.most_n1 < steepness_[k] ? terms.most_n1 : steepness_[k];
        const double here =
            power[k] * (terms.at_n * along_n * square_[k] + terms.at_n1 * along_n1 * tilt_[k]);
        bound[k] = bound[k] > 0 ? bound[k] : here <= enough[k] ? here : 0;
        order[k] += bound[k] > 0 ? 0.0 : 1.0;
        power[k] *= square_[k];
      }
    }
    for (int k = 0; k < 4; ++k) {
      found.order[k] = order[k] + 1;
      found.bound += order[k] < kMaxOrder ? bound[k] / (1 - 0.25 * square_[k]) : kAnySteepness;
    }
    if (too_near_)
      found.bound = kAnySteepness;
    return found;
  }

private:
  bool too_near_ = false;
  double square_[4], tilt_[4], steepness_[4];
};

/// The nodes of a tensor rule in one row, an even number: the last may have no weight.
struct TensorNodes {
  int count = 0;
  double u[kMaxPoints] = {}, v[kMaxPoints] = {}, weight[kMaxPoints] = {};

  constexpr TensorNodes() = default;
  constexpr TensorNodes(int order_u, int order_v) {
    const GaussNode *us = gauss_legendre(order_u), *vs = gauss_legendre(order_v);
    for (int i = 0; i < order_u; ++i)
      for (int j = 0; j < order_v; ++j) {
        u[count] = us[i].x;
        v[count] = vs[j].x;
        weight[count++] = us[i].weight * vs[j].weight;
      }
    count += count & 1;
  }
};

struct TensorTable {
  TensorNodes nodes[kMaxOrder][kMaxOrder];

  constexpr TensorTable() {
    for (int i = 0; i < kMaxOrder; ++i)
      for (int j = 0; j < kMaxOrder; ++j)
        nodes[i][j] = TensorNodes(i + 1, j + 1);
  }
};
constexpr TensorTable kTensors;

/// The points of a rule on a parallelogram by coordinate, and their weights times heights.
struct Points {
  int count;
  double x[kMaxPoints], y[kMaxPoints], z[kMaxPoints], weight[kMaxPoints];

  Points(const PreparedArea& area, const Height& height, const Vec3& shift,
         const TensorNodes& nodes)
      : count(nodes.count) {
    const Vec3 s = shift, e = area.half_u, f = area.half_v;
    for (int k = 0; k < count; k += 2)
      for (int lane = k; lane < k + 2; ++lane) {
        const double u = nodes.u[lane], v = nodes.v[lane];
        x[lane] = (s.x + e.x * u) + f.x * v;
        y[lane] = (s.y + e.y * u) + f.y * v;
        z[lane] = (s.z + e.z * u) + f.z * v;
        weight[lane] = nodes.weight[lane] * ((height.middle + height.u * u) + height.v * v);
      }
  }
};

/// The sum over both rules of weight * weight / r^4.
double mean_kernel(const Points& p, const Points& q) {
  double received[kMaxPoints];
  const int count = p.count;
  for (int i = 0; i < count; ++i)
    received[i] = 0;
  for (int j = 0; j < q.count; j += 2) {
    const double x0 = q.x[j], y0 = q.y[j], z0 = q.z[j], w0 = q.weight[j];
    const double x1 = q.x[j + 1], y1 = q.y[j + 1], z1 = q.z[j + 1], w1 = q.weight[j + 1];
    for (int k = 0; k < count; k += 2)
      for (int i = k; i < k + 2; ++i) {
        const double dx0 = p.x[i] - x0, dy0 = p.y[i] - y0, dz0 = p.z[i] - z0;
        const double dx1 = p.x[i] - x1, dy1 = p.y[i] - y1, dz1 = p.z[i] - z1;
        const double square0 = dx0 * dx0 + dy0 * dy0 + dz0 * dz0;
        const double square1 = dx1 * dx1 + dy1 * dy1 + dz1 * dz1;
        const double r0 = square0 * square0, r1 = square1 * square1;
        // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign): set above, count is even
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
  const Orders orders =
      OrderChoice(p, q, between, square, distance, p_tilt, q_tilt).choose(0.25 * relative_error);
  if (!(orders.bound <= relative_error))
    return false;
  const int p_u = static_cast<int>(orders.order[0]), p_v = static_cast<int>(orders.order[1]);
  const int q_u = static_cast<int>(orders.order[2]), q_v = static_cast<int>(orders.order[3]);
  if (p_u * p_v * q_u * q_v > kMaxEvaluations)
    return false;
  const Points p_points(p, p_height, Vec3(0, 0, 0), kTensors.nodes[p_u - 1][p_v - 1]);
  const Points q_points(q, q_height, between, kTensors.nodes[q_u - 1][q_v - 1]);
  const double mean = mean_kernel(p_points, q_points) * (1 / kPi);
  const double value = mean > 0 ? p.area * q.area * mean : 0;
  *result = {value, value * (orders.bound + 0x1p-48)};
  return true;
}

} // namespace hemicube::radiosity
