#pragma once

#include "radiosity/discontinuity/discontinuity_line.h"
#include "radiosity/scene/scene.h"

#include <vector>

namespace hemicube::radiosity {

/// How far discontinuity meshing goes.
struct DiscontinuityLimits {
  std::uint64_t max_emitters = 4; ///< whose shadows are followed, the brightest first
  double snap = 0; ///< metres: closer lines are one, as are corners that lie closer to a line; 0 =
                   ///< chosen: a 32nd of the root of the median area of the patches
  std::uint64_t max_elements = 0; ///< no more are made, backs not counted; 0 = chosen: 20000, or 4
                                  ///< times the patches if that is more
  std::uint64_t max_wedges = 50000; ///< no more are followed, which takes some seconds
};

struct DiscontinuityReport {
  DiscontinuityLimits limits; ///< as they were chosen
  std::uint64_t emitters = 0, emitters_treated = 0;
  double power_treated = 0; ///< of the power of all emitters, 0..1
  std::uint64_t wedges = 0, wedges_skipped = 0;
  std::uint64_t contact_lines = 0, shadow_lines = 0;
  std::uint64_t lines_skipped = 0; ///< there were enough elements
  std::uint64_t patches = 0, elements = 0;
};

/// Cuts patches along the lines across which light is not smooth (Heckbert 1992; Lischinski,
/// Tampieri and Greenberg 1992): where something touches a surface, and where corners of emitters
/// vanish behind edges of occluders or edges of emitters behind corners.
/// @param patches   fronts only, measured
/// @param elements  receives fronts, convex, with vertices shared as before; face and parent as
///                  those of the patch they are of; edge_light is set
/// @param lines     receives what they were cut along: contacts first, then the borders of shadows,
///                  the strongest first
/// @return kInvalidArgument for limits that make no sense; as measure_patches
/// Deterministic: + - * / sqrt only.
Status cut_discontinuities(const Scene& scene, const PatchSet& patches,
                           const DiscontinuityLimits& limits, PatchSet* elements,
                           std::vector<DiscontinuityLine>* lines, DiscontinuityReport* report);

} // namespace hemicube::radiosity
