#pragma once

#include "radiosity/mesh/patch_set.h"

namespace hemicube::radiosity {

/// A straight line on a surface across which light is not smooth.
struct DiscontinuityLine {
  std::uint32_t face = 0; ///< of SceneFacets
  bool on_front = false, on_back = false;
  EdgeLight light = EdgeLight::kSmooth; ///< across it
  Vec3 begin{0, 0, 0}, end{0, 0, 0};
  // Of kBends: what it is the border of.
  double strength = 0; ///< W/m^2: what the emitter sends there if nothing hides it
  Vec3 apex{0, 0, 0};  ///< that all light of the wedge comes from or passes
  Vec3 source[2] = {}; ///< where light comes from that ends at `begin` and at `end`
};

} // namespace hemicube::radiosity
