#include "radiosity/output/orbit.h"

#include "radiosity/elementary.h"

namespace hemicube::radiosity {

Camera orbit_camera(const Camera& first, std::uint32_t frame, std::uint32_t frames) noexcept {
  Camera camera = first;
  if (frame == 0)
    return camera;
  const Vec3 axis = unit(first.up);
  const Vec3 arm = first.position - first.target;
  const Vec3 along = glm::dot(arm, axis) * axis, across = arm - along;
  const Turn turn = turn_of(frame, frames);
  camera.position =
      first.target + along + turn.cosine * across + turn.sine * glm::cross(axis, across);
  return camera;
}

} // namespace hemicube::radiosity
