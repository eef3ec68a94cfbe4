#include "radiosity/form_factor/occluder_tree.h"

#include <algorithm>

namespace hemicube::radiosity {

void OccluderTree::Box::add(const Box& other) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

Status OccluderTree::build(const OccluderFaces& faces) {
  boxes_.clear();
  nodes_.clear();
  HC_TRY(boxes_.resize(faces.face_count()));
  HC_TRY(order_.resize(faces.face_count()));
  for (std::uint32_t f = 0; f < faces.face_count(); ++f) {
    const auto corners = faces.corners_of(f);
    boxes_[f] = {corners[0], corners[0]};
    for (const Vec3& corner : corners)
      boxes_[f].add({corner, corner});
    order_[f] = f;
  }
  return faces.face_count() == 0 ? Status() : add_node(order_.span(), 0);
}

/// @param faces  part of order_
/// @param first  where it begins there
Status OccluderTree::add_node(std::span<std::uint32_t> faces, std::uint32_t first) {
  Node node = {boxes_[faces[0]], first, static_cast<std::uint32_t>(faces.size())};
  for (const std::uint32_t face : faces)
    node.box.add(boxes_[face]);
  const std::size_t index = nodes_.size();
  if (faces.size() <= kLeafFaces) {
    std::sort(faces.begin(), faces.end()); // halving leaves their order to the standard library
    return nodes_.push_back(node);
  }
  node.count = 0;
  HC_TRY(nodes_.push_back(node));
  halve(faces);
  const std::size_t half = faces.size() / 2;
  HC_TRY(add_node(faces.first(half), first));
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  return add_node(faces.subspan(half), first + static_cast<std::uint32_t>(half));
}

/// Moves the half of the faces to the front whose middles are the lower ones along the axis on
/// which the middles differ most.
void OccluderTree::halve(std::span<std::uint32_t> faces) const {
  const auto middle = [&](std::uint32_t face) { // doubled
    return boxes_[face].low + boxes_[face].high;
  };
  Box middles = {middle(faces[0]), middle(faces[0])};
  for (const std::uint32_t face : faces)
    middles.add({middle(face), middle(face)});
  const Vec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::nth_element(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(faces.size() / 2),
                   faces.end(), [&](std::uint32_t a, std::uint32_t b) {
                     const double at_a = middle(a)[axis], at_b = middle(b)[axis];
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
}

} // namespace hemicube::radiosity
