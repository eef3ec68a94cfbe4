#include "radiosity/cli/points_file.h"

#include "radiosity/output/csv_reader.h"
#include "radiosity/scene/text_cursor.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace hemicube::radiosity::cli {
namespace {

constexpr std::string_view kColumns[] = {"x", "y", "z", "nx", "ny", "nz"};

Status read_record(const std::string& path, std::uint64_t line,
                   const std::vector<std::string>& fields, Receiver* point) {
  if (fields.size() != std::size(kColumns))
    return error_at(path, line, fields.size(), " fields; there must be 6: x,y,z,nx,ny,nz");
  double values[6] = {};
  for (std::size_t k = 0; k < fields.size(); ++k)
    if (parse_number(fields[k], &values[k]) != NumberForm::kFinite)
      return error_at(path, line, kColumns[k], " is ", in_quotes(fields[k]),
                      ", not a finite number");
  *point = {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
  if (point->normal == Vec3(0, 0, 0))
    return error_at(path, line, "the normal is 0,0,0; give a direction");
  return {};
}

} // namespace

Status read_points(const std::string& path, std::vector<Receiver>* points) {
  std::string text;
  HC_TRY(read_file(path, &text));
  CsvReader reader(text);
  std::vector<std::string> fields;
  const bool any = reader.next(&fields);
  for (std::string& field : fields)
    std::erase(field, ' ');
  if (!any || !std::ranges::equal(fields, kColumns))
    return error_at(path, 1, "the first line must be the header x,y,z,nx,ny,nz, not ",
                    in_quotes(std::string_view(text).substr(0, text.find_first_of("\r\n"))));
  while (reader.next(&fields)) {
    Receiver point;
    HC_TRY(read_record(path, reader.line(), fields, &point));
    points->push_back(point);
  }
  if (points->empty())
    return Status::error(StatusCode::kBadScene, path, ": no points after the header");
  return {};
}

} // namespace hemicube::radiosity::cli
