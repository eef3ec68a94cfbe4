#include "radiosity/refine/element_tree.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/polygon_shape.h"

#include <algorithm>
#include <functional>

namespace hemicube::radiosity {
namespace {

/// A quad this much longer than wide is cut across its length only.
constexpr double kLong = 1.5;
/// Square metres, many times more than an area whose square is 0 in double precision.
constexpr double kSmallestArea = 0x1p-500;

} // namespace

Status ElementTree::init(const Scene& scene, const PatchSet& patches) {
  *this = {};
  scene_ = &scene;
  patches_ = &patches;
  for (const Vec3& position : patches.vertices)
    add_vertex(position);
  for (std::uint32_t patch = 0; patch < patches.front_count; ++patch) {
    const auto from = patches.corners_of(patch);
    Node node{patch};
    node.first_corner = corners_.size();
    node.corner_count = static_cast<std::uint32_t>(from.size());
    corners_.insert(corners_.end(), from.begin(), from.end());
    nodes_.push_back(node);
  }
  element_count_ = patches.patch_count();
  return {};
}

std::uint32_t ElementTree::side_count(std::uint32_t node) const noexcept {
  return scene_->two_sided[patches_->material[nodes_[node].patch]] != 0 ? 2 : 1;
}

std::span<const std::uint32_t> ElementTree::corners(std::uint32_t node) const noexcept {
  return {corners_.data() + nodes_[node].first_corner, nodes_[node].corner_count};
}

const Vec3& ElementTree::point(std::uint32_t node, std::size_t corner) const noexcept {
  const auto all = corners(node);
  return vertices_[all[corner % all.size()]];
}

void ElementTree::corners_of(std::uint32_t node, std::vector<Vec3>* points) const {
  points->clear();
  for (std::size_t k = 0; k < nodes_[node].corner_count; ++k)
    points->push_back(point(node, k));
}

double ElementTree::edge_length(std::uint32_t node, std::size_t k) const noexcept {
  return glm::length(point(node, k + 1) - point(node, k));
}

ElementTree::Cut ElementTree::cut_of(std::uint32_t node) const noexcept {
  if (nodes_[node].corner_count != 4)
    return {};
  const double along_0 = std::max(edge_length(node, 0), edge_length(node, 2));
  const double along_1 = std::max(edge_length(node, 1), edge_length(node, 3));
  return {along_1 < kLong * along_0, along_0 < kLong * along_1};
}

std::uint32_t ElementTree::pieces_of(std::uint32_t leaf, double min_edge) const {
  const std::uint32_t count = nodes_[leaf].corner_count;
  const Cut cut = cut_of(leaf);
  std::vector<Vec3> points;
  corners_of(leaf, &points);
  for (std::size_t k = 0; k < count; ++k) {
    if (count == 4 && !(k % 2 == 0 ? cut.along_0 : cut.along_1))
      continue;
    const Vec3 &a = points[k], &b = points[(k + 1) % count];
    const Vec3 half = 0.5 * (a + b);
    // Halves that are too short, or no halves at all.
    if (glm::length(b - a) < 2 * min_edge || half == a || half == b)
      return 0;
  }
  // A piece has a corner of the polygon, or of a triangle is its middle: a quarter or more of the
  // smallest corner's area. What is resolved with 64 times the doubt is resolved after the cut.
  PolygonShape shape = measure_polygon(points);
  shape.resolution *= 64;
  if (shape.area < kSmallestArea || !has_area(points, shape))
    return 0;
  return count == 3 ? 4 : count == 4 ? (cut.along_0 && cut.along_1 ? 4 : 2) : count;
}

std::uint32_t ElementTree::middle(std::uint32_t a, std::uint32_t b) const {
  const std::uint64_t low = std::min(place_[a], place_[b]), high = std::max(place_[a], place_[b]);
  const auto found = middles_.find(low << 32 | high);
  return found != middles_.end() ? found->second : kNone;
}

std::uint32_t ElementTree::make_middle(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t low = std::min(place_[a], place_[b]), high = std::max(place_[a], place_[b]);
  const auto [at, is_new] = middles_.try_emplace(low << 32 | high, kNone);
  if (is_new)
    at->second = add_vertex(0.5 * (vertices_[a] + vertices_[b]));
  return at->second;
}

std::uint32_t ElementTree::make_centre(std::uint32_t node) {
  const std::size_t count = nodes_[node].corner_count;
  Vec3 sum(0, 0, 0); // relative to the first corner
  for (std::size_t k = 0; k < count; ++k)
    sum += point(node, k) - point(node, 0);
  return add_vertex(point(node, 0) + sum / static_cast<double>(count));
}

std::uint32_t ElementTree::add_vertex(const Vec3& position) {
  const auto number = static_cast<std::uint32_t>(vertices_.size());
  vertices_.push_back(position);
  place_.push_back(vertex_at_.try_emplace(position, number).first->second);
  return number;
}

std::size_t ElementTree::PositionHash::operator()(const Vec3& position) const noexcept {
  std::size_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) // of 0 and -0 the same
    hash = hash * 0x9e3779b97f4a7c15u + std::hash<double>()(position[axis]);
  return hash;
}

