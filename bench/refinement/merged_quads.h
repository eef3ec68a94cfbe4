#pragma once

#include "radiosity/scene/scene.h"

namespace hemicube::bench {

/// A scene with a coarser mesh of the same surfaces: where four quads of one material meet at a
/// vertex and make up a larger quad, they become one. @param rounds  how often
radiosity::Scene merge_quads(const radiosity::Scene& scene, int rounds);

} // namespace hemicube::bench
