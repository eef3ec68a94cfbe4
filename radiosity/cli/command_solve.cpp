#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/refinement_options.h"
#include "radiosity/cli/requirements.h"
#include "radiosity/cli/session.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/output/solution_files.h"

#include <cmath>

namespace hemicube::radiosity::cli {
namespace {

std::string bound_text(double bound) {
  return std::isfinite(bound) ? rounded(bound) : "unknown";
}

std::string shots_text(const Certificate& c) {
  return concat(", ", counted(c.shots, "shot", "shots"), ", unshot ", rounded(c.unshot),
                ", which can add ", bound_text(c.unshot_bound));
}

std::string residual_text(const Certificate& c) {
  return concat(", ", counted(c.sweeps, "sweep", "sweeps"), ", residual ", rounded(c.residual),
                ", estimated error ", bound_text(c.estimated_error),
                c.rounding_floor ? " (rounding allows no less)" : "");
}

/// Draws the state after some shots into DIR/snapshots.
Status write_snapshot(Session* session, const Camera& camera, std::uint64_t shots,
                      const Solution& solution) {
  const LoadedScene& loaded = session->loaded;
  PictureValues displayed;
  SerialExecutor serial; // this is called from within the work of the others
  Picture picture;
  FileSet files;
  HC_TRY(load_image_plugin());
  HC_TRY(displayed_values(loaded.patches, solution, &displayed));
  HC_TRY(draw_picture(loaded.scene, loaded.patches, displayed, camera,
                      {*session->line.options.kernels}, serial, &picture));
  const Result<double> exposure = choose_exposure(picture, session->line.exposure);
  HC_TRY(exposure.status());
  std::string name = std::to_string(shots);
  name.insert(0, name.size() < 6 ? 6 - name.size() : 0, '0');
  HC_TRY(files.begin(session->line.output + "/snapshots"));
  HC_TRY(write_picture(&files, name + ".png", picture, exposure.value()));
  return files.commit();
}

void print_summary(const Session& session, const Certificate& certificate) {
  const Certificate& c = certificate;
  print(concat(session.mesh_text(c), ", ", session.rung_text(c), c.has_shots ? shots_text(c) : "",
               c.has_residual ? residual_text(c) : "",
               c.has_radiosity_error
                   ? concat(" of the solver, ", rounded(c.radiosity_error), " of the form factors")
                   : "",
               losses_text(c), "\n"));
  print(concat("form factors ", hex(c.form_factor_hash), ", radiosity ", hex(c.radiosity_hash)));
  if (!session.line.output.empty())
    print(concat("; files in ", session.line.output));
  print("\n");
}

/// Writes all files of a solution. @param report  receives the text of report.json
Status write_files(Session* session, const Solution& solution, const Certificate& certificate,
                   const Camera& camera, FileSet* files, std::string* report) {
  const CommandLine& line = session->line;
  const LoadedScene& loaded = session->loaded;
  std::string picture_note;
  HC_TRY(check_interrupt());
  HC_TRY(write_solution(files,
                        {loaded.patches, solution, session->report_parts(certificate), camera,
                         line.exposure, *line.options.kernels, session->tree()},
                        report, &picture_note));
  if (!picture_note.empty() && !line.quiet)
    print_message(picture_note);
  return {};
}

} // namespace

Status run_solve(const CommandLine& line) {
  HC_TRY(check_applicable(line));
  HC_TRY(check_refinement(line));
  Session session(line);
  HC_TRY(session.begin(line.input));
  FileSet files;
  Camera camera;
  if (!line.output.empty()) {
    HC_TRY(session.choose_camera(&camera));
    HC_TRY(begin_solution(&files, line.output));
  }
  if (!line.refinement.adaptive)
    HC_TRY(session.begin_files(line.output.empty() ? "" : line.output + "/form_factors.hcf"));
  Solution solution;
  Certificate certificate;
  const Status solved =
      session.solve(&solution, &certificate, [&](std::uint64_t shots, const Solution& state) {
        return write_snapshot(&session, camera, shots, state);
      });
  if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
    return solved;
  std::string report = session.report_text(certificate);
  if (!line.output.empty())
    HC_TRY(write_files(&session, solution, certificate, camera, &files, &report));
  if (line.json)
    print(report);
  else if (!line.quiet)
    print_summary(session, certificate);
  const Status checked =
      check_requirements(line.requirements, {certificate, closure_error(solution),
                                             line.refinement.adaptive ? "element" : "patch"});
  if (solved.ok() || checked.ok())
    return solved.ok() ? checked : solved;
  flush_output();
  print_message(solved.message());
  return checked;
}

} // namespace hemicube::radiosity::cli
