#include "radiosity/output/solution_files.h"

#include "radiosity/output/element_table.h"
#include "radiosity/output/glb_writer.h"
#include "radiosity/output/group_table.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/output/patch_table.h"
#include "radiosity/output/ply_writer.h"
#include "radiosity/output/vertex_radiosity.h"

#include <chrono>
#include <exception>

namespace hemicube::radiosity {
namespace {

using Clock = std::chrono::steady_clock;

void add_note(const Status& status, std::string* note) {
  *note += note->empty() ? "" : "\n";
  *note += status.message();
}

Status write_pictures(FileSet* files, const Picture& picture, double exposure, std::string* note) {
  if (const Status loaded = load_image_plugin(); !loaded.ok()) {
    add_note(loaded, note);
    return {};
  }
  HC_TRY(write_picture(files, "view.exr", picture, exposure));
  return write_picture(files, "view.png", picture, exposure);
}

Status write_report(FileSet* files, const ReportParts& parts, Clock::time_point start,
                    std::string* report) {
  ReportParts timed = parts;
  timed.run.write_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  *report = report_json(timed);
  return files->add("report.json", *report);
}

Status write_meshes(FileSet* files, const SolutionParts& parts,
                    std::span<const float> corner_radiosity, double exposure, std::string* note) {
  const Scene& scene = parts.report.scene;
  const PatchSet& patches = parts.patches;
  const CornerVertices vertices =
      gather_corner_vertices(patches, corner_radiosity, parts.solution.band_count);
  HC_TRY(
      write_ply(files, "solution.ply", scene, patches, vertices, PlyColours::kDisplay, exposure));
  HC_TRY(write_ply(files, "solution_float.ply", scene, patches, vertices, PlyColours::kRadiance,
                   exposure));
  DisplayMesh mesh;
  HC_TRY(build_display_mesh(scene, patches, vertices, &mesh));
  const Status written =
      write_glb(files, "solution.glb", scene, mesh, exposure, parts.camera, parts.report.version);
  if (written.code() != StatusCode::kInvalidArgument)
    return written;
  add_note(written, note); // more than the format can hold
  return {};
}

Status write_all(FileSet* files, const SolutionParts& parts, std::string* report,
                 std::string* note) {
  const Clock::time_point start = Clock::now();
  const Scene& scene = parts.report.scene;
  const PatchSet& patches = parts.patches;
  const Solution& solution = parts.solution;

  HC_TRY(files->add("patches.csv", patch_table(scene, patches, solution)));
  if (parts.tree != nullptr)
    HC_TRY(files->add("elements.csv", element_table(*parts.tree)));
  HC_TRY(files->add("groups.csv", group_table(scene, patches, solution)));

  Buffer<float> corner_radiosity;
  HC_TRY(vertex_radiosities(patches, solution.radiosity, solution.band_count, &corner_radiosity));
  PictureValues displayed;
  HC_TRY(displayed_values(patches, solution, &displayed));
  SerialExecutor serial;
  Picture picture;
  HC_TRY(draw_picture(scene, patches, displayed, parts.camera, {parts.kernels}, serial, &picture));
  const Result<double> exposure = choose_exposure(picture, parts.exposure);
  HC_TRY(exposure.status());
  HC_TRY(write_meshes(files, parts, corner_radiosity.span(), exposure.value(), note));
  HC_TRY(write_pictures(files, picture, exposure.value(), note));
  HC_TRY(write_report(files, parts.report, start, report));
  return files->commit();
}

} // namespace

Status begin_solution(FileSet* files, const std::string& folder) {
  HC_TRY(files->begin(folder));
  for (const char* name :
       {"patches.csv", "elements.csv", "groups.csv", "solution.ply", "solution_float.ply",
        "solution.glb", "view.exr", "view.png", "report.json"})
    HC_TRY(files->check_name(name));
  return {};
}

Status write_solution(FileSet* files, const SolutionParts& parts, std::string* report,
                      std::string* note) {
  note->clear();
  try {
    return write_all(files, parts, report, note);
  } catch (const std::exception& exception) { // in practice: no memory for a text
    return Status::error(StatusCode::kOutOfMemory,
                         "the solution cannot be written: ", exception.what());
  }
}

} // namespace hemicube::radiosity
