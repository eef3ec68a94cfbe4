#include "radiosity/scene/ply_header.h"

#include "radiosity/scene/text_cursor.h"

#include <algorithm>
#include <utility>

namespace hemicube::radiosity {
namespace {

constexpr std::size_t kMostElements = 256; // compared with each other

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr TypeName kTypes[] = {
    {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64}};

class HeaderParser {
public:
  HeaderParser(std::string_view bytes, std::string_view path, PlyHeader* header)
      : rest_(bytes), path_(path), header_(*header) {}

  Status parse();

private:
  bool next_line(std::string_view* line);
  Status statement(std::string_view keyword, std::string_view rest);
  Status format(std::string_view rest);
  Status element(std::string_view rest);
  Status property(std::string_view rest);
  Status type(std::string_view word, PlyType* type) const;

  template <typename... Parts> Status error(const Parts&... parts) const {
    return error_at(path_, header_.line_count, parts...);
  }

  std::string_view rest_;
  std::string_view path_;
  PlyHeader& header_;
  char line_end_ = '\n';
  bool has_format_ = false;
};

/// Takes a line as the first one ends: behind a lone CR, an LF is a byte of the first value.
bool HeaderParser::next_line(std::string_view* line) {
  const std::size_t end = rest_.find(line_end_);
  if (end == std::string_view::npos)
    return false;
  *line = rest_.substr(0, end);
  rest_.remove_prefix(end + 1);
  if (line->ends_with('\r'))
    line->remove_suffix(1);
  ++header_.line_count;
  return true;
}

Status HeaderParser::parse() {
  const std::size_t size = rest_.size();
  if (rest_.starts_with("ply\r") && !rest_.starts_with("ply\r\n"))
    line_end_ = '\r';
  std::string_view line;
  if (!next_line(&line) || line != "ply")
    return error_at(path_, 1, "this is no PLY file: its first line is not 'ply'");
  while (next_line(&line)) {
    const std::string_view keyword = next_word(&line);
    if (keyword == "end_header") {
      header_.size = size - rest_.size();
      return has_format_ ? Status() : error("the header has no format");
    }
    HC_TRY(statement(keyword, line));
  }
  return error_at(path_, header_.line_count, "the header breaks off: there is no end_header");
}

Status HeaderParser::statement(std::string_view keyword, std::string_view rest) {
  if (keyword == "comment" || keyword == "obj_info")
    return {};
  if (keyword == "format")
    return format(rest);
  if (keyword == "element")
    return element(rest);
  if (keyword == "property")
    return property(rest);
  return error(in_quotes(keyword), " is no statement of a PLY header");
}

Status HeaderParser::format(std::string_view rest) {
  using Encoding = PlyHeader::Encoding;
  constexpr std::pair<std::string_view, Encoding> kEncodings[] = {
      {"ascii", Encoding::kText},
      {"binary_little_endian", Encoding::kLittleEndian},
      {"binary_big_endian", Encoding::kBigEndian}};
  const std::string_view name = next_word(&rest);
  const std::string_view version = next_word(&rest);
  const auto known = std::find_if(std::begin(kEncodings), std::end(kEncodings),
                                  [&](const auto& entry) { return entry.first == name; });
  if (known == std::end(kEncodings))
    return error("format ", in_quotes(name),
                 " is not known; known are ascii, binary_little_endian, binary_big_endian");
  if (version != "1.0")
    return error("version ", in_quotes(version), " is not known; this program reads 1.0");
  if (std::exchange(has_format_, true))
    return error("the format is given twice");
  header_.encoding = known->second;
  return {};
}

Status HeaderParser::element(std::string_view rest) {
  PlyElement element;
  element.name = next_word(&rest);
  element.line = header_.line_count;
  const std::string_view word = next_word(&rest);
  std::int64_t count = 0;
  if (element.name.empty() || !parse_integer(word, &count) || count < 0)
    return error("element ", in_quotes(element.name), " has no valid count: ", in_quotes(word));
  if (header_.elements.size() == kMostElements)
    return error("more than ", kMostElements, " elements");
  for (const PlyElement& other : header_.elements)
    if (other.name == element.name)
      return error("element ", in_quotes(element.name), " is declared twice, first on line ",
                   other.line);
  element.count = static_cast<std::uint64_t>(count);
  header_.elements.push_back(std::move(element));
  return {};
}

Status HeaderParser::property(std::string_view rest) {
  if (header_.elements.empty())
    return error("a property comes before any element");
  PlyProperty property;
  std::string_view word = next_word(&rest);
  property.is_list = word == "list";
  if (property.is_list) {
    HC_TRY(type(next_word(&rest), &property.count_type));
    if (!is_integer(property.count_type))
      return error("the length of a list must be of an integer type");
    word = next_word(&rest);
  }
  HC_TRY(type(word, &property.type));
  property.name = next_word(&rest);
  if (property.name.empty())
    return error("property without a name");
  header_.elements.back().properties.push_back(std::move(property));
  return {};
}

Status HeaderParser::type(std::string_view word, PlyType* type) const {
  for (const TypeName& known : kTypes)
    if (known.name == word) {
      *type = known.type;
      return {};
    }
  return error("type ", in_quotes(word),
               " is not known; known are char, uchar, short, ushort, int, uint, float, double");
}

} // namespace

std::size_t byte_count(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) {
  return type != PlyType::kFloat32 && type != PlyType::kFloat64;
}

Status parse_ply_header(std::string_view bytes, const std::string& path, PlyHeader* header) {
  *header = {};
  return HeaderParser(bytes, path, header).parse();
}

} // namespace hemicube::radiosity
