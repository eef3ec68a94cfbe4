#include "radiosity/form_factor/edge_integrals.h"

#include "radiosity/elementary.h"
#include "radiosity/form_factor/gauss_legendre.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Directions closer than this to parallel or perpendicular are.
constexpr double kAligned = 0x1p-49;
/// Parallel edges this many times their lengths apart lose digits in closed form.
constexpr double kMaxClosedFormRatio = 64;
/// Halvings of an edge towards where another touches it.
constexpr int kMaxDepth = 48;
/// Squared distances below this are 0: around 1, what they multiply does not count.
constexpr double kNothing = 0x1p-900;
constexpr int kOrders[] = {2, 3, 4, 5, 6, 7, 8, 10, 12, 16};

struct Edge {
  Vec3 start{0, 0, 0}, direction{0, 0, 0};
  double length = 0;

  Vec3 at(double s) const { return start + direction * s; }
};

int edges_of(const ConvexPolygon& polygon, Edge* edges) {
  int count = 0;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3 &a = polygon.corners[k], &b = polygon.corners[k + 1 == polygon.count ? 0 : k + 1];
    const Vec3 along = b - a;
    const double length = std::sqrt(glm::dot(along, along));
    if (length > 0)
      edges[count++] = {a, along / length, length};
  }
  return count;
}

/// The integral of ln r over two parallel edges, plus the product of their lengths.
double parallel_integral(const Edge& p, const Edge& q, double cosine) {
  const Vec3 offset = q.start - p.start;
  const Vec3 across = glm::cross(offset, p.direction);
  const double h_square = glm::dot(across, across), h = std::sqrt(h_square);
  // Where q begins and ends along p.
  const double start = glm::dot(offset, p.direction);
  const double end = cosine > 0 ? start + q.length : start - q.length;
  const double low = start < end ? start : end, high = start < end ? end : start;
  // The second antiderivative of ln sqrt(v^2 + h^2), less v^2 / 2: constants in the integrand drop
  // out of the sum over a closed contour.
  const double v[4] = {p.length - low, -low, p.length - high, -high};
  double primitive[4];
  for (int k = 0; k < 4; ++k) {
    const double v_square = v[k] * v[k], square = v_square + h_square;
    const double magnitude = v[k] < 0 ? -v[k] : v[k];
    primitive[k] =
        0.25 * ((v_square - h_square) * logarithm_of_normal(square > kNothing ? square : 1.0) -
                v_square) +
        h * magnitude * angle_above(magnitude, h);
  }
  return (primitive[0] - primitive[1]) - (primitive[2] - primitive[3]);
}

/// The mean over a rule's points of the integral of ln r from the point to an edge, plus the edge's
/// length. @param first, last  ends of the interval the points are on
double mean_inner_integral(const Vec3& first, const Vec3& last, int order, const Edge& q) {
  const GaussNode* nodes = gauss_legendre(order);
  const Vec3 arm = q.start - (first + last) * 0.5, half = (last - first) * 0.5;
  const Vec3 f = q.direction;
  double value[16];
  for (int k = 0; k < order; ++k) {
    const double x = nodes[k].x;
    const double ax = arm.x - half.x * x, ay = arm.y - half.y * x, az = arm.z - half.z * x;
    const double u0 = ax * f.x + ay * f.y + az * f.z, u1 = u0 + q.length;
    const double cx = ay * f.z - az * f.y, cy = az * f.x - ax * f.z, cz = ax * f.y - ay * f.x;
    const double square = cx * cx + cy * cy + cz * cz, h = std::sqrt(square);
    const double r0 = u0 * u0 + square, r1 = u1 * u1 + square;
    value[k] = 0.5 * (u1 * logarithm_of_normal(r1 > kNothing ? r1 : 1.0) -
                      u0 * logarithm_of_normal(r0 > kNothing ? r0 : 1.0)) +
               h * angle_above(h * q.length, square + u0 * u1);
  }
  double mean = 0;
  for (int k = 0; k < order; ++k)
    mean += nodes[k].weight * value[k];
  return mean;
}

double distance(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return std::sqrt(glm::dot(d, d));
}

/// Where the inner integral, as a function of the place on the outer edge, is not analytic: at the
/// distances of the inner edge's ends, and where the two lines are nearest if that is on the edge.
class Singularities {
public:
  Singularities(const Edge& p, const Edge& q, double cosine)
      : start_(q.start), end_(q.at(q.length)) {
    const Vec3 normal = glm::cross(p.direction, q.direction);
    const double square = glm::dot(normal, normal);
    if (square < kAligned * kAligned)
      return;
    const Vec3 offset = q.start - p.start;
    const double along_p = glm::dot(offset, p.direction), along_q = glm::dot(offset, q.direction);
    const double t = (along_p * cosine - along_q) / square;
    if (t < -0.125 * q.length || t > 1.125 * q.length)
      return;
    sine_ = std::sqrt(square);
    foot_ = (along_p - along_q * cosine) / square;
    gap_ = std::fabs(glm::dot(offset, normal)) / square;
  }

