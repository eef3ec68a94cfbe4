#include "radiosity/scene/off_reader.h"

#include "radiosity/scene/text_cursor.h"

#include <algorithm>
#include <string_view>

namespace hemicube::radiosity {
namespace {

class OffParser {
public:
  OffParser(std::string_view text, const std::string& path, FileMesh* mesh)
      : lines_(text), path_(path), mesh_(*mesh) {}

  Status parse();
  void count_skipped(ReadReport* report) const;

private:
  bool next_line();
  Status keyword();
  Status counts();
  Status vertex();
  Status face();

  template <typename... Parts> Status error(const Parts&... parts) const {
    return error_at(path_, lines_.number(), parts...);
  }
  Status ended(std::uint64_t count, std::string_view what, std::uint64_t read) const {
    return Status::error(StatusCode::kBadScene, path_, ": the file says ", count, " ", what,
                         ", but ends after ", read);
  }

  LineReader lines_;
  const std::string& path_;
  FileMesh& mesh_;
  std::string_view line_; ///< what is left of the current line
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  std::uint64_t more_than_a_vertex_ = 0;
  std::uint64_t more_than_a_face_ = 0;
};

bool OffParser::next_line() {
  const bool there_is_one = lines_.next_with_words();
  line_ = there_is_one ? lines_.line() : std::string_view();
  return there_is_one;
}

Status OffParser::parse() {
  HC_TRY(keyword());
  HC_TRY(counts());
  for (std::uint64_t i = 0; i < vertex_count_; ++i) {
    if (!next_line())
      return ended(vertex_count_, "vertices", i);
    HC_TRY(vertex());
  }
  HC_TRY(mesh_.corner_offsets.push_back(0));
  for (std::uint64_t i = 0; i < face_count_; ++i) {
    if (!next_line())
      return ended(face_count_, "faces", i);
    HC_TRY(face());
  }
  if (next_line())
    return error("the file says that it has ", face_count_, " faces, but this line is one more");
  if (face_count_ == 0)
    return Status::error(StatusCode::kBadScene, path_, ": the scene has no faces");
  return {};
}

/// OFF behind letters that tell what vertices have besides: ST, C, N. Writers are known that let
/// the first count follow without a blank.
Status OffParser::keyword() {
  if (!next_line())
    return Status::error(StatusCode::kBadScene, path_, ": the file is empty");
  std::string_view rest = line_;
  const std::string_view word = next_word(&rest);
  const std::size_t at = word.find("OFF");
  if (at == std::string_view::npos ||
      word.substr(0, at).find_first_not_of("STCN4n") != std::string_view::npos)
    return error("this is no OFF file: it begins with ", in_quotes(word));
  if (word.substr(0, at).find_first_of("4n") != std::string_view::npos)
    return error("vertices of ", in_quotes(word), " are not in three dimensions");
  if (next_word(&rest) == "BINARY")
    return error("binary OFF is not read: save the mesh as text");
  line_.remove_prefix(static_cast<std::size_t>(word.data() - line_.data()) + at + 3);
  return {};
}

Status OffParser::counts() {
  std::string_view rest = line_;
  if (next_word(&rest).empty() && !next_line())
    return Status::error(StatusCode::kBadScene, path_, ": the file ends before its counts");
  std::int64_t numbers[3] = {};
  int given = 0;
  for (std::string_view word = next_word(&line_); !word.empty(); word = next_word(&line_))
    if (given == 3 || !parse_integer(word, &numbers[given++]) || numbers[given - 1] < 0)
      return error("counts must be those of vertices, faces and edges, not ", in_quotes(word));
  if (given < 2)
    return error("counts of vertices and faces are needed");
  vertex_count_ = static_cast<std::uint64_t>(numbers[0]);
  face_count_ = static_cast<std::uint64_t>(numbers[1]);
  const MeshLimits limits;
  if (vertex_count_ > limits.vertices || face_count_ > limits.faces)
    return error(vertex_count_, " vertices and ", face_count_, " faces: at most ", limits.vertices,
                 " and ", limits.faces, " can be read");
  return {};
}

Status OffParser::vertex() {
  Vec3 position;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = next_word(&line_);
    if (word.empty())
      return error("a vertex needs 3 coordinates, this one has ", k);
    HC_TRY(parse_coordinate(path_, lines_.number(), word, &position[k]));
  }
  if (!next_word(&line_).empty())
    ++more_than_a_vertex_;
  return mesh_.vertices.push_back(position);
}

Status OffParser::face() {
  const std::string_view length = next_word(&line_);
  std::int64_t count = 0;
  if (!parse_integer(length, &count))
    return error("a face begins with the number of its corners, not ", in_quotes(length));
  if (count < 3)
    return error("a face needs 3 corners or more, this one has ", count);
  for (std::int64_t k = 0; k < count; ++k) {
    const std::string_view word = next_word(&line_);
    if (word.empty())
      return error("the face should have ", count, " corners, but has ", k);
    std::int64_t index = 0;
    if (!parse_integer(word, &index))
      return error("vertex index ", in_quotes(word), " is not an integer");
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
      return error("vertex index ", index, ": the file has ", vertex_count_,
                   " vertices, counted from 0");
    HC_TRY(mesh_.corners.push_back(static_cast<std::uint32_t>(index)));
  }
  if (!next_word(&line_).empty())
    ++more_than_a_face_;
  HC_TRY(mesh_.corner_offsets.push_back(mesh_.corners.size()));
  HC_TRY(mesh_.face_material.push_back(0));
  return mesh_.face_group.push_back(0);
}

void OffParser::count_skipped(ReadReport* report) const {
  if (more_than_a_vertex_ != 0)
    report->skipped["vertex colours, normals or texture coordinates"] += more_than_a_vertex_;
  if (more_than_a_face_ != 0)
    report->skipped["face colours"] += more_than_a_face_;
}

} // namespace

Status read_off(const std::string& path, FileMesh* mesh, ReadReport* report) {
  return without_exceptions(path, [&]() -> Status {
    *mesh = {};
    std::string text;
    HC_TRY(read_file(path, &text));
    report->add_file(path);
    HC_TRY(check_is_text(text, path, "a text OFF file"));
    OffParser parser(text, path, mesh);
    HC_TRY(parser.parse());
    parser.count_skipped(report);
    mesh->materials = {{}};
    mesh->groups = {{}};
    return {};
  });
}

} // namespace hemicube::radiosity
