#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"
#include "radiosity/cli/points_file.h"
#include "radiosity/cli/solution_folder.h"
#include "radiosity/cli/stopwatch.h"
#include "radiosity/cli/surface_points.h"
#include "radiosity/output/file_set.h"

namespace hemicube::radiosity::cli {
namespace {

/// x,y,z,nx,ny,nz,space,back_side, then irradiance_<band>: one line a point. H = sum_j F_j B_j +
/// s E_space.
std::string probe_table(const LoadedScene& loaded, const Solution& solution,
                        std::span<const Receiver> points, const FormFactorMatrix& matrix) {
  const Scene& scene = loaded.scene;
  std::string text = "x,y,z,nx,ny,nz,space,back_side";
  for (std::uint32_t b = 0; b < scene.band_count(); ++b) {
    text += ',';
    append_csv_text(&text, concat("irradiance_", scene.bands[b]));
  }
  text += '\n';
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 &p = points[k].position, &n = points[k].normal;
    const RowView row = matrix.row(k);
    for (const double value : {p.x, p.y, p.z, n.x, n.y, n.z, row.space}) {
      append_number(&text, value);
      text += ',';
    }
    append_number(&text, row.back_side);
    for (std::uint32_t b = 0; b < scene.band_count(); ++b) {
      text += ',';
      append_number(&text, row_dot(row, solution.radiosity.data() + b, scene.band_count()) +
                               row.space * scene.space_exitance[b]);
    }
    text += '\n';
  }
  return text;
}

void print_summary(const Session& session, const Certificate& certificate, std::size_t points) {
  print(concat(counted(points, "point", "points"), ", ", session.rung_text(certificate), ", ",
               counted(certificate.nonzeros, "form factor", "form factors"), "; file ",
               session.line.output, "\n"));
}

} // namespace

Status run_probe(const CommandLine& given) {
  CommandLine line = given;
  if (line.json && line.output.empty())
    return Status::error(StatusCode::kInvalidArgument,
                         "--json needs -o FILE.csv: without it the table is what is printed");
  SolutionOrigin origin;
  HC_TRY(read_origin(line.input, &origin));
  HC_TRY(follow_origin(origin, &line));
  Session session(line);
  HC_TRY(session.begin(line.scene));
  HC_TRY(follow_refinement(origin, &session));
  HC_TRY(check_origin(origin, session));
  Solution solution;
  HC_TRY(read_solution(session, &solution));
  std::vector<Receiver> points;
  HC_TRY(read_points(line.points, &points));
  FileSet files;
  std::string name;
  if (!line.output.empty())
    HC_TRY(files.begin_file(line.output, &name));

  FormFactorMatrix matrix;
  Certificate certificate;
  std::vector<Receiver> receivers = points;
  move_to_front(session.loaded.patches, &receivers);
  HC_TRY(session.point_form_factors(receivers, &matrix, &certificate));
  const std::string table = probe_table(session.loaded, solution, points, matrix);
  if (line.output.empty()) {
    print(table);
    return {};
  }
  Stopwatch watch;
  HC_TRY(files.add(name, table));
  HC_TRY(check_interrupt());
  HC_TRY(files.commit());
  session.run.write_seconds = watch.lap();
  if (line.json)
    print(session.report_text(certificate));
  else if (!line.quiet)
    print_summary(session, certificate, points.size());
  return {};
}

} // namespace hemicube::radiosity::cli
