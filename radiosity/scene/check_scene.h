#pragma once

#include "radiosity/scene/scene.h"

namespace hemicube::radiosity {

/// Whether a scene that was filled by hand is as Scene says: arrays of matching sizes, indices in
/// range, numbers finite and in range, three corners or more a face. Cameras and limits of edges
/// are not looked at: only readers make them.
/// @return kBadScene: says which
Status check_scene(const Scene& scene) noexcept;

} // namespace hemicube::radiosity
