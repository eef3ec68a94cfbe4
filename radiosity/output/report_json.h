#pragma once

#include "radiosity/adaptive.h"
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/certificate.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/scene.h"

#include <map>
#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// What report.json is made of.
struct ReportParts {
  const Scene& scene;
  const Options& options;
  const Certificate& certificate;
  const MeshReport& mesh;
  const std::map<std::string, std::uint64_t>& skipped; ///< statements read over, by reason
  RunReport run;
  std::string_view version;
  std::string scene_path = {}; ///< absolute; empty = not told
  double max_edge = 0;         ///< metres, from the command line; 0 = as the scene says
  const DiscontinuityReport* discontinuity = nullptr; ///< of discontinuity meshing; null without
  const RefinementReport* refinement = nullptr;       ///< of adaptive meshing; null without
};

/// report.json: an object `result`, bit-equal for every thread count, instruction set and compiler,
/// and an object `run` about this very run. What was not computed is absent, never zero; so are
/// numbers that are not finite. Hashes are 16 hexadecimal digits, the power of each band an element
/// of an array.
std::string report_json(const ReportParts& parts);

} // namespace hemicube::radiosity