void ElementTree::add_child(std::uint32_t parent, std::initializer_list<std::uint32_t> corners) {
  Node node{nodes_[parent].patch, parent};
  node.first_corner = corners_.size();
  node.corner_count = static_cast<std::uint32_t>(corners.size());
  corners_.insert(corners_.end(), corners);
  nodes_.push_back(node);
  ++nodes_[parent].child_count;
}

void ElementTree::split(std::uint32_t leaf) {
  const Cut cut = cut_of(leaf);
  const std::vector<std::uint32_t> c(corners(leaf).begin(), corners(leaf).end());
  const std::size_t count = c.size();
  std::vector<std::uint32_t> m(count, kNone);
  for (std::size_t k = 0; k < count; ++k)
    if (count != 4 || (k % 2 == 0 ? cut.along_0 : cut.along_1))
      m[k] = make_middle(c[k], c[(k + 1) % count]);
  nodes_[leaf].first_child = static_cast<std::uint32_t>(nodes_.size());
  if (count == 3) {
    add_child(leaf, {c[0], m[0], m[2]});
    add_child(leaf, {m[0], c[1], m[1]});
    add_child(leaf, {m[2], m[1], c[2]});
    add_child(leaf, {m[1], m[2], m[0]});
  } else if (count == 4 && !cut.along_1) {
    add_child(leaf, {c[0], m[0], m[2], c[3]});
    add_child(leaf, {m[0], c[1], c[2], m[2]});
  } else if (count == 4 && !cut.along_0) {
    add_child(leaf, {c[0], c[1], m[1], m[3]});
    add_child(leaf, {m[3], m[1], c[2], c[3]});
  } else {
    // Each child of a quad begins with the direction of its first edge: item buffers of all are
    // turned alike.
    const std::uint32_t centre = make_centre(leaf);
    if (count == 4) {
      add_child(leaf, {c[0], m[0], centre, m[3]});
      add_child(leaf, {m[0], c[1], m[1], centre});
      add_child(leaf, {centre, m[1], c[2], m[2]});
      add_child(leaf, {m[3], centre, m[2], c[3]});
    } else {
      for (std::size_t k = 0; k < count; ++k)
        add_child(leaf, {c[k], m[k], centre, m[(k + count - 1) % count]});
    }
  }
  element_count_ += std::uint64_t{side_count(leaf)} * (nodes_[leaf].child_count - 1);
}

std::vector<std::uint32_t> ElementTree::leaves() const {
  std::vector<std::uint32_t> found, open;
  for (std::uint32_t patch = patches_->front_count; patch-- > 0;)
    open.push_back(patch);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    if (is_leaf(node))
      found.push_back(node);
    for (std::uint32_t k = child_count(node); k-- > 0;)
      open.push_back(child(node, k));
  }
  return found;
}

std::vector<std::uint32_t> ElementTree::uneven_leaves() const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t leaf : leaves()) {
    const auto c = corners(leaf);
    bool is_uneven = false;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % c.size()], m = middle(a, b);
      is_uneven = is_uneven || (m != kNone && (middle(a, m) != kNone || middle(m, b) != kNone));
    }
    if (is_uneven)
      found.push_back(leaf);
  }
  return found;
}

void ElementTree::append_hanging(std::uint32_t a, std::uint32_t b,
                                 std::vector<std::uint32_t>* corners) const {
  const std::uint32_t m = middle(a, b);
  if (m == kNone)
    return;
  append_hanging(a, m, corners);
  corners->push_back(m);
  append_hanging(m, b, corners);
}

Status ElementTree::make_mesh(PatchSet* elements) const {
  *elements = {};
  PatchSet& mesh = *elements;
  HC_TRY(check_mesh_size(element_count_, 0, vertices_.size(), "allow fewer elements"));
  HC_TRY(mesh.vertices.append(std::span<const Vec3>(vertices_)));
  HC_TRY(mesh.corner_offsets.push_back(0));
  std::vector<std::uint32_t> polygon;
  for (const std::uint32_t leaf : leaves()) {
    const auto c = corners(leaf);
    polygon.clear();
    for (std::size_t k = 0; k < c.size(); ++k) {
      polygon.push_back(c[k]);
      append_hanging(c[k], c[(k + 1) % c.size()], &polygon);
    }
    const std::uint32_t patch = nodes_[leaf].patch;
    HC_TRY(mesh.corners.append(std::span<const std::uint32_t>(polygon)));
    HC_TRY(check_mesh_size(0, mesh.corners.size(), 0, "allow fewer elements"));
    HC_TRY(mesh.corner_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size())));
    HC_TRY(mesh.face.push_back(patches_->face[patch]));
    HC_TRY(mesh.parent.push_back(patch));
    HC_TRY(mesh.material.push_back(patches_->material[patch]));
    HC_TRY(mesh.group.push_back(patches_->group[patch]));
  }
  HC_TRY(measure_patches(elements));
  return add_back_sides(*scene_, elements);
}

} // namespace hemicube::radiosity
