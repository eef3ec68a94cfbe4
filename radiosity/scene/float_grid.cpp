#include "radiosity/scene/float_grid.h"

#include "radiosity/scene/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemicube::radiosity {

double float_grid_step(std::span<const Vec3> vertices) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low(kInfinity), high(-kInfinity);
  for (const Vec3& vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis)
      // Beyond the largest float a cast would be undefined.
      if (!(std::fabs(vertex[axis]) <= static_cast<double>(std::numeric_limits<float>::max())) ||
          static_cast<double>(static_cast<float>(vertex[axis])) != vertex[axis])
        return 0;
    low = glm::min(low, vertex);
    high = glm::max(high, vertex);
  }
  const double extent = vertices.empty() ? 0 : largest_component(high - low);
  if (extent == 0)
    return 0;
  const auto largest =
      static_cast<float>(std::max(largest_component(low), largest_component(high)));
  return static_cast<double>(largest - std::nextafter(largest, 0.0f)) / extent;
}

} // namespace hemicube::radiosity
