#pragma once

#include "radiosity/discontinuity/discontinuity_line.h"
#include "radiosity/discontinuity/occluder_edges.h"
#include "radiosity/scene/scene.h"

#include <vector>

namespace hemicube::radiosity {

/// A flat convex part of what shines.
struct EmitterFace {
  std::vector<Vec3> corners;
  Vec3 normal{0, 0, 0};
  bool two_sided = false;
  double radiosity = 0; ///< W/m^2, all bands together
  double power = 0;     ///< W
};

/// The emitters of a scene, the brightest first; patches side by side that shine alike are one.
Status find_emitters(const Scene& scene, const PatchSet& patches,
                     std::vector<EmitterFace>* emitters);

struct ShadowLineReport {
  std::uint64_t wedges = 0;         ///< that were followed
  std::uint64_t wedges_skipped = 0; ///< beyond the limit
};

/// The borders of the parts of its shadows that an emitter casts (D1 and D2): where its corners
/// appear or vanish behind edges, its edges behind corners, and all of it where its plane is
/// crossed.
/// @param most_wedges  followed in all, report->wedges included
/// @param lines        are appended; light = kBends
void find_shadow_lines(const OccluderEdges& edges, const EmitterFace& emitter,
                       std::uint64_t most_wedges, std::vector<DiscontinuityLine>* lines,
                       ShadowLineReport* report);

} // namespace hemicube::radiosity
