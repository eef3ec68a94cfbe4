#pragma once

#include "radiosity/scene/scene.h"

#include <cstdio>

namespace hemicube::radiosity::test {

/// Everything of a scene that light depends on, as plain bytes, lowest first: for programs that
/// have no readers.
/// @return false if not all could be written
bool write_packed_scene(const Scene& scene, std::FILE* file);

/// @param scene  replaced
/// @return false if the bytes end too early, or there is no memory for what they announce
bool read_packed_scene(std::FILE* file, Scene* scene);

} // namespace hemicube::radiosity::test
