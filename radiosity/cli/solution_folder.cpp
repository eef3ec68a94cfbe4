#include "radiosity/cli/solution_folder.h"

#include "radiosity/light_model.h"
#include "radiosity/output/number_text.h"
#include "radiosity/output/patch_table.h"
#include "radiosity/scene/text_cursor.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

using Json = nlohmann::json;

constexpr const char* kAdvice = "; solve it again, or name the scene and the mesh options that "
                                "the solution was made with";

std::string path_in(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

} // namespace

Status read_origin(const std::string& folder, SolutionOrigin* origin) {
  *origin = {};
  origin->report_path = path_in(folder, "report.json");
  std::string text;
  HC_TRY(read_file(origin->report_path, &text));
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object())
    return Status::error(StatusCode::kBadScene, origin->report_path,
                         ": is no report of a solution");
  const Json none;
  const auto at = [&](const char* pointer) -> const Json& {
    const Json::json_pointer place(pointer);
    return report.contains(place) ? report.at(place) : none;
  };
  if (at("/run/scene").is_string())
    origin->scene = at("/run/scene").get<std::string>();
  if (at("/result/options/max_edge").is_number())
    origin->mesh.max_edge = at("/result/options/max_edge").get<double>();
  DiscontinuityLimits& limits = origin->mesh.limits;
  origin->mesh.discontinuity = at("/result/options/discontinuity").is_object();
  if (at("/result/options/discontinuity/snap").is_number())
    limits.snap = at("/result/options/discontinuity/snap").get<double>();
  for (const auto& [pointer, limit] :
       {std::pair("/result/options/discontinuity/max_emitters", &limits.max_emitters),
        std::pair("/result/options/discontinuity/max_elements", &limits.max_elements)})
    if (at(pointer).is_number_unsigned())
      *limit = at(pointer).get<std::uint64_t>();
  if (at("/result/patches").is_number_unsigned())
    origin->patches = at("/result/patches").get<std::uint64_t>();
  origin->is_adaptive = at("/result/adaptive").is_object();
  if (at("/result/hashes/scene").is_string())
    origin->scene_hash = at("/result/hashes/scene").get<std::string>();
  return {};
}

Status follow_origin(const SolutionOrigin& origin, CommandLine* line) {
  if (line->scene.empty())
    line->scene = origin.scene;
  if (line->scene.empty())
    return Status::error(StatusCode::kBadScene, origin.report_path,
                         ": does not name the scene it is about; name it with --scene");
  if (line->mesh.max_edge == 0 && !line->mesh.discontinuity)
    line->mesh = origin.mesh;
  return {};
}

Status check_origin(const SolutionOrigin& origin, const Session& session) {
  const LoadedScene& loaded = session.loaded;
  const std::uint64_t patches = loaded.patches.patch_count();
  if (origin.patches && *origin.patches != patches)
    return Status::error(StatusCode::kBadScene, origin.report_path, ": is about ", *origin.patches,
                         " patches, ", session.line.scene, " has ", patches, kAdvice);
  const std::string hash = hex(hash_scene(loaded.scene, loaded.patches));
  if (origin.scene_hash != hash)
    return Status::error(StatusCode::kBadScene, origin.report_path, ": is about a scene with hash ",
                         origin.scene_hash.empty() ? "(none)" : origin.scene_hash, ", ",
                         session.line.scene, " has ", hash, kAdvice);
  return {};
}

Status follow_refinement(const SolutionOrigin& origin, Session* session) {
  if (!origin.is_adaptive)
    return {};
  const std::string path = path_in(session->line.input, "elements.csv");
  std::string text;
  HC_TRY(read_file(path, &text));
  return session->refine_as(text, path);
}

Status read_solution(const Session& session, Solution* solution) {
  const std::string path = path_in(session.line.input, "patches.csv");
  std::string text;
  HC_TRY(read_file(path, &text));
  return read_patch_table(text, path, session.loaded.scene, session.loaded.patches, solution);
}

} // namespace hemicube::radiosity::cli
