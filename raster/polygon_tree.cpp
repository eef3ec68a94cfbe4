#include "raster/polygon_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemicube::raster {

namespace {

constexpr std::size_t kMostInLeafNode = std::size_t{kBatch} * kBatch;

/// Polygons a leaf node is meant to hold: some clusters stay partly empty.
constexpr std::size_t kLeafNodeTarget = 160;

struct Box {
  Vec3 low = Vec3(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3(-std::numeric_limits<double>::infinity());

  void add(const Vec3& p) {
    low = Vec3(std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z));
    high = Vec3(std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z));
  }
};

/// Polygons of one class share clusters: they face about the same way and have about as many
/// corners.
std::uint32_t class_of(const Plane& plane, std::size_t corner_count) {
  const Vec3& n = plane.normal;
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const bool negative = (n[axis] < 0) != plane.reversed;
  std::uint32_t corners = 0;
  while (std::size_t{4} << corners < corner_count)
    ++corners;
  return corners * 6 + static_cast<std::uint32_t>(axis * 2 + (negative ? 1 : 0));
}

constexpr std::uint32_t kClassCount = 6 * 30;

} // namespace

class TreeBuilder {
public:
  TreeBuilder(const Polygons& polygons, PolygonTree* tree) : polygons_(polygons), tree_(*tree) {}

  Status build();

private:
  using Range = std::span<std::uint32_t>;

  std::span<const std::uint32_t> corners_of(std::uint32_t polygon) const {
    const std::uint32_t begin = polygons_.corner_offsets[polygon];
    return polygons_.corners.subspan(begin, polygons_.corner_offsets[polygon + 1] - begin);
  }

  Status measure();
  bool fits_leaf_node(Range polygons) const;
  void split(Range polygons, std::size_t first_size) const;
  Status add_node(Range polygons, std::uint32_t* index);
  Status add_children(Range polygons, std::size_t parts, std::uint32_t node);
  Status add_clusters(Range polygons, std::uint32_t node);
  Status add_cluster(Range polygons, std::uint32_t node);
  Status store_cluster(Range polygons);
  void set_child(std::uint32_t node, Range polygons, std::uint32_t child);
  void set_normals(Node* node, std::size_t slot, Range polygons) const;

  const Polygons& polygons_;
  PolygonTree& tree_;
  Buffer<Plane> planes_;
  Buffer<std::uint32_t> class_;
  Buffer<std::uint32_t> order_;
};

Status TreeBuilder::build() {
  HC_TRY(compute_planes(polygons_, &planes_));
  HC_TRY(tree_.place_.resize(polygons_.count()));
  HC_TRY(measure());
  if (polygons_.count() == 0)
    return {};
  std::uint32_t root = 0;
  return add_node(order_.span(), &root);
}

Status TreeBuilder::measure() {
  HC_TRY(class_.resize(polygons_.count()));
  HC_TRY(order_.resize(polygons_.count()));
  Box box;
  std::size_t most_corners = 3;
  for (std::uint32_t p = 0; p < polygons_.count(); ++p) {
    const auto corners = corners_of(p);
    for (const std::uint32_t c : corners)
      box.add(polygons_.vertices[c]);
    most_corners = std::max(most_corners, corners.size());
    class_[p] = class_of(planes_[p], corners.size());
    order_[p] = p;
  }
  tree_.most_corners_ = static_cast<std::int32_t>(most_corners);
  if (polygons_.count() == 0)
    return {};
  tree_.origin_ = box.low + (box.high - box.low) * 0.5;
  tree_.radius_ = glm::length(box.high - tree_.origin_);
  return {};
}

bool TreeBuilder::fits_leaf_node(Range polygons) const {
  if (polygons.size() > kMostInLeafNode)
    return false;
  std::uint32_t sizes[kClassCount] = {};
  for (const std::uint32_t p : polygons)
    ++sizes[class_[p]];
  std::uint32_t clusters = 0;
  for (const std::uint32_t size : sizes)
    clusters += (size + kBatch - 1) / kBatch;
  return clusters <= kBatch;
}

