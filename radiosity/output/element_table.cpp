#include "radiosity/output/element_table.h"

#include "radiosity/output/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace hemicube::radiosity {
namespace {

constexpr const char* kHead = "patch,path\n";
constexpr const char* kAdvice = "; solve the scene again";

std::string line(std::uint32_t patch, const std::string& path) {
  return std::to_string(patch) + "," + path + "\n";
}

/// Reads a number that ends the text or is followed by `end`, and drops both from the text.
bool take_number(std::string_view* text, char end, std::uint32_t* number) {
  const auto [after, error] = std::from_chars(text->data(), text->data() + text->size(), *number);
  if (error != std::errc())
    return false;
  text->remove_prefix(static_cast<std::size_t>(after - text->data()));
  if (text->empty())
    return true;
  if (text->front() != end || text->size() == 1)
    return false;
  text->remove_prefix(1);
  return true;
}

/// Cuts a patch as far as the path of one of its elements says.
/// @return false if it cannot be cut that way
bool follow(std::string_view path, std::uint32_t patch, ElementTree* tree) {
  std::uint32_t node = patch;
  while (!path.empty()) {
    std::uint32_t piece = 0;
    if (!take_number(&path, '.', &piece))
      return false;
    if (tree->is_leaf(node)) {
      if (tree->pieces_of(node, 0) == 0)
        return false;
      tree->split(node);
    }
    if (piece >= tree->child_count(node))
      return false;
    node = tree->child(node, piece);
  }
  return tree->is_leaf(node);
}

} // namespace

std::string element_table(const ElementTree& tree) {
  std::string text = kHead;
  for (const std::uint32_t leaf : tree.leaves()) {
    std::string path;
    for (std::uint32_t node = leaf; tree.parent(node) != ElementTree::kNone;
         node = tree.parent(node))
      path.insert(0, std::to_string(node - tree.child(tree.parent(node), 0)) +
                         (path.empty() ? "" : "."));
    text += line(tree.patch_of(leaf), path);
  }
  return text;
}

Status read_element_table(std::string_view text, const std::string& path, ElementTree* tree) {
  CsvReader reader(text);
  std::vector<std::string> fields;
  const auto refuse = [&](const auto&... what) {
    return Status::error(StatusCode::kBadScene, path, ":",
                         std::max<std::uint64_t>(reader.line(), 1), ": ", what..., kAdvice);
  };
  if (!reader.next(&fields) || fields != std::vector<std::string>{"patch", "path"})
    return refuse("the first line is not patch,path");
  const auto patches = static_cast<std::uint32_t>(tree->node_count());
  std::string read = kHead;
  while (reader.next(&fields)) {
    std::uint32_t patch = 0;
    std::string_view number = fields[0];
    if (fields.size() != 2 || !take_number(&number, '\0', &patch) || patch >= patches)
      return refuse("'", fields[0], "' is no patch of the scene, which has ", patches);
    if (!follow(fields[1], patch, tree))
      return refuse("patch ", patch, " has no element '", fields[1], "'");
    read += line(patch, fields[1]);
  }
  if (!text.ends_with('\n')) // a last line of an element may become that of its patch
    return refuse("the line is cut off");
  if (element_table(*tree) != read)
    return refuse("elements are missing, named twice or out of order");
  return {};
}

} // namespace hemicube::radiosity
