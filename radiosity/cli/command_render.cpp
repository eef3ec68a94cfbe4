#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/film.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/picture_options.h"
#include "radiosity/cli/refinement_options.h"
#include "radiosity/cli/session.h"
#include "radiosity/cli/solution_folder.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/output/orbit.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

/// Chooses the folder of the images and proves that they can be written there, before the work.
/// @param name  receives the name of the picture, of which the frames of a film have theirs
Status begin_images(const CommandLine& line, FileSet* files, std::string* name) {
  HC_TRY(files->begin_file(line.output, name));
  for (std::uint32_t frame = 0; frame < line.picture.orbit; ++frame)
    HC_TRY(files->check_name(frame_name(*name, frame)));
  return load_image_plugin();
}

Status add_images(const Camera& camera, const std::string& name, std::uint32_t frames, Film* film,
                  FileSet* files) {
  if (frames == 0)
    HC_TRY(film->add(camera, name, files));
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    HC_TRY(check_interrupt());
    HC_TRY(film->add(orbit_camera(camera, frame, frames), frame_name(name, frame), files));
  }
  return check_interrupt();
}

void print_summary(const CommandLine& line, const Film& film) {
  const PictureOptions& picture = line.picture;
  const bool has_exposure = !picture.patch_ids && !picture.false_color;
  if (line.json) {
    nlohmann::ordered_json json;
    json["image"] = line.output;
    json["width"] = film.width();
    json["height"] = film.height();
    if (picture.orbit != 0)
      json["frames"] = picture.orbit;
    if (picture.false_color)
      json["range"] = {film.scale().min, film.scale().max};
    if (has_exposure)
      json["exposure"] = film.exposure();
    print(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  } else if (!line.quiet) {
    std::string text = concat(line.output, ": ", film.width(), "x", film.height());
    if (picture.orbit != 0)
      text += concat(", ", counted(picture.orbit, "frame", "frames"), " from ",
                     frame_name(line.output, 0));
    if (picture.false_color)
      text +=
          concat(", colours from ", rounded(film.scale().min), " to ", rounded(film.scale().max));
    if (has_exposure)
      text += concat(", exposure ", rounded(film.exposure()));
    print(text + "\n");
  }
}

} // namespace

Status run_render(const CommandLine& given) {
  CommandLine line = given;
  HC_TRY(check_picture_options(line));
  HC_TRY(check_refinement(line));
  std::error_code ignored;
  const bool is_solved = std::filesystem::is_directory(line.input, ignored);
  if (!is_solved && !line.scene.empty())
    return Status::error(StatusCode::kInvalidArgument, line.input,
                         ": is no folder with a solution, which --scene is for");
  if (is_solved && line.refinement.adaptive)
    return Status::error(StatusCode::kInvalidArgument, "--adaptive: ", line.input,
                         " is solved already, on the mesh it has");
  SolutionOrigin origin;
  if (is_solved) {
    const Status found = read_origin(line.input, &origin);
    if (line.scene.empty()) { // else the table of patches may do without a report
      HC_TRY(found);
      HC_TRY(follow_origin(origin, &line));
    }
  }
  if (line.picture.wedges && !line.mesh.discontinuity)
    return Status::error(StatusCode::kInvalidArgument,
                         "--wedges: needs --discontinuity, or a solution made with it");
  Session session(line);
  HC_TRY(session.begin(is_solved ? line.scene : line.input));
  Film film(&session);
  HC_TRY(film.find_band());
  Camera camera;
  HC_TRY(session.choose_camera(&camera));
  HC_TRY(check_legend(line, camera));
  Solution solution;
  HC_TRY(follow_refinement(origin, &session));
  if (is_solved)
    HC_TRY(read_solution(session, &solution));
  FileSet files;
  std::string name;
  HC_TRY(begin_images(line, &files, &name));

  Certificate certificate;
  const bool needs_light = !line.picture.patch_ids || line.refinement.adaptive;
  const Status solved =
      is_solved || !needs_light ? Status() : session.solve(&solution, &certificate);
  if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
    return solved;
  if (needs_light)
    HC_TRY(film.begin(solution));
  HC_TRY(add_images(camera, name, line.picture.orbit, &film, &files));
  HC_TRY(files.commit());
  print_summary(line, film);
  return solved;
}

} // namespace hemicube::radiosity::cli
