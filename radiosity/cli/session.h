#pragma once

#include "radiosity/cli/kept_files.h"
#include "radiosity/cli/load_scene.h"
#include "radiosity/cli/options.h"
#include "radiosity/cli/progress.h"
#include "radiosity/forecast.h"
#include "radiosity/output/report_json.h"
#include "radiosity/parallel/thread_pool.h"

#include <string>

namespace hemicube::radiosity::cli {

/// What all commands share: the scene, the workers, and the report on how it went.
class Session {
public:
  /// @param command_line  must outlive the session
  explicit Session(const CommandLine& command_line)
      : line(command_line), options_(command_line.options) {}

  /// Loads the scene, warns of what was skipped and repaired, and starts the workers.
  Status begin(const std::string& scene_path);

  /// Prepares the files of form factors that the command line names, and those that an interrupted
  /// run leaves beside `output`; shares out the memory there is. Call it once, before the work.
  Status begin_files(const std::string& output);

  /// @param take_snapshot  of progressive refinement; may be empty
  /// @return also what became of the files of form factors
  Status solve(Solution* solution, Certificate* certificate,
               const ProgressReport::TakeSnapshot& take_snapshot = {});
  /// @param rows  of these patches; empty = of all
  Status form_factors(std::span<const std::uint32_t> rows, FormFactorMatrix* matrix,
                      Certificate* certificate);
  Status point_form_factors(std::span<const Receiver> points, FormFactorMatrix* matrix,
                            Certificate* certificate);

  /// Cuts the patches as a table says. @param path  its name
  Status refine_as(std::string_view element_table, const std::string& path);
  /// How the patches were cut, by refine_as or solve; null if they were not.
  const ElementTree* tree() const { return is_refined_ ? &tree_ : nullptr; }

  /// Does a little of what `solve` would do.
  Status forecast(ForecastProgress* progress, Forecast* forecast);

  /// The scene's camera, or one that shows all of it, changed as the command line says.
  /// @return if it shows nothing: kBadScene for the scene's camera as it is, else kInvalidArgument
  Status choose_camera(Camera* camera) const;

  /// What report.json is made of; refers to the session and the certificate.
  ReportParts report_parts(const Certificate& certificate);

  /// The text of report.json.
  std::string report_text(const Certificate& certificate);

  /// "617 patches", or "3,010 elements of 617 patches (8 rounds, ended by min_edge)".
  std::string mesh_text(const Certificate& certificate) const;

  /// "rung hemicube at 64 (567 hemicubes/s), form factor error 0.01".
  std::string rung_text(const Certificate& certificate) const;

  Executor& workers() { return pool_; }

  const CommandLine& line;
  LoadedScene loaded;
  RunReport run;

private:
  template <typename Work> Status compute(Work work);

  Status solve_refined(ProgressReport* progress, Solution* solution, Certificate* certificate);

  std::string scene_path_;
  bool is_refined_ = false;
  PatchSet coarse_; ///< the patches that were cut
  ElementTree tree_;
  RefinementReport refinement_;
  ThreadPool pool_;
  Options options_; ///< the command line's, with the files
  KeptFiles kept_;
};

/// "; worst space 0.25 (patch 3), back side 0.5 (patch 7)", without what is zero everywhere.
std::string losses_text(const Certificate& certificate);

} // namespace hemicube::radiosity::cli
