#pragma once

#include "radiosity/output/file_set.h"
#include "radiosity/output/picture_values.h"
#include "radiosity/output/report_json.h"

#include <string>

namespace hemicube::radiosity {

/// What solution_files writes.
struct SolutionParts {
  const PatchSet& patches;
  const Solution& solution;
  ReportParts report;  ///< write_seconds is measured while writing
  Camera camera;       ///< the scene's, or fit_camera()
  double exposure = 0; ///< of the display picture; 0 = choose_exposure()
  const raster::Kernels& kernels;
  const ElementTree* tree = nullptr; ///< of adaptive meshing; null without
};

/// Chooses the folder of a solution and proves that its files can be written there, before the
/// work.
/// @return kIo
Status begin_solution(FileSet* files, const std::string& folder);

/// Writes patches.csv, groups.csv, solution.ply, solution_float.ply, solution.glb, view.exr,
/// view.png and report.json, and with a tree elements.csv, and commits them.
/// @param report         receives the text of report.json
/// @param note           receives which files are missing and why: if the image plug-in cannot be
///                       loaded, pictures; if it cannot hold the mesh, solution.glb. A solution is
///                       not thrown away for that
/// @return kIo, kInvalidArgument (camera), kOutOfMemory; no file has then changed
Status write_solution(FileSet* files, const SolutionParts& parts, std::string* report,
                      std::string* note);

} // namespace hemicube::radiosity