/// Moves the `first_size` polygons that lie lowest along the longest axis to the front.
void TreeBuilder::split(Range polygons, std::size_t first_size) const {
  Box box;
  for (const std::uint32_t p : polygons)
    box.add(planes_[p].point);
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::nth_element(polygons.begin(), polygons.begin() + static_cast<std::ptrdiff_t>(first_size),
                   polygons.end(), [&](std::uint32_t a, std::uint32_t b) {
                     const double at_a = planes_[a].point[axis], at_b = planes_[b].point[axis];
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
}

Status TreeBuilder::add_node(Range polygons, std::uint32_t* index) {
  *index = static_cast<std::uint32_t>(tree_.nodes_.size());
  Node node = {};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < kBatch; ++k)
      node.half[axis][k] = -1;
  node.leaf = fits_leaf_node(polygons) ? 1 : 0;
  HC_TRY(tree_.nodes_.push_back(node));
  if (node.leaf == 0) {
    const std::size_t parts = (polygons.size() + kLeafNodeTarget - 1) / kLeafNodeTarget;
    return add_children(polygons, std::clamp<std::size_t>(parts, 2, kBatch), *index);
  }
  std::sort(polygons.begin(), polygons.end(), [&](std::uint32_t a, std::uint32_t b) {
    return class_[a] != class_[b] ? class_[a] < class_[b] : a < b;
  });
  for (std::size_t begin = 0, end = 0; begin < polygons.size(); begin = end) {
    while (end < polygons.size() && class_[polygons[end]] == class_[polygons[begin]])
      ++end;
    HC_TRY(add_clusters(polygons.subspan(begin, end - begin), *index));
  }
  return {};
}

Status TreeBuilder::add_children(Range polygons, std::size_t parts, std::uint32_t node) {
  if (parts > 1) {
    const std::size_t first_parts = parts / 2;
    const std::size_t first_size = polygons.size() * first_parts / parts;
    split(polygons, first_size);
    HC_TRY(add_children(polygons.first(first_size), first_parts, node));
    return add_children(polygons.subspan(first_size), parts - first_parts, node);
  }
  std::uint32_t child = 0;
  HC_TRY(add_node(polygons, &child));
  set_child(node, polygons, child);
  return {};
}

Status TreeBuilder::add_clusters(Range polygons, std::uint32_t node) {
  if (polygons.size() <= kBatch)
    return add_cluster(polygons, node);
  const std::size_t clusters = (polygons.size() + kBatch - 1) / kBatch;
  const std::size_t first_size = clusters / 2 * kBatch;
  split(polygons, first_size);
  HC_TRY(add_clusters(polygons.first(first_size), node));
  return add_clusters(polygons.subspan(first_size), node);
}

Status TreeBuilder::add_cluster(Range polygons, std::uint32_t node) {
  const std::uint32_t index = tree_.cluster_count();
  HC_TRY(store_cluster(polygons));
  set_normals(&tree_.nodes_[node], static_cast<std::size_t>(tree_.nodes_[node].count), polygons);
  set_child(node, polygons, index);
  return {};
}

Status TreeBuilder::store_cluster(Range polygons) {
  std::size_t most_corners = 3;
  for (const std::uint32_t p : polygons)
    most_corners = std::max(most_corners, corners_of(p).size());
  const std::uint32_t index = tree_.cluster_count();
  PolygonTree::ClusterRecord record;
  record.numbers = tree_.numbers_.size();
  record.corner_count = static_cast<std::int32_t>(most_corners);
  record.present = (1u << polygons.size()) - 1;
  const std::size_t size = (PolygonTree::kPlaneNumbers + 3 * most_corners) * kBatch;
  if (tree_.numbers_.size() + size > tree_.numbers_.capacity())
    HC_TRY(tree_.numbers_.reserve_huge(2 * tree_.numbers_.size() + size));
  static constexpr double kZeros[kBatch] = {};
  for (std::size_t k = 0; k < size; k += kBatch)
    HC_TRY(tree_.numbers_.append(kZeros));
  HC_TRY(tree_.clusters_.push_back(record));
  for (int lane = 0; lane < kBatch; ++lane)
    HC_TRY(tree_.ids_.push_back(kNoItem));

  double* planes = tree_.numbers_.data() + record.numbers;
  double* corners = planes + PolygonTree::kPlaneNumbers * kBatch;
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    // Lanes without a polygon repeat the first: numbers that harm nobody.
    const std::uint32_t p = polygons[lane < polygons.size() ? lane : 0];
    if (lane < polygons.size()) {
      tree_.ids_[std::size_t{index} * kBatch + lane] = p;
      tree_.place_[p] = index * kBatch + static_cast<std::uint32_t>(lane);
    }
    const Plane& plane = planes_[p];
    for (int axis = 0; axis < 3; ++axis) {
      planes[static_cast<std::size_t>(axis) * kBatch + lane] = plane.normal[axis];
      planes[static_cast<std::size_t>(axis + 3) * kBatch + lane] = plane.point[axis];
    }
    planes[6 * kBatch + lane] = plane.reversed ? -1 : 1;
    const auto corner_ids = corners_of(p);
    for (std::size_t c = 0; c < most_corners; ++c) {
      const Vec3& v = polygons_.vertices[corner_ids[std::min(c, corner_ids.size() - 1)]];
      for (int axis = 0; axis < 3; ++axis)
        corners[(c * 3 + static_cast<std::size_t>(axis)) * kBatch + lane] = v[axis];
    }
  }
  return {};
}

