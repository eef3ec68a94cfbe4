#include "radiosity/form_factor/lambert.h"

#include "radiosity/elementary.h"
#include "radiosity/form_factor/gauss_legendre.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Distance over radius from which the contour sum has lost enough digits to prefer quadrature, and
/// where fewer nodes reach 1e-13.
constexpr double kFar = 50, kFarther = 400, kFarthest = 8000;
/// Heights over the polygon's plane below this share of the distance are rounding.
constexpr double kInPlane = 0x1p-50;

/// Lambert's sum, edge by edge: the angle each subtends at the origin, times the component along
/// the receiver's normal of the unit vector across it. Edges are gathered so that the angles
/// vectorise.
class ContourSum {
public:
  explicit ContourSum(const Vec3& normal) : normal_(normal) {}

  void add(const Vec3& a, const Vec3& b) {
    const Vec3 across = glm::cross(b, a);
    square_[count_] = glm::dot(across, across);
    cosine_[count_] = glm::dot(a, b);
    along_[count_] = glm::dot(normal_, across);
    if (++count_ == kBatch)
      flush();
  }

  double value() {
    if (count_ % 2 != 0) { // whole lanes
      square_[count_] = cosine_[count_] = along_[count_] = 0;
      ++count_;
    }
    flush();
    return sum_ / (2 * kPi);
  }

private:
  static constexpr int kBatch = 8;

  void flush() {
    double term[kBatch];
    for (int k = 0; k < count_; ++k) {
      const double length = std::sqrt(square_[k]);
      term[k] = along_[k] * angle_above(length, cosine_[k]) / (length > 0 ? length : 1.0);
    }
    for (int k = 0; k < count_; ++k)
      sum_ += term[k];
    count_ = 0;
  }

  Vec3 normal_;
  double sum_ = 0;
  int count_ = 0;
  double square_[kBatch], cosine_[kBatch], along_[kBatch];
};

/// Where the edge from a (side sa > 0) to b (side sb < 0) meets the horizon.
Vec3 horizon_crossing(const Vec3& a, double sa, const Vec3& b, double sb) {
  return a + (b - a) * (sa / (sa - sb));
}

/// Lambert's sum over the part of the polygon above the horizon. From where the polygon leaves to
/// where it comes back the horizon closes the contour: once, or, where the polygon lies in the
/// horizon and rounding makes it leave, as often as it does.
double contour_sum(const Vec3& eye, const Vec3& normal, std::span<const Vec3> corners) {
  ContourSum sum(normal);
  bool began_below = false, left = false, entered = false;
  Vec3 first_enters(0, 0, 0), leaves(0, 0, 0), enters(0, 0, 0);
  Vec3 a = corners.back() - eye;
  double sa = glm::dot(normal, a);
  for (const Vec3& corner : corners) {
    const Vec3 b = corner - eye;
    const double sb = glm::dot(normal, b);
    if (sa >= 0 && sb >= 0) {
      sum.add(a, b);
    } else if (sa >= 0) {
      if (left && entered)
        sum.add(leaves, enters);
      leaves = horizon_crossing(a, sa, b, sb);
      left = true;
      sum.add(a, leaves);
    } else if (sb >= 0) {
      enters = horizon_crossing(b, sb, a, sa);
      sum.add(enters, b);
      entered = left;
      if (!left) {
        began_below = true;
        first_enters = enters;
      }
    }
    a = b;
    sa = sb;
  }
  if (left && (began_below || entered))
    sum.add(leaves, began_below ? first_enters : enters);
  return sum.value();
}

/// The kernel's integral over a quadrilateral far away, corners relative to the eye. A triangle
/// repeats a corner.
double far_quadrilateral(const Vec3& normal, const Vec3 (&c)[4], int order) {
  // The bilinear map of [-1,1]^2: middle + u e + v f + u v g; its Jacobian times the distance from
  // the plane is height + u height_u + v height_v.
  const Vec3 middle = ((c[0] + c[1]) + (c[2] + c[3])) * 0.25;
  const Vec3 e = ((c[1] - c[0]) + (c[2] - c[3])) * 0.25, f = ((c[3] - c[0]) + (c[2] - c[1])) * 0.25;
  const Vec3 g = ((c[0] - c[1]) + (c[2] - c[3])) * 0.25;
  const double height = -glm::dot(middle, glm::cross(e, f));
  const double height_u = -glm::dot(middle, glm::cross(e, g));
  const double height_v = -glm::dot(middle, glm::cross(g, f));
  const GaussNode* nodes = gauss_legendre(order);
  double sum = 0;
  for (int i = 0; i < order; ++i) {
    const double u = nodes[i].x;
    const Vec3 start = middle + e * u, step = f + g * u;
    double row = 0;
    for (int k = 0; k < order; ++k) {
      const double v = nodes[k].x;
      const Vec3 r = start + step * v;
      const double square = glm::dot(r, r);
      row += nodes[k].weight * (height + u * height_u + v * height_v) * glm::dot(normal, r) /
             (square * square);
    }
    sum += nodes[i].weight * row;
  }
  return sum * (4 / kPi);
}

