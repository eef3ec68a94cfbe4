#include "radiosity/output/balanced_weights.h"

#include <cstddef>

namespace hemicube::radiosity {
namespace {

/// Multiplies every weight by 1 + tilt * point, with as much of the tilt as all of them bear.
void tilt_weights(std::span<const Vec3> points, const Vec3& tilt,
                  std::span<double> weights) noexcept {
  constexpr double kLeastFactor = 1e-3;
  double lowest = 0;
  for (const Vec3& point : points) {
    const double change = glm::dot(tilt, point);
    lowest = change < lowest ? change : lowest;
  }
  const double share = lowest < kLeastFactor - 1 ? (kLeastFactor - 1) / lowest : 1;
  for (std::size_t k = 0; k < points.size(); ++k)
    weights[k] *= 1 + share * glm::dot(tilt, points[k]);
}

} // namespace

void balance_about_point(std::span<const Vec3> points, const Vec3& normal,
                         std::span<double> weights) noexcept {
  const Vec3 first = points[0] - glm::dot(normal, points[0]) * normal;
  const double length = glm::length(first);
  if (!(length > 0))
    return;
  const Vec3 along = first / length;
  const Vec3 across = glm::cross(normal, along);
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0; // moments
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double px = glm::dot(along, points[k]), py = glm::dot(across, points[k]);
    x += weights[k] * px;
    y += weights[k] * py;
    xx += weights[k] * px * px;
    xy += weights[k] * px * py;
    yy += weights[k] * py * py;
  }
  // Points on one line say nothing of the way across it; so little is added that it matters to them
  // alone.
  const double little = 1e-12 * (xx + yy);
  const double determinant = (xx + little) * (yy + little) - xy * xy;
  if (!(determinant > 0))
    return;
  const double tilt_along = (y * xy - x * (yy + little)) / determinant;
  const double tilt_across = (x * xy - y * (xx + little)) / determinant;
  tilt_weights(points, tilt_along * along + tilt_across * across, weights);
}

void balance_about_line(std::span<const Vec3> points, const Vec3& normal, const Vec3& direction,
                        std::span<double> weights) noexcept {
  const Vec3 sideways = glm::cross(normal, direction);
  double moment = 0, square = 0, least = 0, most = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double offset = glm::dot(sideways, points[k]);
    moment += weights[k] * offset;
    square += weights[k] * offset * offset;
    least = offset < least ? offset : least;
    most = offset > most ? offset : most;
  }
  if (least < 0 && most > 0)
    tilt_weights(points, -moment / square * sideways, weights);
}

} // namespace hemicube::radiosity
