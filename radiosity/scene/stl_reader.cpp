#include "radiosity/scene/stl_reader.h"

#include "radiosity/scene/text_cursor.h"

#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

namespace hemicube::radiosity {
namespace {

constexpr std::size_t kTitle = 80;        // bytes before the count of a binary file
constexpr std::size_t kHead = kTitle + 4; // bytes before its first triangle
constexpr std::size_t kTriangle = 50;     // normal, three vertices, two bytes of attributes

std::uint32_t load_u32(const char* bytes) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k)
    value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

std::uint64_t triangle_count(std::string_view binary) {
  return load_u32(binary.data() + kTitle);
}

/// How many bytes a binary file should have, by its own count.
std::uint64_t binary_size(std::string_view binary) {
  return kHead + triangle_count(binary) * kTriangle;
}

/// Puts triangles with vertices of their own into a mesh.
class Triangles {
public:
  explicit Triangles(FileMesh* mesh) : mesh_(*mesh) {}

  Status begin() { return mesh_.corner_offsets.push_back(0); }

  Status add_corner(const Vec3& position) {
    HC_TRY(mesh_.corners.push_back(static_cast<std::uint32_t>(mesh_.vertices.size())));
    return mesh_.vertices.push_back(position);
  }

  Status close() {
    HC_TRY(mesh_.corner_offsets.push_back(mesh_.corners.size()));
    HC_TRY(mesh_.face_material.push_back(0));
    return mesh_.face_group.push_back(static_cast<std::uint32_t>(mesh_.groups.size() - 1));
  }

  /// Whether three more vertices still have numbers.
  bool has_room() const { return mesh_.vertices.size() + 3 <= MeshLimits().vertices; }

private:
  FileMesh& mesh_;
};

constexpr std::string_view kTooMany = "too many triangles: split the scene into several runs";

Status read_binary(std::string_view bytes, const std::string& path, FileMesh* mesh) {
  if (bytes.size() < kHead)
    return Status::error(StatusCode::kBadScene, path, ": this is no STL file: ", bytes.size(),
                         " bytes, and no 'solid' at the beginning");
  const std::uint64_t count = triangle_count(bytes);
  if (bytes.size() != binary_size(bytes))
    return Status::error(StatusCode::kBadScene, path, ": the file says ", count,
                         " triangles, which are ", binary_size(bytes), " bytes, but it has ",
                         bytes.size());
  mesh->groups = {{}};
  Triangles triangles(mesh);
  HC_TRY(triangles.begin());
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!triangles.has_room())
      return Status::error(StatusCode::kBadScene, path, ": ", kTooMany);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = kHead + i * kTriangle + 12 * (corner + 1);
      Vec3 position;
      for (std::size_t k = 0; k < 3; ++k) {
        const float value = std::bit_cast<float>(load_u32(bytes.data() + at + 4 * k));
        if (!std::isfinite(value))
          return Status::error(StatusCode::kBadScene, path, ": byte ", at + 4 * k,
                               ": vertex coordinate ", value, " is not a finite number");
        position[static_cast<int>(k)] = static_cast<double>(value);
      }
      HC_TRY(triangles.add_corner(position));
    }
    HC_TRY(triangles.close());
  }
  return {};
}

bool is_keyword(std::string_view word, std::string_view keyword) {
  return word.size() == keyword.size() && has_extension(word, keyword); // in any case
}

/// Lines in a fixed order; keywords in any case.
class StlText {
public:
  StlText(std::string_view text, const std::string& path, FileMesh* mesh)
      : lines_(text), path_(path), mesh_(*mesh), triangles_(mesh) {}

  Status parse();

private:
  bool next_line();
  bool take(std::string_view keyword);
  Status expect(std::string_view keywords);
  Status vertex();
  Status facet();

  template <typename... Parts> Status error(const Parts&... parts) const {
    return error_at(path_, lines_.number(), parts...);
  }

  LineReader lines_;
  const std::string& path_;
  FileMesh& mesh_;
  Triangles triangles_;
  std::string_view line_; ///< what is left of the current line
  FileMesh::Name name_;   ///< of the solid
  bool name_is_used_ = false;
};

bool StlText::next_line() {
  const bool there_is_one = lines_.next_with_words();
  line_ = there_is_one ? lines_.line() : std::string_view();
  return there_is_one;
}

/// Takes a keyword off the front of the line if it is there.
bool StlText::take(std::string_view keyword) {
  std::string_view rest = line_;
  const std::string_view word = next_word(&rest);
  if (!is_keyword(word, keyword))
    return false;
  line_ = rest;
  return true;
}

/// Moves to the next line, which must begin with these keywords.
Status StlText::expect(std::string_view keywords) {
  if (!next_line())
    return Status::error(StatusCode::kBadScene, path_, ": the file ends where '", keywords,
                         "' should follow");
  const std::string_view line = line_;
  for (std::string_view rest = keywords, word = next_word(&rest); !word.empty();
       word = next_word(&rest))
    if (!take(word))
      return error("the line should begin with '", keywords, "': ", in_quotes(rest_as_name(line)));
  return {};
}

Status StlText::parse() {
  HC_TRY(triangles_.begin());
  HC_TRY(expect("solid"));
  do {
    name_ = {std::string(rest_as_name(line_)), lines_.number()};
    name_is_used_ = false;
    for (;;) {
      if (!next_line())
        return Status::error(StatusCode::kBadScene, path_, ": the file ends before 'endsolid'");
      if (take("endsolid"))
        break;
      HC_TRY(facet());
    }
    if (!next_line())
      return {};
  } while (take("solid"));
  return error("the line should begin with 'solid': ", in_quotes(rest_as_name(line_)));
}

/// From its first line, which is the current one.
Status StlText::facet() {
  if (!take("facet"))
    return error("the line should begin with 'facet' or 'endsolid': ",
                 in_quotes(rest_as_name(line_)));
  if (!triangles_.has_room())
    return error(kTooMany);
  if (!std::exchange(name_is_used_, true))
    mesh_.groups.push_back(name_);
  HC_TRY(expect("outer loop"));
  for (int corner = 0; corner < 3; ++corner)
    HC_TRY(vertex());
  HC_TRY(expect("endloop"));
  HC_TRY(expect("endfacet"));
  return triangles_.close();
}

Status StlText::vertex() {
  HC_TRY(expect("vertex"));
  Vec3 position;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = next_word(&line_);
    if (word.empty())
      return error("a vertex needs 3 coordinates, this one has ", k);
    HC_TRY(parse_coordinate(path_, lines_.number(), word, &position[k]));
  }
  return triangles_.add_corner(position);
}

/// Binary files may begin with 'solid' too.
bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHead && bytes.size() == binary_size(bytes))
    return false;
  LineReader lines(bytes);
  if (!lines.next_with_words())
    return false;
  std::string_view line = lines.line();
  return is_keyword(next_word(&line), "solid");
}

} // namespace

Status read_stl(const std::string& path, FileMesh* mesh, ReadReport* report) {
  return without_exceptions(path, [&]() -> Status {
    *mesh = {};
    std::string bytes;
    HC_TRY(read_file(path, &bytes));
    report->add_file(path);
    if (is_text(bytes)) {
      HC_TRY(
          check_is_text(bytes, path, "a text STL file, and its size is not that of a binary one"));
      HC_TRY(StlText(bytes, path, mesh).parse());
    } else {
      HC_TRY(read_binary(bytes, path, mesh));
    }
    if (mesh->face_count() == 0)
      return Status::error(StatusCode::kBadScene, path, ": the scene has no faces");
    mesh->materials = {{}};
    return {};
  });
}

} // namespace hemicube::radiosity
