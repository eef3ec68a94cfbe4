#include "radiosity/scene/obj_reader.h"

#include "radiosity/scene/text_cursor.h"

#include <map>
#include <string_view>
#include <unordered_map>

namespace hemicube::radiosity {
namespace {

/// The name in force (`g`, `usemtl`), and numbers for names from 0 in the order faces first use
/// them.
class NameInForce {
public:
  explicit NameInForce(std::vector<FileMesh::Name>* used) : used_(used) {}

  void set(std::string text, std::uint64_t line) {
    name_ = {std::move(text), line};
    numbered_ = false;
  }

  /// The number of the name in force; to be called once per face.
  std::uint32_t use() {
    if (!numbered_) {
      const auto next = static_cast<std::uint32_t>(used_->size());
      const auto [entry, is_new] = numbers_.emplace(name_.text, next);
      if (is_new)
        used_->push_back(name_);
      number_ = entry->second;
      numbered_ = true;
    }
    return number_;
  }

private:
  std::vector<FileMesh::Name>* used_;
  FileMesh::Name name_;
  bool numbered_ = false;
  std::uint32_t number_ = 0;
  std::unordered_map<std::string, std::uint32_t> numbers_; // only looked up, never iterated over
};

class ObjParser {
public:
  ObjParser(std::string_view path, const MeshLimits& limits, FileMesh* mesh)
      : path_(path), limits_(limits), mesh_(*mesh) {}

  Status parse(std::string_view text);
  void count_skipped(ReadReport* report) const;

private:
  Status statement(std::string_view keyword, std::string_view rest);
  Status vertex(std::string_view rest);
  Status face(std::string_view rest);
  Status corner(std::string_view word);
  Status vertex_index(std::string_view word, std::uint32_t* index);
  Status name(std::string_view keyword, std::string_view rest, FileMesh::Name* name);
  Status check_forward_references() const;

  template <typename... Parts> Status error(const Parts&... parts) const {
    return error_at(path_, line_, parts...);
  }

  std::string_view path_;
  const MeshLimits limits_;
  FileMesh& mesh_;
  std::uint64_t line_ = 0;
  NameInForce material_{&mesh_.materials};
  NameInForce group_{&mesh_.groups};

  /// Faces may name vertices that come later. Of such indices only those above all before them are
  /// kept: the first that turns out to be too large is always among them.
  struct ForwardReference {
    std::uint64_t index; ///< from 1
    std::uint64_t line;
  };
  std::vector<ForwardReference> forward_references_;

