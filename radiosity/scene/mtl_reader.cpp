#include "radiosity/scene/mtl_reader.h"

#include "radiosity/scene/text_cursor.h"

#include <filesystem>
#include <set>
#include <string_view>

namespace hemicube::radiosity {
namespace {

class MtlParser {
public:
  MtlParser(const std::string& path, MtlLibrary* library) : path_(path), library_(*library) {}

  Status parse(std::string_view text);
  void count_skipped(ReadReport* report) const;

private:
  Status statement(std::string_view keyword, std::string_view rest);
  Status new_material(std::string_view rest);
  Status colour(std::string_view what, std::string_view rest, std::array<double, 3>* value,
                std::uint64_t* given_on);
  Status channel(std::string_view what, std::string_view word, double* value) const;

  template <typename... Parts> Status error(const Parts&... parts) const {
    return error_at(path_, line_, parts...);
  }

  const std::string& path_;
  MtlLibrary& library_;
  std::uint64_t line_ = 0;
  MtlLibrary::value_type* material_ = nullptr; // the current one; map entries stay where they are
  KeywordCounts skipped_;
};

constexpr std::string_view kReflectance = "reflectance (Kd)";
constexpr std::string_view kExitance = "exitance (Ke)";

Status MtlParser::parse(std::string_view text) {
  LineReader lines(text);
  while (lines.next()) {
    line_ = lines.number();
    std::string_view rest = lines.line();
    const std::string_view keyword = next_word(&rest);
    if (!keyword.empty())
      HC_TRY(statement(keyword, rest));
  }
  return {};
}

Status MtlParser::statement(std::string_view keyword, std::string_view rest) {
  if (keyword == "newmtl")
    return new_material(rest);
  if (keyword != "Kd" && keyword != "Ke") {
    skipped_.count(keyword);
    return {};
  }
  if (material_ == nullptr)
    return error(keyword, " before the first newmtl");
  MtlMaterial& material = material_->second;
  if (keyword == "Kd")
    return colour(kReflectance, rest, &material.reflectance, &material.reflectance_line);
  return colour(kExitance, rest, &material.exitance, &material.exitance_line);
}

Status MtlParser::new_material(std::string_view rest) {
  const std::string name(rest_as_name(rest));
  if (name.empty())
    return error("newmtl without a name");
  const auto [entry, is_new] = library_.try_emplace(name);
  if (!is_new)
    return error("material ", in_quotes(name), " is defined twice, first at ", entry->second.file,
                 ":", entry->second.line);
  material_ = &*entry;
  entry->second.file = path_;
  entry->second.line = line_;
  return {};
}

/// One value means all three bands.
Status MtlParser::colour(std::string_view what, std::string_view rest, std::array<double, 3>* value,
                         std::uint64_t* given_on) {
  const std::string material = in_quotes(material_->first);
  if (*given_on != 0)
    return error("material ", material, ": ", what, " is given twice, first on line ", *given_on);
  *given_on = line_;
  std::size_t count = 0;
  for (std::string_view word = next_word(&rest); !word.empty(); word = next_word(&rest), ++count) {
    if (count == 0 && (word == "spectral" || word == "xyz"))
      return error("material ", material, ": ", what, " is given as ", word,
                   "; only r g b values are read");
    if (count < 3)
      HC_TRY(channel(what, word, &(*value)[count]));
  }
  if (count == 1)
    (*value)[1] = (*value)[2] = (*value)[0];
  else if (count != 3)
    return error("material ", material, ": ", what, " takes 1 value or 3, not ", count);
  return {};
}

Status MtlParser::channel(std::string_view what, std::string_view word, double* value) const {
  const std::string material = in_quotes(material_->first);
  const NumberForm form = parse_number(word, value);
  if (form == NumberForm::kNotANumber)
    return error("material ", material, ": ", what, " ", in_quotes(word), " is not a number");
  if (form == NumberForm::kNotFinite)
    return error("material ", material, ": ", what, " ", in_quotes(word),
                 " is not a finite number");
  if (*value < 0 && what == kExitance)
    return error("material ", material, ": ", what, " ", *value, " is negative");
  if ((*value < 0 || *value > 1) && what == kReflectance)
    return error("material ", material, ": ", what, " ", *value, " is outside [0, 1]");
  return {};
}

/// What a statement that is read over would have said.
std::string_view meaning(std::string_view keyword) {
  static const std::map<std::string_view, std::string_view> kMeanings = {
      {"Ka", "ambient colours"},
      {"Ks", "specular colours"},
      {"Ns", "specular exponents"},
      {"d", "transparency"},
      {"Tr", "transparency"},
      {"Tf", "transmission filters"},
      {"Ni", "indices of refraction"},
      {"illum", "illumination models"},
      {"bump", "textures"},
      {"disp", "textures"},
      {"decal", "textures"},
      {"refl", "textures"},
      {"norm", "textures"},
  };
  if (keyword.starts_with("map_"))
    return "textures";
  const auto entry = kMeanings.find(keyword);
  return entry == kMeanings.end() ? "other material statements" : entry->second;
}

void MtlParser::count_skipped(ReadReport* report) const {
  skipped_.add_to(report, meaning);
}

/// The libraries one mtllib statement names, as paths of files.
Status find_libraries(const std::string& obj_path, const FileMesh::Name& statement,
                      std::vector<std::string>* paths) {
  const auto resolved = [&](std::string_view name) {
    return (std::filesystem::path(obj_path).parent_path() / name).lexically_normal().string();
  };
  const std::string whole = resolved(statement.text);
  if (why_no_file(whole).empty()) {
    paths->push_back(whole);
    return {};
  }
  std::string_view rest = statement.text;
  std::string_view word = next_word(&rest);
  do {
    paths->push_back(word.empty() ? whole : resolved(word));
    if (const std::string why = why_no_file(paths->back()); !why.empty())
      return error_at(obj_path, statement.line, "material library ",
                      in_quotes(word.empty() ? statement.text : word), why, " (looked for ",
                      paths->back(), ")");
    word = next_word(&rest);
  } while (!word.empty());
  return {};
}

} // namespace

Status read_mtl(const std::string& path, MtlLibrary* library, ReadReport* report) {
  return without_exceptions(path, [&]() -> Status {
    std::string text;
    HC_TRY(read_file(path, &text));
    report->add_file(path);
    HC_TRY(check_is_text(text, path, "an MTL file"));
    MtlParser parser(path, library);
    HC_TRY(parser.parse(text));
    parser.count_skipped(report);
    return {};
  });
}

Status read_libraries(const std::string& obj_path, const FileMesh& mesh, MtlLibrary* library,
                      ReadReport* report) {
  return without_exceptions(obj_path, [&]() -> Status {
    std::set<std::string> read; // a library may be named more than once
    for (const FileMesh::Name& statement : mesh.libraries) {
      std::vector<std::string> paths;
      HC_TRY(find_libraries(obj_path, statement, &paths));
      for (const std::string& path : paths)
        if (read.insert(path).second)
          HC_TRY(read_mtl(path, library, report));
    }
    return {};
  });
}

} // namespace hemicube::radiosity