void TreeBuilder::set_child(std::uint32_t node, Range polygons, std::uint32_t child) {
  Box box;
  for (const std::uint32_t p : polygons)
    for (const std::uint32_t c : corners_of(p))
      box.add(polygons_.vertices[c]);
  Node& n = tree_.nodes_[node];
  const auto slot = static_cast<std::size_t>(n.count++);
  n.child[slot] = child;
  const Vec3 center = (box.low - tree_.origin_) * 0.5 + (box.high - tree_.origin_) * 0.5;
  const Vec3 half = (box.high - box.low) * 0.5;
  for (int axis = 0; axis < 3; ++axis) {
    n.center[axis][slot] = static_cast<float>(center[axis]);
    n.half[axis][slot] = static_cast<float>(half[axis]); // rounding: NodeProblem::slack
  }
}

void TreeBuilder::set_normals(Node* node, std::size_t slot, Range polygons) const {
  const auto front = [&](std::uint32_t p) {
    const double length = glm::length(planes_[p].normal);
    if (!(length > 0))
      return Vec3(0, 0, 0);
    return planes_[p].normal / (planes_[p].reversed ? -length : length);
  };
  Vec3 axis(0, 0, 0);
  for (const std::uint32_t p : polygons)
    axis += front(p);
  axis = axis / static_cast<double>(polygons.size());
  double spread = 0;
  for (const std::uint32_t p : polygons)
    spread = std::max(spread, glm::length(front(p) - axis));
  for (int k = 0; k < 3; ++k)
    node->axis[k][slot] = static_cast<float>(axis[k]);
  node->spread[slot] = static_cast<float>(spread + 0x1p-20);
}

Status PolygonTree::build(const Polygons& polygons) {
  *this = PolygonTree();
  return TreeBuilder(polygons, this).build();
}

void PolygonTree::plane(std::uint32_t polygon, double normal[3], double point[3]) const noexcept {
  const std::uint32_t place = place_[polygon];
  const double* planes = numbers_.data() + clusters_[place / kBatch].numbers + place % kBatch;
  for (int axis = 0; axis < 3; ++axis) {
    normal[axis] = planes[axis * kBatch];
    point[axis] = planes[(axis + 3) * kBatch];
  }
}

} // namespace hemicube::raster
