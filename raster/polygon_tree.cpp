#include "raster/polygon_tree.h"

#include "raster/polygon_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemicube::raster {

namespace {

struct Box {
  Vec3 low = Vec3(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3(-std::numeric_limits<double>::infinity());

  void add(const Vec3& p) {
    low = Vec3(std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z));
    high = Vec3(std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z));
  }
};

/// The axis along which a front faces most.
std::uint8_t direction_of(const Plane& plane) {
  const Vec3& n = plane.normal;
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const bool negative = (n[axis] < 0) != plane.reversed;
  return static_cast<std::uint8_t>(axis * 2 + (negative ? 1 : 0));
}

/// Polygons of one class have about as many corners.
std::uint8_t corner_class_of(std::size_t corner_count) {
  std::uint8_t result = 0;
  while (std::size_t{4} << result < corner_count)
    ++result;
  return result;
}

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

  Status measure(Buffer<Groupable>* boxes);
  Status add_node(const Group& group, std::uint32_t* index);
  static const Group** next_divided(std::span<const Group*> children);
  Range polygons_of(const Group& group) { return order_.span().subspan(group.first, group.count); }
  Status store_cluster(Range polygons);
  void set_child(std::uint32_t node, Range polygons, std::uint32_t child);
  void set_normals(Node* node, std::size_t slot, Range polygons) const;

  const Polygons& polygons_;
  PolygonTree& tree_;
  Buffer<Plane> planes_;
  Buffer<std::uint32_t> order_;
  Buffer<Group> groups_;
};

Status TreeBuilder::build() {
  HC_TRY(compute_planes(polygons_, &planes_));
  HC_TRY(tree_.place_.resize(polygons_.count()));
  {
    Buffer<Groupable> boxes;
    HC_TRY(measure(&boxes));
    HC_TRY(group_polygons(boxes.span(), order_.span(), &groups_));
  }
  if (groups_.empty())
    return {};
  std::uint32_t root = 0;
  return add_node(groups_[0], &root);
}

Status TreeBuilder::measure(Buffer<Groupable>* boxes) {
  HC_TRY(boxes->resize(polygons_.count()));
  HC_TRY(order_.resize(polygons_.count()));
  Box all;
  std::size_t most_corners = 3;
  for (std::uint32_t p = 0; p < polygons_.count(); ++p) {
    const auto corners = corners_of(p);
    Box box;
    for (const std::uint32_t c : corners)
      box.add(polygons_.vertices[c]);
    all.add(box.low);
    all.add(box.high);
    most_corners = std::max(most_corners, corners.size());
    (*boxes)[p] = {box.low, box.high, direction_of(planes_[p]), corner_class_of(corners.size())};
    order_[p] = p;
  }
  tree_.most_corners_ = static_cast<std::int32_t>(most_corners);
  if (polygons_.count() == 0)
    return {};
  tree_.origin_ = all.low + (all.high - all.low) * 0.5;
  tree_.radius_ = glm::length(all.high - tree_.origin_);
  return {};
}

/// The child of a node to be replaced by its halves, or none if the node is done: the largest of
/// those too large for a node of their own, and when there are none the smallest for which there
/// is room as clusters.
const Group** TreeBuilder::next_divided(std::span<const Group*> children) {
  const Group** large = nullptr;
  const Group** small = nullptr;
  for (const Group*& child : children) {
    if (child->clusters > kBatch && (large == nullptr || child->area > (*large)->area))
      large = &child;
    if (child->clusters > 1 && child->clusters + children.size() <= kBatch + 1 &&
        (small == nullptr || child->clusters < (*small)->clusters))
      small = &child;
  }
  return large != nullptr && children.size() < kBatch ? large : small;
}

/// Takes groups apart until they fill a node.
Status TreeBuilder::add_node(const Group& group, std::uint32_t* index) {
  *index = static_cast<std::uint32_t>(tree_.nodes_.size());
  Node node = {};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < kBatch; ++k)
      node.half[axis][k] = -1;
  HC_TRY(tree_.nodes_.push_back(node));
  const Group* children[kBatch] = {&group};
  std::size_t count = 1;
  while (const Group** divided = next_divided(std::span(children, count))) {
    const std::uint32_t* halves = (*divided)->halves;
    *divided = &groups_[halves[0]];
    children[count++] = &groups_[halves[1]];
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Range polygons = polygons_of(*children[k]);
    std::uint32_t child = tree_.cluster_count();
    if (children[k]->is_cluster()) {
      HC_TRY(store_cluster(polygons));
      set_normals(&tree_.nodes_[*index], k, polygons);
    } else {
      HC_TRY(add_node(*children[k], &child));
      tree_.nodes_[*index].spread[k] = 2;
    }
    set_child(*index, polygons, child);
  }
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
  node->clusters |= 1u << slot;
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
