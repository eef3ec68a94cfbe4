#include "radiosity/scene/ply_reader.h"

#include "radiosity/scene/ply_values.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

/// What a property is to us.
enum Role : int { kX, kY, kZ, kIndices, kSkipped };

Role role_of(std::string_view element, std::string_view property) {
  if (element == "vertex" && (property == "x" || property == "y" || property == "z"))
    return property == "x" ? kX : property == "y" ? kY : kZ;
  if (element == "face" && (property == "vertex_indices" || property == "vertex_index"))
    return kIndices;
  return kSkipped;
}

/// Refuses a file that lacks what a mesh is made of, or has it twice or in another form.
Status check_properties(const PlyHeader& header, const std::string& path) {
  int found[kSkipped] = {};
  for (const PlyElement& element : header.elements)
    for (const PlyProperty& property : element.properties) {
      const Role role = role_of(element.name, property.name);
      if (role == kSkipped)
        continue;
      const std::string what = "property " + in_quotes(property.name);
      if (++found[role] == 2)
        return error_at(path, element.line, what, " of element ", in_quotes(element.name),
                        " is declared twice");
      if (role == kIndices && !(property.is_list && is_integer(property.type)))
        return error_at(path, element.line, what, " must be a list of integers");
      if (role != kIndices && property.is_list)
        return error_at(path, element.line, what, " must be a number, not a list");
    }
  for (const Role role : {kX, kY, kZ})
    if (found[role] == 0)
      return Status::error(StatusCode::kBadScene, path, ": element 'vertex' lacks the property '",
                           std::string_view("xyz").substr(static_cast<std::size_t>(role), 1), "'");
  if (found[kIndices] == 0)
    return Status::error(StatusCode::kBadScene, path,
                         ": element 'face' lacks the property 'vertex_indices'");
  return {};
}

template <typename Values> class PlyBody {
public:
  PlyBody(const PlyHeader& header, std::string_view bytes, const std::string& path, FileMesh* mesh)
      : header_(header), values_(bytes, header, path), path_(path), mesh_(*mesh) {}

  Status read();

private:
  Status element(const PlyElement& element);
  Status property(const PlyProperty& property, Role role);
  Status skip(const PlyProperty& property);
  Status face(const PlyProperty& property);
  Status list_length(const PlyProperty& property, std::int64_t* count);

  const PlyHeader& header_;
  Values values_;
  const std::string& path_;
  FileMesh& mesh_;
  std::uint64_t vertex_count_ = 0; ///< as the header says: faces may come first
  Vec3 position_{0, 0, 0};
};

template <typename Values> Status PlyBody<Values>::read() {
  const MeshLimits limits;
  for (const PlyElement& each : header_.elements) {
    if (each.name == "vertex")
      vertex_count_ = each.count;
    if ((each.name == "vertex" && each.count > limits.vertices) ||
        (each.name == "face" && each.count > limits.faces))
      return error_at(path_, each.line, each.count, " x ", in_quotes(each.name),
                      " are too many: at most ", limits.vertices, " vertices and ", limits.faces,
                      " faces can be read");
  }
  HC_TRY(mesh_.corner_offsets.push_back(0));
  for (const PlyElement& each : header_.elements)
    HC_TRY(element(each));
  return values_.end();
}

template <typename Values> Status PlyBody<Values>::element(const PlyElement& element) {
  if (element.properties.empty())
    return {};
  std::vector<Role> roles;
  for (const PlyProperty& each : element.properties)
    roles.push_back(role_of(element.name, each.name));
  for (std::uint64_t i = 0; i < element.count; ++i) {
    HC_TRY(values_.begin_item(element, i));
    for (std::size_t k = 0; k < roles.size(); ++k)
      HC_TRY(property(element.properties[k], roles[k]));
    HC_TRY(values_.end_item());
    if (element.name == "vertex")
      HC_TRY(mesh_.vertices.push_back(position_));
  }
  return {};
}

template <typename Values>
Status PlyBody<Values>::property(const PlyProperty& property, Role role) {
  if (role == kSkipped)
    return skip(property);
  if (role == kIndices)
    return face(property);
  return values_.coordinate(property.type, &position_[role]);
}

template <typename Values> Status PlyBody<Values>::skip(const PlyProperty& property) {
  std::int64_t count = 1;
  if (property.is_list)
    HC_TRY(list_length(property, &count));
  for (std::int64_t k = 0; k < count; ++k)
    HC_TRY(values_.skip(property.type));
  return {};
}

template <typename Values> Status PlyBody<Values>::face(const PlyProperty& property) {
  std::int64_t count = 0;
  HC_TRY(list_length(property, &count));
  if (count < 3)
    return values_.error("a face needs 3 corners or more, this one has ", count);
  for (std::int64_t k = 0; k < count; ++k) {
    std::int64_t index = 0;
    HC_TRY(values_.integer(property.type, "vertex index", &index));
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
      return values_.error("vertex index ", index, ": the file has ", vertex_count_,
                           " vertices, counted from 0");
    HC_TRY(mesh_.corners.push_back(static_cast<std::uint32_t>(index)));
  }
  HC_TRY(mesh_.corner_offsets.push_back(mesh_.corners.size()));
  HC_TRY(mesh_.face_material.push_back(0));
  return mesh_.face_group.push_back(0);
}

template <typename Values>
Status PlyBody<Values>::list_length(const PlyProperty& property, std::int64_t* count) {
  HC_TRY(values_.integer(property.count_type, "the length of a list", count));
  return *count >= 0 ? Status() : values_.error("a list of ", *count, " values");
}

void count_skipped(const PlyHeader& header, ReadReport* report) {
  KeywordCounts vertices, faces, elements;
  for (const PlyElement& element : header.elements) {
    const bool is_vertex = element.name == "vertex";
    if (!is_vertex && element.name != "face") {
      elements.count(element.name, element.count);
      continue;
    }
    for (const PlyProperty& property : element.properties)
      if (role_of(element.name, property.name) == kSkipped)
        (is_vertex ? vertices : faces).count(property.name, element.count);
  }
  vertices.add_to(report, [](std::string_view) -> std::string_view { return "vertex properties"; });
  faces.add_to(report, [](std::string_view) -> std::string_view { return "face properties"; });
  elements.add_to(report, [](std::string_view) -> std::string_view { return "other elements"; });
}

} // namespace

Status read_ply(const std::string& path, FileMesh* mesh, ReadReport* report) {
  return without_exceptions(path, [&]() -> Status {
    *mesh = {};
    std::string bytes;
    HC_TRY(read_file(path, &bytes));
    report->add_file(path);
    PlyHeader header;
    HC_TRY(parse_ply_header(bytes, path, &header));
    HC_TRY(check_properties(header, path));
    if (header.encoding == PlyHeader::Encoding::kText) {
      HC_TRY(check_is_text(bytes, path, "a text PLY file"));
      HC_TRY(PlyBody<PlyText>(header, bytes, path, mesh).read());
    } else {
      HC_TRY(PlyBody<PlyBinary>(header, bytes, path, mesh).read());
    }
    if (mesh->face_count() == 0)
      return Status::error(StatusCode::kBadScene, path, ": the scene has no faces");
    mesh->materials = {{}};
    mesh->groups = {{}};
    count_skipped(header, report);
    return {};
  });
}

} // namespace hemicube::radiosity
