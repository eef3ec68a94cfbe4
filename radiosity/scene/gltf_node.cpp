#include "radiosity/scene/gltf_node.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;
using Rows = std::array<double, 12>; // of an affine map, as in Placement

constexpr Rows kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// First b, then a.
Rows product(const Rows& a, const Rows& b) {
  Rows c{};
  for (std::size_t row = 0; row < 12; row += 4)
    for (std::size_t column = 0; column < 4; ++column)
      c[row + column] = a[row] * b[column] + a[row + 1] * b[4 + column] +
                        a[row + 2] * b[8 + column] + (column == 3 ? a[row + 3] : 0);
  return c;
}

class NodeLister {
public:
  NodeLister(const GltfFile& file, std::vector<GltfNode>* nodes)
      : file_(file), fields_(file.fields()), nodes_(*nodes) {}

  Status list();

private:
  /// A node that is still to be listed.
  struct Pending {
    GltfFile::Item item;
    Rows parent;
  };

  Status find_scene(GltfFile::Item* scene) const;
  Status push_children(const JsonValue& value, const std::string& what, const char* key,
                       const Rows& parent);
  Status transform(const JsonValue& value, const std::string& what, Rows* rows) const;
  Status matrix(const JsonValue& value, const std::string& what, Rows* rows) const;
  Status translation_rotation_scale(const JsonValue& node, const std::string& what,
                                    Rows* rows) const;
  Status numbers(const JsonValue& node, const std::string& what, const char* key,
                 std::vector<double>* values) const;

  const GltfFile& file_;
  const JsonFields& fields_;
  std::vector<GltfNode>& nodes_;
  std::vector<Pending> pending_; // the next one last: files may nest deeper than calls can
  std::vector<bool> is_reached_;
};

Status NodeLister::list() {
  std::size_t count = 0;
  HC_TRY(file_.count("nodes", &count));
  is_reached_.resize(count);
  GltfFile::Item scene;
  HC_TRY(find_scene(&scene));
  HC_TRY(push_children(*scene.value, scene.what, "nodes", kIdentity));
  while (!pending_.empty()) {
    const Pending next = std::move(pending_.back());
    pending_.pop_back();
    GltfNode node{next.item.value, next.item.what, next.item.index, {}};
    Rows own = kIdentity;
    HC_TRY(transform(*node.value, node.what, &own));
    node.placement.has_transform = true;
    node.placement.rows = product(next.parent, own);
    HC_TRY(push_children(*node.value, node.what, "children", node.placement.rows));
    nodes_.push_back(std::move(node));
  }
  return {};
}

Status NodeLister::find_scene(GltfFile::Item* scene) const {
  std::size_t count = 0;
  HC_TRY(file_.count("scenes", &count));
  if (count == 0)
    return Status::error(StatusCode::kBadScene, fields_.path(),
                         ": the file has no scenes: nothing is placed");
  JsonValue first;
  first.kind = Kind::kNumber;
  const JsonValue* chosen = file_.root().find("scene");
  return file_.follow(chosen == nullptr ? first : *chosen, "scene", "scenes", scene);
}

/// Puts the nodes that an array names on the stack, the first on top.
Status NodeLister::push_children(const JsonValue& value, const std::string& what, const char* key,
                                 const Rows& parent) {
  const JsonValue* children = value.find(key);
  if (children == nullptr)
    return {};
  const std::string list = what + "." + key;
  HC_TRY(fields_.kind(*children, list, Kind::kArray));
  for (std::size_t i = children->items.size(); i-- > 0;) {
    GltfFile::Item item;
    const std::string place = list + "[" + std::to_string(i) + "]";
    HC_TRY(file_.follow(children->items[i], place, "nodes", &item));
    if (is_reached_[item.index])
      return fields_.error(children->items[i], place, ": ", item.what,
                           " is reached twice: a node has one parent, and is not above itself");
    is_reached_[item.index] = true;
    pending_.push_back({std::move(item), parent});
  }
  return {};
}

Status NodeLister::transform(const JsonValue& value, const std::string& what, Rows* rows) const {
  const JsonValue* given = value.find("matrix");
  if (given == nullptr)
    return translation_rotation_scale(value, what, rows);
  for (const char* key : {"translation", "rotation", "scale"})
    if (value.find(key) != nullptr)
      return fields_.error(value, what, " has both matrix and ", key);
  return matrix(*given, what + ".matrix", rows);
}

/// Sixteen numbers, column by column.
Status NodeLister::matrix(const JsonValue& value, const std::string& what, Rows* rows) const {
  std::vector<double> m;
  HC_TRY(fields_.numbers(value, what, 16, &m));
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    return fields_.error(value, what, " must have the last row 0 0 0 1");
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      (*rows)[4 * row + column] = m[4 * column + row];
  return {};
}

/// An array of as many numbers as `values` has; they stay where the key is missing.
Status NodeLister::numbers(const JsonValue& node, const std::string& what, const char* key,
                           std::vector<double>* values) const {
  const JsonValue* value = node.find(key);
  return value == nullptr ? Status()
                          : fields_.numbers(*value, what + "." + key, values->size(), values);
}

Status NodeLister::translation_rotation_scale(const JsonValue& node, const std::string& what,
                                              Rows* rows) const {
  std::vector<double> t(3, 0.0), q = {0, 0, 0, 1}, s(3, 1.0);
  HC_TRY(numbers(node, what, "translation", &t));
  HC_TRY(numbers(node, what, "rotation", &q));
  HC_TRY(numbers(node, what, "scale", &s));
  const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(squared > 0.99 && squared < 1.01))
    return fields_.error(node, what, ".rotation must be of length 1, not ", std::sqrt(squared));
  const double length = std::sqrt(squared);
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  *rows = {(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1],
           2 * (x * z + y * w) * s[2],       t[0],
           2 * (x * y + z * w) * s[0],       (1 - 2 * (x * x + z * z)) * s[1],
           2 * (y * z - x * w) * s[2],       t[1],
           2 * (x * z - y * w) * s[0],       2 * (y * z + x * w) * s[1],
           (1 - 2 * (x * x + y * y)) * s[2], t[2]};
  return {};
}

} // namespace

Status list_nodes(const GltfFile& file, std::vector<GltfNode>* nodes) {
  return NodeLister(file, nodes).list();
}

} // namespace hemicube::radiosity