  /// The sum of the half axes, in half intervals, of the ellipse around lo..hi through the nearer
  /// of the edge's ends, and through where the lines are nearest.
  double ends_rho(const Vec3& lo, const Vec3& hi, double length) const {
    const double first = (distance(start_, lo) + distance(start_, hi)) / length;
    const double second = (distance(end_, lo) + distance(end_, hi)) / length;
    return rho(first < second ? first : second);
  }
  double foot_rho(double lo, double hi) const {
    const double a = lo - foot_, b = hi - foot_, square = gap_ * gap_;
    return rho((std::sqrt(a * a + square) + std::sqrt(b * b + square)) / (hi - lo));
  }
  double sine() const { return sine_; } ///< 0 if the lines' nearest point does not count

private:
  static double rho(double sum) {
    const double beyond = sum * sum - 1;
    return beyond > 0 ? sum + std::sqrt(beyond) : 1;
  }

  Vec3 start_, end_;
  double sine_ = 0, foot_ = 0, gap_ = 0;
};

double inverse_power(double rho, int exponent) {
  const double inverse = 1 / rho;
  double power = 1;
  for (int k = 0; k < exponent; ++k)
    power *= inverse;
  return power;
}

/// The integral over p of the inner integral along q. Intervals are halved until a rule's bound is
/// below the tolerance, so that they shrink geometrically towards where the edges touch.
double graded_integral(const Edge& p, const Edge& q, double cosine, double tolerance,
                       double* error) {
  const Singularities singular(p, q, cosine);
  struct Interval {
    double lo, hi;
    int depth;
  } stack[kMaxDepth + 2];
  int top = 0;
  stack[top++] = {0, p.length, 0};
  double sum = 0;
  while (top > 0) {
    const Interval here = stack[--top];
    const double length = here.hi - here.lo;
    const double ends = singular.ends_rho(p.at(here.lo), p.at(here.hi), length);
    const double foot = singular.sine() > 0 ? singular.foot_rho(here.lo, here.hi) : 0;
    int order = 0;
    double bound = 0;
    for (const int candidate : kOrders) {
      bound = inverse_power(ends, 2 * candidate - 1);
      if (singular.sine() > 0)
        bound += singular.sine() * inverse_power(foot, 2 * candidate - 1);
      bound *= 0.5 * length * length / (candidate * candidate);
      order = candidate;
      if (bound <= tolerance)
        break;
    }
    if (bound > tolerance && here.depth < kMaxDepth) {
      const double middle = 0.5 * (here.lo + here.hi);
      stack[top++] = {middle, here.hi, here.depth + 1};
      stack[top++] = {here.lo, middle, here.depth + 1};
      continue;
    }
    sum += length * mean_inner_integral(p.at(here.lo), p.at(here.hi), order, q);
    *error += 2 * bound; // both ends may be as near as the nearer
  }
  return sum;
}

} // namespace

ContourSum contour_exchange(const ConvexPolygon& p, const ConvexPolygon& q,
                            double tolerance) noexcept {
  Edge p_edges[ConvexPolygon::kMaxCorners], q_edges[ConvexPolygon::kMaxCorners];
  const int p_count = edges_of(p, p_edges), q_count = edges_of(q, q_edges);
  ContourSum total;
  // Some ten intervals a pair; errors of opposite sign cancel.
  const double share = tolerance / (p_count + q_count);
  for (int i = 0; i < p_count; ++i)
    for (int j = 0; j < q_count; ++j) {
      const Edge &a = p_edges[i], &b = q_edges[j];
      const double cosine = glm::dot(a.direction, b.direction), product = a.length * b.length;
      if (std::fabs(cosine) < kAligned) {
        total.magnitude += product;
        continue;
      }
      double integral = 0, error = 0;
      bool closed = false;
      const Vec3 across = glm::cross(a.direction, b.direction);
      if (glm::dot(across, across) < kAligned * kAligned) {
        const double longest = a.length > b.length ? a.length : b.length;
        const double reach = longest + distance(a.at(0.5 * a.length), b.at(0.5 * b.length));
        closed = reach * reach <= kMaxClosedFormRatio * product;
      }
      if (closed)
        integral = parallel_integral(a, b, cosine);
      else if (a.length <= b.length)
        integral = graded_integral(a, b, cosine, share, &error);
      else
        integral = graded_integral(b, a, cosine, share, &error);
      const double term = cosine * integral;
      total.value += term;
      total.error += error * std::fabs(cosine);
      total.magnitude += std::fabs(term) + product;
    }
  constexpr double kScale = 1 / (2 * kPi);
  total.value *= kScale;
  total.error *= kScale;
  total.magnitude *= kScale;
  return total;
}

} // namespace hemicube::radiosity