  KeywordCounts skipped_;
  std::uint64_t extra_coordinates_ = 0;
};

Status ObjParser::parse(std::string_view text) {
  HC_TRY(mesh_.corner_offsets.push_back(0));
  LineReader lines(text);
  while (lines.next()) {
    line_ = lines.number();
    std::string_view rest = lines.line();
    const std::string_view keyword = next_word(&rest);
    if (!keyword.empty())
      HC_TRY(statement(keyword, rest));
  }
  HC_TRY(check_forward_references());
  if (mesh_.face_count() == 0)
    return Status::error(StatusCode::kBadScene, path_, ": the scene has no faces");
  return {};
}

Status ObjParser::statement(std::string_view keyword, std::string_view rest) {
  if (keyword == "v")
    return vertex(rest);
  if (keyword == "f")
    return face(rest);
  if (keyword == "g") {
    std::string names(next_word(&rest));
    for (std::string_view word = next_word(&rest); !word.empty(); word = next_word(&rest))
      names.append(" ").append(word);
    group_.set(std::move(names), line_);
    return {};
  }
  if (keyword == "usemtl") {
    FileMesh::Name material;
    HC_TRY(name(keyword, rest, &material));
    material_.set(std::move(material.text), line_);
    return {};
  }
  if (keyword == "mtllib")
    return name(keyword, rest, &mesh_.libraries.emplace_back());
  skipped_.count(keyword);
  return {};
}

Status ObjParser::vertex(std::string_view rest) {
  if (mesh_.vertices.size() == limits_.vertices)
    return error("more than ", limits_.vertices, " vertices: split the scene into several runs");
  Vec3 position;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = next_word(&rest);
    if (word.empty())
      return error("a vertex needs 3 coordinates, this one has ", k);
    HC_TRY(parse_coordinate(path_, line_, word, &position[k]));
  }
  if (!next_word(&rest).empty())
    ++extra_coordinates_;
  return mesh_.vertices.push_back(position);
}

Status ObjParser::face(std::string_view rest) {
  if (mesh_.face_count() == limits_.faces)
    return error("more than ", limits_.faces, " faces: split the scene into several runs");
  for (std::string_view word = next_word(&rest); !word.empty(); word = next_word(&rest))
    HC_TRY(corner(word));
  const std::uint64_t count = mesh_.corners.size() - mesh_.corner_offsets.back();
  if (count < 3)
    return error("a face needs 3 corners or more, this one has ", count);
  HC_TRY(mesh_.corner_offsets.push_back(mesh_.corners.size()));
  HC_TRY(mesh_.face_material.push_back(material_.use()));
  return mesh_.face_group.push_back(group_.use());
}

/// A corner is v, v/vt, v//vn or v/vt/vn. Only v is used, but the others must be integers.
Status ObjParser::corner(std::string_view word) {
  std::uint32_t index = 0;
  std::size_t slash = word.find('/');
  HC_TRY(vertex_index(word.substr(0, slash), &index));
  int slashes = 0;
  while (slash != std::string_view::npos) {
    const std::size_t begin = slash + 1;
    slash = word.find('/', begin);
    const std::string_view part = word.substr(begin, slash - begin);
    std::int64_t unused = 0;
    if (++slashes > 2 || (!part.empty() && !parse_integer(part, &unused)))
      return error("face corner ", in_quotes(word),
                   " is not of the form v, v/vt, v//vn or v/vt/vn");
  }
  return mesh_.corners.push_back(index);
}

Status ObjParser::vertex_index(std::string_view word, std::uint32_t* index) {
  std::int64_t number = 0;
  if (!parse_integer(word, &number))
    return error("vertex index ", in_quotes(word), " is not an integer (or is far too large)");
  const std::uint64_t count = mesh_.vertices.size();
  if (number == 0)
    return error("vertex index 0: indices count from 1, or from -1 backwards");
  if (number < 0) {
    const std::uint64_t back = 0 - static_cast<std::uint64_t>(number);
    if (back > count)
      return error("vertex index ", number, ": only ", count, " vertices come before this face");
    *index = static_cast<std::uint32_t>(count - back);
    return {};
  }
  const auto from_one = static_cast<std::uint64_t>(number);
  if (from_one > count &&
      (forward_references_.empty() || forward_references_.back().index < from_one))
    forward_references_.push_back({from_one, line_});
  *index = static_cast<std::uint32_t>(from_one - 1);
  return {};
}

Status ObjParser::name(std::string_view keyword, std::string_view rest, FileMesh::Name* name) {
  *name = {std::string(rest_as_name(rest)), line_};
  return name->text.empty() ? error(keyword, " without a name") : Status();
}

Status ObjParser::check_forward_references() const {
  const std::uint64_t count = mesh_.vertices.size();
  for (const ForwardReference& reference : forward_references_)
    if (reference.index > count)
      return error_at(path_, reference.line, "vertex index ", reference.index,
                      ": the file has only ", count, " vertices");
  return {};
}

/// What a statement that is read over would have said.
std::string_view meaning(std::string_view keyword) {
  static const std::map<std::string_view, std::string_view> kMeanings = {
      {"vn", "vertex normals"},       {"vt", "texture coordinates"}, {"s", "smoothing groups"},
      {"o", "object names"},          {"l", "line elements"},        {"p", "point elements"},
      {"vp", "free-form points"},     {"curv", "free-form curves"},  {"curv2", "free-form curves"},
      {"surf", "free-form surfaces"},
  };
  const auto entry = kMeanings.find(keyword);
  return entry == kMeanings.end() ? "other statements" : entry->second;
}

void ObjParser::count_skipped(ReadReport* report) const {
  skipped_.add_to(report, meaning);
  if (extra_coordinates_ != 0)
    report->skipped["vertex weights or colours (v)"] += extra_coordinates_;
}

} // namespace

Status read_obj(const std::string& path, FileMesh* mesh, ReadReport* report,
                const MeshLimits& limits) {
  return without_exceptions(path, [&]() -> Status {
    *mesh = {};
    std::string text;
    HC_TRY(read_file(path, &text));
    report->add_file(path);
    HC_TRY(check_is_text(text, path, "an OBJ file"));
    ObjParser parser(path, limits, mesh);
    HC_TRY(parser.parse(text));
    parser.count_skipped(report);
    return {};
  });
}

} // namespace hemicube::radiosity
