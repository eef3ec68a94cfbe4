#include "radiosity/refine/element_tree.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/polygon_shape.h"
#include "radiosity/mesh/straight_corners.h"

#include <algorithm>
#include <cmath>

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
    vertices_.add_vertex(position);
  first_own_vertex_ = vertices_.vertex_count();
  Buffer<std::uint8_t> is_straight;
  HC_TRY(find_straight_corners(patches, &is_straight));
  for (std::uint32_t patch = 0; patch < patches.front_count; ++patch)
    add_patch(patch, is_straight.span().subspan(patches.corner_offsets[patch],
                                                patches.corners_of(patch).size()));
  element_count_ = patches.patch_count();
  return {};
}

/// Makes a patch a node. Its straight corners are hanging vertices, as those of refinement are.
void ElementTree::add_patch(std::uint32_t patch, std::span<const std::uint8_t> is_straight) {
  const auto from = patches_->corners_of(patch);
  const std::size_t count = from.size();
  Node node{patch};
  node.first_corner = corners_.size();
  for (std::size_t k = 0; k < count;) {
    std::size_t next = k + 1; // the first corner stays one
    if (is_straight[0] == 0)
      while (next < count && is_straight[next] != 0)
        ++next;
    corners_.push_back(from[k]);
    std::vector<std::uint32_t> side(from.begin() + static_cast<std::ptrdiff_t>(k),
                                    from.begin() + static_cast<std::ptrdiff_t>(next));
    side.push_back(from[next % count]);
    hang(side);
    k = next;
  }
  for (std::size_t k = 0; k < count; ++k)
    vertices_.note_light(from[k], from[(k + 1) % count],
                         patches_->light_across(patches_->corner_offsets[patch] + k));
  node.corner_count = static_cast<std::uint32_t>(corners_.size() - node.first_corner);
  nodes_.push_back(node);
}

/// Notes the vertices between the ends of a side, the one nearest to its middle first: the same
/// from both sides.
void ElementTree::hang(std::span<const std::uint32_t> side) {
  if (side.size() < 3)
    return;
  const Vec3 &a = vertices_[side.front()], &b = vertices_[side.back()];
  const auto off_middle = [&](std::uint32_t vertex) {
    return std::fabs(glm::length(vertices_[vertex] - a) - glm::length(b - vertices_[vertex]));
  };
  std::size_t best = 1;
  for (std::size_t k = 2; k + 1 < side.size(); ++k) {
    const double here = off_middle(side[k]), there = off_middle(side[best]);
    if (here < there || (here == there && vertices_.place(side[k]) < vertices_.place(side[best])))
      best = k;
  }
  vertices_.set_split(side.front(), side.back(), side[best]);
  hang(side.first(best + 1));
  hang(side.subspan(best));
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
  double least = 0.5; // of an edge that is left of it
  for (std::size_t k = 0; k < count; ++k) {
    if (count == 4 && !(k % 2 == 0 ? cut.along_0 : cut.along_1))
      continue;
    const Vec3 &a = points[k], &b = points[(k + 1) % count];
    const std::uint32_t hanging = vertices_.split(corners(leaf)[k], corners(leaf)[(k + 1) % count]);
    const Vec3 half = 0.5 * (a + b);
    const double length = glm::length(b - a);
    // Halves that are too short, or no halves at all.
    if (length < 2 * min_edge || half == a || half == b)
      return 0;
    if (hanging != kNone && hanging < first_own_vertex_)
      least = std::min({least, glm::length(vertices_[hanging] - a) / length,
                        glm::length(b - vertices_[hanging]) / length});
  }
  // A piece has a corner of the polygon, or of a triangle is its middle: a quarter or more of the
  // smallest corner's area where edges are halved. What is resolved with 64 times the doubt is
  // resolved after the cut.
  PolygonShape shape = measure_polygon(points);
  shape.resolution *= 16 / (least * least);
  if (shape.area < kSmallestArea || !has_area(points, shape))
    return 0;
  return count == 3 ? 4 : count == 4 ? (cut.along_0 && cut.along_1 ? 4 : 2) : count;
}

std::uint32_t ElementTree::make_middle(std::uint32_t a, std::uint32_t b) {
  std::uint32_t middle = vertices_.split(a, b);
  if (middle == kNone) {
    middle = vertices_.add_vertex(0.5 * (vertices_[a] + vertices_[b]));
    vertices_.set_split(a, b, middle);
    const EdgeLight light = vertices_.light_across(a, b);
    vertices_.note_light(a, middle, light);
    vertices_.note_light(middle, b, light);
  }
  return middle;
}

/// The mean of the corners of a node, which is that of the middles of its edges, too. Where edges
/// are not cut in the middle, only the latter leaves convex pieces.
std::uint32_t ElementTree::make_centre(std::uint32_t node, std::span<const std::uint32_t> middles) {
  const std::size_t count = nodes_[node].corner_count;
  bool are_halves = true;
  for (std::size_t k = 0; k < count; ++k)
    are_halves = are_halves && vertices_[middles[k]] == 0.5 * (point(node, k) + point(node, k + 1));
  Vec3 sum(0, 0, 0); // relative to the first corner
  for (std::size_t k = 0; k < count; ++k)
    sum += (are_halves ? point(node, k) : vertices_[middles[k]]) - point(node, 0);
  return vertices_.add_vertex(point(node, 0) + sum / static_cast<double>(count));
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
    const std::uint32_t centre = make_centre(leaf, m);
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
    for (std::size_t k = 0; k < c.size(); ++k)
      is_uneven = is_uneven || is_uneven_edge(c[k], c[(k + 1) % c.size()]);
    if (is_uneven)
      found.push_back(leaf);
  }
  return found;
}

bool ElementTree::is_uneven_edge(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t m = vertices_.split(a, b);
  if (m == kNone)
    return false;
  if (m < first_own_vertex_) // the patch has had it from the beginning
    return is_uneven_edge(a, m) || is_uneven_edge(m, b);
  return vertices_.split(a, m) != kNone || vertices_.split(m, b) != kNone;
}

Status ElementTree::make_mesh(PatchSet* elements) const {
  *elements = {};
  PatchSet& mesh = *elements;
  HC_TRY(check_mesh_size(element_count_, 0, vertices_.vertex_count(), "allow fewer elements"));
  HC_TRY(mesh.vertices.append(std::span<const Vec3>(vertices_.positions())));
  HC_TRY(mesh.corner_offsets.push_back(0));
  std::vector<std::uint32_t> polygon;
  for (const std::uint32_t leaf : leaves()) {
    const auto c = corners(leaf);
    polygon.clear();
    for (std::size_t k = 0; k < c.size(); ++k) {
      polygon.push_back(c[k]);
      vertices_.append_hanging(c[k], c[(k + 1) % c.size()], &polygon);
    }
    const std::uint32_t patch = nodes_[leaf].patch;
    HC_TRY(mesh.corners.append(std::span<const std::uint32_t>(polygon)));
    if (!patches_->edge_light.empty())
      HC_TRY(vertices_.append_lights(polygon, &mesh.edge_light));
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
