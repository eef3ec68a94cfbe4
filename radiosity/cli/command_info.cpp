#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/scene_facts.h"

#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

using Json = nlohmann::ordered_json;

void print_line(std::string_view label, std::string_view text) {
  constexpr std::size_t kLabelWidth = 14;
  std::string line(label);
  line.resize(std::max(line.size() + 1, kLabelWidth), ' ');
  print(concat(line, text, "\n"));
}

std::string vector_text(const Vec3& v) {
  return concat(v.x, " ", v.y, " ", v.z);
}

/// "r, g, b; all three solved", "r, g, b; 2 solved: g = r".
std::string bands_text(const Scene& scene, const SceneFacts& facts) {
  std::string names, equal;
  for (std::uint32_t b = 0; b < scene.band_count(); ++b) {
    names += concat(b == 0 ? "" : ", ", scene.bands[b]);
    if (facts.solved_band[b] != b)
      equal += concat(equal.empty() ? ", because everywhere " : ", ", scene.bands[b], " = ",
                      scene.bands[facts.solved_band[b]]);
  }
  return concat(names, "; ", facts.solved_band_count, " of ", scene.band_count(), " solved", equal);
}

std::string emitters_text(const Scene& scene, const SceneFacts& facts) {
  if (facts.emitting_patches == 0)
    return "none: all radiosities are 0 unless space radiates";
  std::string text = concat(counted(facts.emitting_patches, "patch", "patches"), ", W:");
  for (std::uint32_t b = 0; b < scene.band_count(); ++b)
    text += concat(" ", scene.bands[b], " ", rounded(facts.emitted[b]));
  return text;
}

std::string space_text(const Scene& scene) {
  std::string text;
  for (std::uint32_t b = 0; b < scene.band_count(); ++b)
    if (scene.space_exitance[b] != 0)
      text += concat(text.empty() ? "" : ", ", scene.bands[b], " ", scene.space_exitance[b]);
  return text.empty() ? "dark" : "exitance W/m^2: " + text;
}

std::string discontinuity_text(const DiscontinuityReport& cut) {
  return concat(cut.patches, " patches cut into ", cut.elements, " along ",
                counted(cut.contact_lines, "line", "lines"), " of contact and ",
                counted(cut.shadow_lines, "border", "borders"), " of shadows (",
                counted(cut.wedges, "wedge", "wedges"), "), of ", cut.emitters_treated, " of ",
                counted(cut.emitters, "emitter", "emitters"), " with ",
                rounded(100 * cut.power_treated), " % of the power");
}

std::string camera_text(const Scene& scene) {
  if (!scene.has_camera)
    return "none in the scene: fitted outside the bounds";
  const Camera& camera = scene.camera;
  return concat("at ", vector_text(camera.position), ", to ", vector_text(camera.target), ", up ",
                vector_text(camera.up), ", ", camera.vertical_field_of_view, " degrees, ",
                camera.width, "x", camera.height);
}

std::string time_text(double seconds) {
  return seconds < 120    ? concat(rounded(seconds), " s")
         : seconds < 7200 ? concat(rounded(seconds / 60), " min")
                          : concat(rounded(seconds / 3600), " h");
}

std::string cost_text(const Session& session, const RunCost& cost) {
  const Forecast& f = cost.forecast;
  std::string how = concat("rung ", rung_name(f.setting.rung));
  if (f.setting.rung <= Rung::kArea)
    how += concat(", resolution ", f.setting.resolution);
  return concat("about ", time_text(cost.seconds), " on ",
                counted(session.run.threads, "thread", "threads"), ", ",
                time_text(cost.form_factor_seconds), " of it form factors, and ",
                memory_text(cost.memory_bytes), " of memory, ", memory_text(cost.matrix_bytes),
                " of it matrix (", how, "; from ", counted(f.rows, "sample row", "sample rows"),
                " of ", rounded(cost.nonzeros_per_row), " entries)");
}

