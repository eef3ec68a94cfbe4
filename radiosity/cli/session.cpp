#include "radiosity/cli/session.h"

#include "radiosity/cli/console.h"
#include "radiosity/cli/memory_plan.h"
#include "radiosity/cli/mesh_options.h"
#include "radiosity/light_model.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/output/element_table.h"
#include "radiosity/output/file_set.h"
#include "radiosity/output/report_json.h"
#include "radiosity/scene/text_cursor.h"
#include "raster/kernels.h"

#include <filesystem>
#include <sys/resource.h>

namespace hemicube::radiosity::cli {
namespace {

std::uint64_t peak_memory_bytes() {
  struct rusage usage = {};
  if (::getrusage(RUSAGE_SELF, &usage) != 0)
    return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

} // namespace

Status Session::begin(const std::string& scene_path) {
  HC_TRY(check_mesh_options(line.mesh));
  HC_TRY(load_scene(scene_path, line.mesh, &loaded, &run));
  scene_path_ = std::filesystem::absolute(scene_path).string();
  if (!line.quiet)
    for (const std::string& warning : warnings(loaded))
      print_message(concat(scene_path, ": ", warning));
  HC_TRY(pool_.init(line.threads));
  run.isa = line.options.kernels->name;
  run.threads = static_cast<std::uint32_t>(pool_.worker_count());
  return {};
}

Status Session::begin_files(const std::string& output) {
  FileSet probe;
  std::string name;
  if (!line.form_factors.empty()) {
    HC_TRY(kept_.begin_or_read_hcf(line.form_factors));
    if (!kept_.files.rows_are_given)
      HC_TRY(probe.begin_file(line.form_factors, &name));
  } else if (line.command == Command::kFormFactors && has_extension(line.output, ".hcf")) {
    HC_TRY(kept_.begin_hcf(output));
  } else {
    HC_TRY(kept_.begin(output));
  }
  MemoryPlan plan;
  HC_TRY(plan_memory(line.memory_bytes, loaded.patches.patch_count(), loaded.scene.band_count(),
                     pool_.worker_count(), &plan));
  // Shooting reads a matrix by columns, from a second copy.
  const bool has_columns = line.options.solver == SolverKind::kProgressive;
  kept_.files.most_bytes = has_columns ? plan.most_rows / 2 : plan.most_rows;
  kept_.files.range_bytes = plan.row_range;
  options_.files = &kept_.files;
  return {};
}

template <typename Work> Status Session::compute(Work work) {
  ProgressReport progress(line.quiet);
  Status status = work(&progress);
  progress.finish();
  if (options_.files != nullptr)
    status = kept_.finish(status);
  run.rows_resumed = kept_.files.rows_resumed;
  run.build_seconds = progress.seconds(ProgressReport::kBuild);
  run.form_factor_seconds = progress.seconds(ProgressReport::kRows);
  run.balance_seconds = progress.seconds(ProgressReport::kBalance);
  run.solve_seconds = progress.seconds(ProgressReport::kSolve);
  return status;
}

Status Session::solve(Solution* solution, Certificate* certificate,
                      const ProgressReport::TakeSnapshot& take_snapshot) {
  const Status status = compute([&](ProgressReport* progress) {
    progress->set_snapshots(take_snapshot);
    if (line.refinement.adaptive)
      return solve_refined(progress, solution, certificate);
    return solve_scene(loaded.scene, loaded.patches, options_, pool_, progress, solution,
                       certificate);
  });
  const bool is_of_scene = status.code() == StatusCode::kSingular ||
                           (status.code() == StatusCode::kBadScene && !kept_.files.rows_are_given);
  if (is_of_scene)
    return Status::error(status.code(), scene_path_, ": ", status.message());
  return status;
}

Status Session::solve_refined(ProgressReport* progress, Solution* solution,
                              Certificate* certificate) {
  coarse_ = std::move(loaded.patches);
  is_refined_ = true;
  return solve_adaptive(loaded.scene, coarse_, line.refinement.limits, line.options, pool_,
                        progress, &tree_, &loaded.patches, solution, certificate, &refinement_);
}

Status Session::refine_as(std::string_view element_table, const std::string& path) {
  coarse_ = std::move(loaded.patches);
  is_refined_ = true;
  HC_TRY(tree_.init(loaded.scene, coarse_));
  HC_TRY(read_element_table(element_table, path, &tree_));
  return tree_.make_mesh(&loaded.patches);
}

Status Session::form_factors(std::span<const std::uint32_t> rows, FormFactorMatrix* matrix,
                             Certificate* certificate) {
  const Status status = compute([&](Progress* progress) {
    return compute_form_factors(loaded.patches, rows, options_, pool_, progress, matrix,
                                certificate);
  });
  certificate->scene_hash = hash_scene(loaded.scene, loaded.patches);
  if (status.code() == StatusCode::kBadScene && !kept_.files.rows_are_given)
    return Status::error(status.code(), scene_path_, ": ", status.message());
  return status;
}

Status Session::point_form_factors(std::span<const Receiver> points, FormFactorMatrix* matrix,
                                   Certificate* certificate) {
  const Status status = compute([&](Progress* progress) {
    return compute_point_form_factors(loaded.patches, points, line.options, pool_, progress, matrix,
                                      certificate);
  });
  certificate->scene_hash = hash_scene(loaded.scene, loaded.patches);
  return status;
}

Status Session::forecast(ForecastProgress* progress, Forecast* forecast) {
  return radiosity::forecast(loaded.scene, loaded.patches, line.options, pool_, progress, forecast);
}

Status Session::choose_camera(Camera* camera) const {
  const CameraOptions& wish = line.camera;
  const Camera& own = loaded.scene.camera;
  *camera = own;
  if (!loaded.scene.has_camera)
    *camera = fit_camera(loaded.patches, wish.width.value_or(own.width),
                         wish.height.value_or(own.height));
  camera->width = wish.width.value_or(camera->width);
  camera->height = wish.height.value_or(camera->height);
  camera->position = wish.position.value_or(camera->position);
  camera->target = wish.target.value_or(camera->target);
  camera->up = wish.up.value_or(camera->up);
  camera->vertical_field_of_view = wish.field_of_view.value_or(camera->vertical_field_of_view);
  CameraView view;
  const Status status = camera_view(*camera, line.picture.samples_used(), &view);
  if (status.ok() || wish.is_any())
    return status;
  return Status::error(StatusCode::kBadScene, loaded.read.files.front(), ": ", status.message());
}

ReportParts Session::report_parts(const Certificate& certificate) {
  run.peak_memory_bytes = peak_memory_bytes();
  return {loaded.scene,
          line.options,
          certificate,
          loaded.mesh,
          loaded.read.skipped,
          run,
          kVersion,
          scene_path_,
          line.mesh.max_edge,
          line.mesh.discontinuity ? &loaded.discontinuities : nullptr,
          line.refinement.adaptive ? &refinement_ : nullptr};
}

std::string Session::report_text(const Certificate& certificate) {
  return report_json(report_parts(certificate));
}

std::string Session::mesh_text(const Certificate& certificate) const {
  if (!is_refined_)
    return counted(certificate.patches, "patch", "patches");
  return concat(counted(certificate.patches, "element", "elements"), " of ",
                counted(refinement_.patches, "patch", "patches"), " (",
                counted(refinement_.rounds, "round", "rounds"), ", ended by ",
                refinement_end_name(refinement_.end), ")");
}

std::string Session::rung_text(const Certificate& certificate) const {
  const RungSetting& setting = certificate.setting;
  std::string text = concat("rung ", rung_name(setting.rung));
  if (setting.rung <= Rung::kArea)
    text += concat(" at ", setting.resolution);
  if (certificate.hemicubes != 0 && run.form_factor_seconds > 0)
    text += concat(" (",
                   static_cast<std::uint64_t>(static_cast<double>(certificate.hemicubes) /
                                              run.form_factor_seconds),
                   " hemicubes/s)");
  if (certificate.has_form_factor_error)
    text += concat(", form factor error ", rounded(certificate.form_factor_error));
  return text;
}

std::string losses_text(const Certificate& certificate) {
  std::string text;
  const auto add = [&text](const char* name, const WorstFraction& fraction) {
    if (fraction.max > 0)
      text += concat(text.empty() ? "; worst " : ", ", name, " ", rounded(fraction.max), " (patch ",
                     fraction.worst_patch, "; ", fraction.count, " see some)");
  };
  add("space", certificate.space);
  add("back side", certificate.back_side);
  if (certificate.balanced)
    text += concat("; balanced by an RMS change of ", rounded(certificate.balance.rms_change));
  return text;
}

} // namespace hemicube::radiosity::cli
