#include "radiosity/scene/camera_problem.h"

#include "radiosity/scene/placement.h"

#include <cmath>

namespace hemicube::radiosity {

std::string_view camera_problem(const Camera& camera) {
  const Vec3 view = camera.target - camera.position;
  const double distance = largest_component(view);
  if (!std::isfinite(distance))
    return "position and target are too far apart";
  if (distance == 0)
    return "target must not be the position";
  if (largest_component(camera.up) == 0)
    return "up must not be 0 0 0";
  const Vec3 across =
      glm::cross(unit(view / distance), unit(camera.up / largest_component(camera.up)));
  if (!(glm::length(across) >= 2 * Camera::kMinUpSine)) // twice: the frame is computed elsewhere
    return "up must not point along the line of sight";
  return "";
}

} // namespace hemicube::radiosity