/// The part of a triangle or quadrilateral above the horizon.
double far_clipped(const Vec3& normal, const Vec3 (&c)[4], int order) {
  double side[4];
  bool all = true, any = false;
  for (int k = 0; k < 4; ++k) {
    side[k] = glm::dot(normal, c[k]);
    all &= side[k] >= 0;
    any |= side[k] > 0;
  }
  if (all)
    return far_quadrilateral(normal, c, order);
  if (!any)
    return 0;
  Vec3 kept[6];
  int count = 0;
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) & 3;
    if (side[k] >= 0)
      kept[count++] = c[k];
    if ((side[k] > 0 && side[next] < 0) || (side[k] < 0 && side[next] > 0))
      kept[count++] = side[k] > 0 ? horizon_crossing(c[k], side[k], c[next], side[next])
                                  : horizon_crossing(c[next], side[next], c[k], side[k]);
  }
  double sum = 0;
  for (int k = 2; k < count; k += 2)
    sum += far_quadrilateral(
        normal, {kept[0], kept[k - 1], kept[k], kept[k + 1 < count ? k + 1 : k]}, order);
  return sum;
}

double far_sum(const Vec3& eye, const Vec3& normal, std::span<const Vec3> corners, int order) {
  const std::size_t count = corners.size();
  const Vec3 first = corners[0] - eye;
  double sum = 0;
  for (std::size_t k = 2; k < count; k += 2)
    sum += far_clipped(
        normal,
        {first, corners[k - 1] - eye, corners[k] - eye, corners[k + 1 < count ? k + 1 : k] - eye},
        order);
  return sum;
}

/// Whether the eye is in the polygon's plane, up to rounding.
bool in_plane(const Vec3& eye, std::span<const Vec3> corners) {
  const Vec3 a = corners[0] - eye;
  Vec3 area(0, 0, 0);
  double scale = glm::dot(a, a);
  for (std::size_t k = 2; k < corners.size(); ++k) {
    area += glm::cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
    const Vec3 b = corners[k] - eye;
    const double square = glm::dot(b, b);
    scale = square > scale ? square : scale;
  }
  return std::fabs(glm::dot(area, a)) <= kInPlane * std::sqrt(scale * glm::dot(area, area));
}

} // namespace

double point_to_polygon(const Vec3& eye, const Vec3& normal,
                        std::span<const Vec3> corners) noexcept {
  const std::size_t count = corners.size();
  if (count < 3)
    return 0;
  const Vec3 offset = corners[0] - eye;
  const double distance = glm::dot(offset, offset);
  double radius = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const Vec3 edge = corners[k] - corners[0];
    const double square = glm::dot(edge, edge);
    radius = square > radius ? square : radius;
  }
  // The longest chord from a corner is up to twice the radius.
  if (distance > 0.25 * kFar * kFar * radius)
    return far_sum(eye, normal, corners,
                   distance > 0.25 * kFarthest * kFarthest * radius ? 2
                   : distance > 0.25 * kFarther * kFarther * radius ? 3
                                                                    : 4);
  const double sum = contour_sum(eye, normal, corners);
  const double magnitude = std::fabs(sum);
  // Small or negative: perhaps only because the eye is in the plane, where the sign is rounding.
  if ((sum < 0 || magnitude > 1) && in_plane(eye, corners))
    return magnitude < 1 && sum > 0 ? sum : sum > 0 ? 1.0 : 0.0;
  return magnitude <= 1 ? sum : sum > 0 ? 1.0 : -1.0;
}

} // namespace hemicube::radiosity
