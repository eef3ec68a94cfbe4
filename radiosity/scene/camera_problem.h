#pragma once

#include "radiosity/scene/scene.h"

#include <string_view>

namespace hemicube::radiosity {

/// Why position, target and up of a camera say no picture, as "target must not be the position"; ""
/// if they do.
std::string_view camera_problem(const Camera& camera);

} // namespace hemicube::radiosity
