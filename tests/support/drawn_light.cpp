#include "tests/support/drawn_light.h"

#include "radiosity/mesh/straight_corners.h"
#include "radiosity/output/interpolation.h"
#include "radiosity/output/vertex_radiosity.h"
#include "tests/support/scenes_shared.h"

#include <stdexcept>

namespace hemicube::test {
namespace {

constexpr double kSameNormal = 0.999, kBeside = 1e-3; ///< the latter of the element's size

} // namespace

DrawnLight::DrawnLight(const radiosity::PatchSet& elements, std::span<const double> radiosity,
                       std::uint32_t bands)
    : elements_(elements), bands_(bands) {
  require(radiosity::vertex_radiosities(elements, radiosity, bands, &corner_radiosity_));
  require(radiosity::find_straight_corners(elements, &is_straight_));
  for (std::uint32_t e = 0; e < elements.patch_count(); ++e) {
    Vec3 low = elements.vertices[elements.corners_of(e)[0]], high = low;
    for (const std::uint32_t corner : elements.corners_of(e)) {
      low = glm::min(low, elements.vertices[corner]);
      high = glm::max(high, elements.vertices[corner]);
    }
    const Vec3 margin(kBeside * glm::length(high - low));
    low_.push_back(low - margin);
    high_.push_back(high + margin);
  }
}

bool DrawnLight::contains(std::uint32_t e, const Vec3& point, const Vec3& normal) const {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < low_[e][axis] || point[axis] > high_[e][axis])
      return false;
  if (glm::dot(elements_.normal[e], normal) < kSameNormal)
    return false;
  const auto corners = elements_.corners_of(e);
  const double margin = 1e-9 * glm::length(high_[e] - low_[e]);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3& a = elements_.vertices[corners[k]];
    const Vec3 edge = elements_.vertices[corners[(k + 1) % corners.size()]] - a;
    if (glm::dot(glm::cross(elements_.normal[e], edge), point - a) < -margin * glm::length(edge))
      return false;
  }
  return true;
}

void DrawnLight::at(const Vec3& point, const Vec3& normal, std::span<double> values) {
  const std::uint32_t count = elements_.patch_count();
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t e = (last_ + k) % count;
    if (!contains(e, point, normal))
      continue;
    last_ = e;
    const auto corners = elements_.corners_of(e);
    std::vector<double> weights(corners.size());
    radiosity::interpolation_weights(elements_, is_straight_.span(), e, point, weights.data());
    for (std::uint32_t b = 0; b < bands_; ++b)
      values[b] = 0;
    for (std::size_t k2 = 0; k2 < corners.size(); ++k2)
      for (std::uint32_t b = 0; b < bands_; ++b)
        values[b] +=
            weights[k2] *
            static_cast<double>(corner_radiosity_[(elements_.corner_offsets[e] + k2) * bands_ + b]);
    return;
  }
  throw std::runtime_error("no element is there");
}

} // namespace hemicube::test