void print_text(const Session& session, const SceneFacts& facts) {
  const Scene& scene = session.loaded.scene;
  const PatchSet& patches = session.loaded.patches;
  const std::uint32_t count = patches.patch_count();
  for (const std::string& file : session.loaded.read.files)
    print_line("file", file);
  print_line("faces",
             concat(scene.face_count(), ", ", counted(scene.vertices.size(), "vertex", "vertices"),
                    ", ", counted(scene.materials.size(), "material", "materials"), ", ",
                    counted(scene.groups.size(), "group", "groups")));
  print_line("patches",
             concat(count, ": ", patches.front_count, " fronts, ", count - patches.front_count,
                    " backs of two-sided faces; area ", rounded(facts.area)));
  if (session.line.mesh.discontinuity)
    print_line("discontinuity", discontinuity_text(session.loaded.discontinuities));
  print_line("bounds", concat(vector_text(facts.low), " .. ", vector_text(facts.high)));
  print_line("bands", bands_text(scene, facts));
  print_line("black", concat(counted(facts.black_patches, "patch reflects", "patches reflect"),
                             " nothing: no row in the sweep"));
  print_line("emitters", emitters_text(scene, facts));
  print_line("space", space_text(scene));
  print_line("reflectance", concat("at most ", facts.largest_reflectance));
  print_line("camera", camera_text(scene));
  const std::vector<std::string> changes = warnings(session.loaded);
  for (const std::string& change : changes)
    print_line("changed", change);
  if (changes.empty())
    print_line("changed", "nothing skipped, nothing repaired");
  print_line("scene hash", hex(facts.scene_hash));
  print_line("cost", cost_text(session, facts.cost));
}

Json vector_json(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json bands_json(const Scene& scene, const SceneFacts& facts) {
  Json bands = Json::array();
  for (std::uint32_t b = 0; b < scene.band_count(); ++b)
    bands.push_back({{"name", std::string(scene.bands[b])},
                     {"solved_as", std::string(scene.bands[facts.solved_band[b]])},
                     {"emitted", facts.emitted[b]},
                     {"space_exitance", scene.space_exitance[b]}});
  return bands;
}

Json camera_json(const Camera& camera) {
  return {{"position", vector_json(camera.position)},
          {"target", vector_json(camera.target)},
          {"up", vector_json(camera.up)},
          {"vertical_field_of_view", camera.vertical_field_of_view},
          {"width", camera.width},
          {"height", camera.height}};
}

void print_json(const Session& session, const SceneFacts& facts) {
  const Scene& scene = session.loaded.scene;
  const PatchSet& patches = session.loaded.patches;
  Json json;
  json["files"] = session.loaded.read.files;
  json["faces"] = scene.face_count();
  json["vertices"] = scene.vertices.size();
  json["materials"] = scene.materials.size();
  json["groups"] = scene.groups.size();
  json["patches"] = patches.patch_count();
  json["fronts"] = patches.front_count;
  json["backs"] = patches.patch_count() - patches.front_count;
  json["area"] = facts.area;
  json["bounds"] = Json::array({vector_json(facts.low), vector_json(facts.high)});
  json["bands"] = bands_json(scene, facts);
  json["solved_bands"] = facts.solved_band_count;
  json["black_patches"] = facts.black_patches;
  json["emitting_patches"] = facts.emitting_patches;
  json["largest_reflectance"] = facts.largest_reflectance;
  if (scene.has_camera)
    json["camera"] = camera_json(scene.camera);
  json["changed"] = warnings(session.loaded);
  json["hashes"]["scene"] = hex(facts.scene_hash);
  const Forecast& f = facts.cost.forecast;
  json["cost"] = {{"sample_rows", f.rows},
                  {"nonzeros_per_row", facts.cost.nonzeros_per_row},
                  {"matrix_bytes", facts.cost.matrix_bytes},
                  {"memory_bytes", facts.cost.memory_bytes},
                  {"form_factor_seconds", facts.cost.form_factor_seconds},
                  {"seconds", facts.cost.seconds},
                  {"rung", rung_name(f.setting.rung)},
                  {"resolution", f.setting.resolution},
                  {"target", f.setting.target},
                  {"threads", session.run.threads}};
  print(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace

Status run_info(const CommandLine& line) {
  CommandLine silent = line; // what was changed is part of the facts
  silent.quiet = true;
  Session session(silent);
  HC_TRY(session.begin(line.input));
  SceneFacts facts;
  HC_TRY(gather_facts(&session, &facts));
  line.json ? print_json(session, facts) : print_text(session, facts);
  return {};
}

} // namespace hemicube::radiosity::cli
