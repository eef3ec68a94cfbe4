#pragma once

#include "radiosity/cli/session.h"

#include <optional>
#include <string>

namespace hemicube::radiosity::cli {

/// What a folder written by `solve` says of where it comes from: its report.json.
struct SolutionOrigin {
  std::string report_path;
  std::string scene; ///< empty = not told
  MeshOptions mesh;
  std::optional<std::uint64_t> patches;
  bool is_adaptive = false; ///< the patches are elements
  std::string scene_hash;   ///< 16 hexadecimal digits; empty = not told
};

/// @return kBadScene if there is no report, or none that can be read
Status read_origin(const std::string& folder, SolutionOrigin* origin);

/// Fills --scene and how it is meshed from it where they were not given.
/// @return kBadScene if neither names a scene
Status follow_origin(const SolutionOrigin& origin, CommandLine* line);

/// Refuses a solution of another scene, or of another mesh of it.
/// @return kBadScene, saying what to do
Status check_origin(const SolutionOrigin& origin, const Session& session);

/// Cuts the patches of the session as those of the folder session.line.input were, if they were.
/// @return as Session::refine_as
Status follow_refinement(const SolutionOrigin& origin, Session* session);

/// The light of the folder session.line.input, for the scene of the session.
/// @return as read_patch_table
Status read_solution(const Session& session, Solution* solution);

} // namespace hemicube::radiosity::cli
