#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/points_file.h"
#include "radiosity/cli/requirements.h"
#include "radiosity/cli/session.h"
#include "radiosity/cli/stopwatch.h"
#include "radiosity/output/group_matrix.h"
#include "radiosity/output/matrix_market.h"
#include "radiosity/scene/text_cursor.h"

namespace hemicube::radiosity::cli {
namespace {

/// @param rows  receives the selected patches; empty = all
Status select_rows(const RowSelection& selection, std::uint32_t patch_count,
                   std::vector<std::uint32_t>* rows) {
  if (selection.is_all())
    return {};
  *rows = selection.listed;
  if (!rows->empty() && rows->back() >= patch_count)
    return Status::error(StatusCode::kInvalidArgument, "--rows: patch ", rows->back(),
                         " does not exist: there are ", patch_count, " patches, counted from 0");
  if (rows->empty())
    for (std::uint64_t row = 0; row < patch_count; row += selection.every)
      rows->push_back(static_cast<std::uint32_t>(row));
  return {};
}

void print_summary(const Session& session, const Certificate& certificate,
                   const std::string& matrix_path) {
  const Certificate& c = certificate;
  print(concat(counted(c.patches, "patch", "patches"), ", ", session.rung_text(c), ", ",
               counted(c.nonzeros, "form factor", "form factors"), ", row sums ",
               rounded(c.row_sum.min), "..", rounded(c.row_sum.max), losses_text(c), "\n"));
  print(concat("form factors ", hex(c.form_factor_hash)));
  if (!matrix_path.empty())
    print(session.line.by_group
              ? concat("; file ", matrix_path)
              : concat("; files ", matrix_path, " and ", rows_file_name(matrix_path)));
  print("\n");
}

/// Whether the output can be what is asked for.
Status check_output(const CommandLine& line) {
  const bool is_hcf = has_extension(line.output, ".hcf"),
             is_of_all = line.points.empty() && line.rows.is_all();
  const auto refuse = [&](const char* why) {
    return Status::error(StatusCode::kInvalidArgument, "-o ", line.output, ": ", why);
  };
  if (!line.form_factors.empty() && !is_of_all)
    return Status::error(StatusCode::kInvalidArgument, "--form-factors ", line.form_factors,
                         ": holds the rows of all patches: leave out --rows and --points");
  if (line.by_group)
    return has_extension(line.output, ".csv")
               ? Status()
               : refuse("must end in .csv, for the form factors of groups");
  if (line.output.empty() || has_extension(line.output, ".mtx"))
    return {};
  if (!is_hcf)
    return refuse("must end in .mtx, for Matrix Market, or in .hcf, to solve with");
  if (!is_of_all)
    return refuse("an .hcf holds the rows of all patches: leave out --rows and --points");
  if (line.options.balance)
    return refuse("an .hcf holds form factors as they were computed: give --balance to the solve "
                  "that reads it");
  if (!line.form_factors.empty())
    return refuse("--form-factors makes an .hcf already");
  return {};
}

/// Writes what is asked for, but for an .hcf, which is written while it is computed.
Status write_output(const Session& session, const FormFactorMatrix& matrix,
                    std::span<const std::uint32_t> rows, const std::string& name, FileSet* files) {
  const LoadedScene& loaded = session.loaded;
  if (session.line.by_group)
    return write_group_matrix(files, name, matrix, loaded.scene, loaded.patches);
  return session.line.points.empty()
             ? write_matrix_market(files, name, matrix, loaded.patches, rows)
             : write_point_matrix_market(files, name, matrix);
}

} // namespace

Status run_formfactors(const CommandLine& line) {
  HC_TRY(check_output(line));
  HC_TRY(check_applicable(line));
  Session session(line);
  HC_TRY(session.begin(line.input));
  std::vector<Receiver> points;
  std::vector<std::uint32_t> rows;
  const bool of_points = !line.points.empty();
  if (of_points)
    HC_TRY(read_points(line.points, &points));
  else
    HC_TRY(select_rows(line.rows, session.loaded.patches.patch_count(), &rows));
  FileSet files;
  std::string name;
  if (!line.output.empty())
    HC_TRY(files.begin_file(line.output, &name));
  if (!of_points && rows.empty())
    HC_TRY(session.begin_files(line.output));

  FormFactorMatrix matrix;
  Certificate certificate;
  HC_TRY(of_points ? session.point_form_factors(points, &matrix, &certificate)
                   : session.form_factors(rows, &matrix, &certificate));

  if (!line.output.empty()) {
    Stopwatch watch;
    if (has_extension(line.output, ".hcf"))
      HC_TRY(write_row_sums(&files, name, matrix, session.loaded.patches));
    else
      HC_TRY(write_output(session, matrix, rows, name, &files));
    HC_TRY(check_interrupt());
    HC_TRY(files.commit());
    session.run.write_seconds = watch.lap();
  }
  double closure = 0;
  HC_TRY(closure_error(matrix, &closure));
  if (line.json)
    print(session.report_text(certificate));
  else if (!line.quiet)
    print_summary(session, certificate, line.output);
  return check_requirements(line.requirements,
                            {certificate, closure, of_points ? "point" : "patch"});
}

} // namespace hemicube::radiosity::cli
