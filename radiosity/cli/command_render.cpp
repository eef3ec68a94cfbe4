#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/session.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/output/patch_table.h"
#include "radiosity/output/vertex_radiosity.h"
#include "radiosity/scene/text_cursor.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

Status read_solution(const Session& session, Solution* solution) {
  const std::string path = (std::filesystem::path(session.line.input) / "patches.csv").string();
  std::string text;
  HC_TRY(read_file(path, &text));
  return read_patch_table(text, path, session.loaded.scene, session.loaded.patches, solution);
}

/// Draws the picture and writes it aside. @param exposure  receives the one that was used
Status write_image(const Session& session, const Solution& solution, const Camera& camera,
                   const std::string& name, FileSet* files, double* exposure) {
  const LoadedScene& loaded = session.loaded;
  Buffer<float> corner_radiosity;
  HC_TRY(vertex_radiosities(loaded.patches, solution.radiosity, solution.band_count,
                            &corner_radiosity));
  Picture picture;
  HC_TRY(draw_picture(loaded.scene, loaded.patches, solution, corner_radiosity, camera,
                      *session.line.options.kernels, &picture));
  const Result<double> chosen = choose_exposure(picture, session.line.exposure);
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

/// Where a solution says it comes from, unless the command line says it.
Status read_origin(CommandLine* line) {
  const std::string path = (std::filesystem::path(line->input) / "report.json").string();
  std::string text;
  HC_TRY(read_file(path, &text));
  const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
  const nlohmann::json none;
  const auto at = [&](const char* pointer) -> const nlohmann::json& {
    const nlohmann::json::json_pointer place(pointer);
    return report.contains(place) ? report.at(place) : none;
  };
  if (!at("/run/scene").is_string())
    return Status::error(StatusCode::kBadScene, path,
                         ": does not name the scene it is about; name it with --scene");
  line->scene = at("/run/scene").get<std::string>();
  if (line->max_edge == 0 && at("/result/options/max_edge").is_number())
    line->max_edge = at("/result/options/max_edge").get<double>();
  return {};
}

} // namespace

Status run_render(const CommandLine& given) {
  CommandLine line = given;
  HC_TRY(image_kind(line.output).status());
  std::error_code ignored;
  const bool is_solved = std::filesystem::is_directory(line.input, ignored);
  if (!is_solved && !line.scene.empty())
    return Status::error(StatusCode::kInvalidArgument, line.input,
                         ": is no folder with a solution, which --scene is for");
  if (is_solved && line.scene.empty())
    HC_TRY(read_origin(&line));
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
  HC_TRY(write_image(session, solution, camera, name, &files, &exposure));
  HC_TRY(check_interrupt());
  HC_TRY(files.commit());
  print_summary(line, camera, exposure);
  return solved;
}

} // namespace hemicube::radiosity::cli
