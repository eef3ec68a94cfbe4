#include "radiosity/scene/mesh_reader.h"

#include "radiosity/scene/obj_reader.h"
#include "radiosity/scene/off_reader.h"
#include "radiosity/scene/ply_reader.h"
#include "radiosity/scene/stl_reader.h"
#include "radiosity/scene/text_cursor.h"

namespace hemicube::radiosity {

bool is_mesh_file(std::string_view path) {
  for (const char* extension : {".obj", ".ply", ".off", ".stl"})
    if (has_extension(path, extension))
      return true;
  return false;
}

static Status read_by_name(const std::string& path, FileMesh* mesh, ReadReport* report) {
  if (has_extension(path, ".ply"))
    return read_ply(path, mesh, report);
  if (has_extension(path, ".off"))
    return read_off(path, mesh, report);
  if (has_extension(path, ".stl"))
    return read_stl(path, mesh, report);
  return read_obj(path, mesh, report);
}

Status read_mesh(const std::string& path, FileMesh* mesh, ReadReport* report) {
  HC_TRY(read_by_name(path, mesh, report));
  report->add_float_grid(mesh->vertices.span());
  return {};
}

} // namespace hemicube::radiosity
