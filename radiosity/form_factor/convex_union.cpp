#include "radiosity/form_factor/convex_union.h"

#include "radiosity/mesh/polygon_shape.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {

Status ConvexUnion::init(const CoplanarMesh& mesh) {
  mesh_ = &mesh;
  stamp_ = 0;
  member_.clear();
  HC_TRY(member_.resize(mesh.cell_count()));
  HC_TRY(leaving_.resize(mesh.vertex_count()));
  HC_TRY(outline_.resize(mesh.half_edge_count()));
  return stack_.resize(std::size_t{mesh.half_edge_count()} + 1);
}

bool ConvexUnion::join(std::span<const std::uint32_t> cells) {
  ++stamp_;
  for (const std::uint32_t c : cells)
    member_[c] = stamp_;
  off_ = 0;
  if (!find_outline(cells) || !find_plane(cells) || !find_corners() || !corners_are_convex())
    return false;
  measure_edges();
  cell_.slack += off_;
  return cell_.slack <= cell_.resolution;
}

/// Walks the half-edges that have no twin in the union: as many arrive at a vertex as leave it.
/// False if they are not a single loop that passes every vertex once.
bool ConvexUnion::find_outline(std::span<const std::uint32_t> cells) {
  std::size_t count = 0;
  std::uint32_t start = 0;
  for (const std::uint32_t c : cells)
    for (std::uint32_t h = mesh_->begin(c); h < mesh_->end(c); ++h) {
      const std::uint32_t twin = mesh_->twin(h);
      if (twin != kNoHalfEdge && member_[mesh_->cell_of(twin)] == stamp_)
        continue;
      start = mesh_->from(h);
      leaving_[start] = h;
      ++count;
    }
  outline_count_ = 0;
  std::uint32_t vertex = start;
  do {
    if (outline_count_ == count)
      return false;
    outline_[outline_count_++] = vertex;
    vertex = mesh_->to(leaving_[vertex]);
  } while (vertex != start);
  return outline_count_ == count && count >= 3;
}

bool ConvexUnion::find_plane(std::span<const std::uint32_t> cells) {
  const Vec3 base = outline(0);
  Vec3 sum(0, 0, 0), area(0, 0, 0);
  for (std::size_t k = 1; k < outline_count_; ++k) {
    sum += outline(k) - base;
    if (k > 1)
      area += glm::cross(outline(k - 1) - base, outline(k) - base);
  }
  if (!(glm::length(area) > 0))
    return false;
  cell_ = {};
  cell_.can_join = true;
  cell_.plane = {base + sum / static_cast<double>(outline_count_), unit(area)};
  for (const std::uint32_t c : cells) {
    const Cell& part = mesh_->cell(c);
    cell_.resolution = std::max(cell_.resolution, part.resolution);
    cell_.slack = std::max(cell_.slack, part.slack + mesh_->split_slack(c));
    if (!(glm::dot(part.plane.normal, cell_.plane.normal) > 0))
      return false;
    for (std::uint32_t h = mesh_->begin(c); h < mesh_->end(c); ++h)
      off_ = std::max(off_, std::fabs(cell_.plane.side(mesh_->position(mesh_->from(h)))));
  }
  return true;
}

/// Keeps the corners of the outline where it turns left, going around once from a vertex that is
/// one for sure: the farthest from the middle.
bool ConvexUnion::find_corners() {
  std::size_t start = 0;
  double farthest = 0;
  for (std::size_t k = 0; k < outline_count_; ++k)
    if (const double distance = glm::length(outline(k) - cell_.plane.origin); distance > farthest) {
      farthest = distance;
      start = k;
    }
  std::rotate(outline_.begin(), outline_.begin() + start, outline_.begin() + outline_count_);
  stack_count_ = 0;
  for (std::size_t k = 0; k <= outline_count_; ++k) {
    const Vec3& point = outline(k % outline_count_);
    for (; stack_count_ >= 2; --stack_count_) {
      const Vec3& last = outline(stack_[stack_count_ - 1]);
      if (turn_side(cell_.plane.normal, cell_.resolution / 2,
                    last - outline(stack_[stack_count_ - 2]), point - last) > 0)
        break;
    }
    stack_[stack_count_++] = static_cast<std::uint32_t>(k); // the last closes the loop
  }
  kept_count_ = stack_count_ - 1;
  if (kept_count_ < 3 || kept_count_ > CellSet::kMostCorners)
    return false;
  for (std::size_t k = 0; k < kept_count_; ++k)
    kept_[k] = outline_[stack_[k]];
  return true;
}

/// How far vertices between two corners lie off the edge between them.
void ConvexUnion::measure_edges() {
  for (std::size_t k = 0; k < kept_count_; ++k) {
    const Vec3 start = corner(k);
    const Vec3 edge = corner(k + 1) - start;
    const double length = glm::length(edge);
    const Vec3 inwards = glm::cross(cell_.plane.normal, edge / length);
    for (std::size_t place = stack_[k] + 1; place < stack_[k + 1]; ++place) {
      const Vec3 step = outline(place) - start;
      const double along = glm::dot(step, edge) / length;
      off_ = std::max(off_, std::fabs(glm::dot(inwards, step)));
      off_ = std::max(off_, std::max(-along, along - length));
    }
  }
}

/// Every corner lies to the left of every edge: so they turn left, and around once.
bool ConvexUnion::corners_are_convex() const {
  for (std::size_t k = 0; k < kept_count_; ++k) {
    const Vec3 inwards = glm::cross(cell_.plane.normal, corner(k + 1) - corner(k));
    const double tolerance = cell_.resolution * glm::length(inwards);
    for (std::size_t other = 0; other < kept_count_; ++other)
      if (!(glm::dot(inwards, corner(other) - corner(k)) >= -tolerance))
        return false;
  }
  return true;
}

} // namespace hemicube::radiosity
