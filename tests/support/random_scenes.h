#pragma once

#include "tests/support/looks.h"

#include <vector>

namespace hemicube::test {

/// Polygons and looks at them.
struct RandomScene {
  PolygonSet polygons;
  std::vector<Look> looks;
};

/// Scenes of one kind, made to catch a rasterizer that leaves out too much.
struct RandomScenes {
  const char* name;
  std::vector<RandomScene> (*make)();
  bool small = true; ///< so few polygons that each can be drawn alone
};

extern const std::vector<RandomScenes> kRandomScenes;

} // namespace hemicube::test
