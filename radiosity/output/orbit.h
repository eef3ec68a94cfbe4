#pragma once

#include "radiosity/scene/scene.h"

namespace hemicube::radiosity {

/// The camera of one frame of a film that goes once around: the first frame's, turned about the
/// axis through its target along `up`, counter-clockwise seen from above, by frame / frames of a
/// full turn. Frame 0 is the camera as it is.
/// @param first   one that camera_view() takes
/// @param frames  > 0
/// Deterministic: + - * / sqrt only.
Camera orbit_camera(const Camera& first, std::uint32_t frame, std::uint32_t frames) noexcept;

} // namespace hemicube::radiosity
