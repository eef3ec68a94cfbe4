#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/picture_options.h"
#include "radiosity/cli/session.h"
#include "radiosity/cli/solution_folder.h"
#include "radiosity/output/image_writer.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

/// What the picture shows; says what of it is not known.
Status find_values(const Session& session, const Solution& solution, PictureValues* values) {
  const PictureOptions& wish = session.line.picture;
  HC_TRY(picture_values(session.loaded.patches, solution, wish.quantity, wish.flat, values));
  const std::uint32_t unknown = unknown_count(*values);
  if (unknown != 0 && !session.line.quiet)
    print_message(concat(counted(unknown, "patch is", "patches are"),
                         " drawn as background: solved with --no-black-irradiance, the "
                         "irradiance there is not known"));
  return {};
}

/// Draws the picture and writes it aside. @param exposure  receives the one that was used
Status write_image(Session* session, const Solution& solution, const Camera& camera,
                   const std::string& name, FileSet* files, double* exposure) {
  const CommandLine& line = session->line;
  PictureValues values;
  HC_TRY(find_values(*session, solution, &values));
  Picture picture;
  HC_TRY(draw_picture(session->loaded.scene, session->loaded.patches, values, camera,
                      {*line.options.kernels, line.picture.samples}, session->workers(), &picture));
  const Result<double> chosen = choose_exposure(picture, line.exposure);
  HC_TRY(chosen.status());
  *exposure = chosen.value();
  return write_picture(files, name, picture, *exposure);
}

void print_summary(const CommandLine& line, const Camera& camera, double exposure) {
  if (line.json) {
    nlohmann::ordered_json json;
    json["image"] = line.output;
    json["width"] = camera.width;
    json["height"] = camera.height;
    json["exposure"] = exposure;
    print(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  } else if (!line.quiet) {
    print(concat(line.output, ": ", camera.width, "x", camera.height, ", exposure ",
                 rounded(exposure), "\n"));
  }
}

} // namespace

Status run_render(const CommandLine& given) {
  CommandLine line = given;
  HC_TRY(check_picture_options(line));
  std::error_code ignored;
  const bool is_solved = std::filesystem::is_directory(line.input, ignored);
  if (!is_solved && !line.scene.empty())
    return Status::error(StatusCode::kInvalidArgument, line.input,
                         ": is no folder with a solution, which --scene is for");
  if (is_solved && line.scene.empty()) {
    SolutionOrigin origin;
    HC_TRY(read_origin(line.input, &origin));
    HC_TRY(follow_origin(origin, &line));
  }
  Session session(line);
  HC_TRY(session.begin(is_solved ? line.scene : line.input));
  Camera camera;
  HC_TRY(session.choose_camera(&camera));
  Solution solution;
  if (is_solved)
    HC_TRY(read_solution(session, &solution));
  FileSet files;
  std::string name;
  HC_TRY(files.begin_file(line.output, &name));
  HC_TRY(load_image_plugin());

  Certificate certificate;
  const Status solved = is_solved ? Status() : session.solve(&solution, &certificate);
  if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
    return solved;
  double exposure = 0;
  HC_TRY(write_image(&session, solution, camera, name, &files, &exposure));
  HC_TRY(check_interrupt());
  HC_TRY(files.commit());
  print_summary(line, camera, exposure);
  return solved;
}

} // namespace hemicube::radiosity::cli
