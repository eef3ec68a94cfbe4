#include "radiosity/discontinuity/patch_cutter.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/polygon_shape.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// A line that takes up less of an edge leaves it smooth.
constexpr double kLeastPart = 0.5;

std::size_t next_of(std::size_t k, std::size_t count) {
  return k + 1 == count ? 0 : k + 1;
}

} // namespace

/// A line in the plane of a patch.
struct PatchCutter::Line {
  Vec3 origin, way, across; ///< the latter two of length 1
  double length;            ///< metres; of 0 the others say nothing

  Line(const Vec3& begin, const Vec3& end, const Vec3& normal)
      : origin(begin), way(end - begin), across(0), length(glm::length(end - begin)) {
    if (length > 0)
      way /= length;
    across = glm::cross(normal, way);
  }
  double side(const Vec3& point) const { return glm::dot(across, point - origin); }
  double along(const Vec3& point) const { return glm::dot(way, point - origin); }
};

Status PatchCutter::init(const PatchSet& patches) {
  *this = {};
  patches_ = &patches;
  for (const Vec3& position : patches.vertices)
    vertices_.add_vertex(position);
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const auto corners = patches.corners_of(patch);
    cells_.push_back({Cell(corners.begin(), corners.end())});
  }
  cell_count_ = patches.patch_count();
  return {};
}

std::uint32_t PatchCutter::split_edge(std::uint32_t a, std::uint32_t b, double share) {
  std::uint32_t between = vertices_.split(a, b);
  if (between == SplitEdges::kNone) {
    between = vertices_.add_vertex(vertices_[a] + share * (vertices_[b] - vertices_[a]));
    vertices_.set_split(a, b, between);
  }
  return between;
}

void PatchCutter::insert_hanging(Cell* cell) const {
  Cell whole;
  for (std::size_t k = 0; k < cell->size(); ++k) {
    whole.push_back((*cell)[k]);
    vertices_.append_hanging((*cell)[k], (*cell)[next_of(k, cell->size())], &whole);
  }
  cell->swap(whole);
}

bool PatchCutter::may_touch(const Cell& cell, const Line& line, double snap) const {
  bool any_left = false, any_right = false, any_after = false, any_before = false;
  for (const std::uint32_t vertex : cell) {
    const double side = line.side(vertices_[vertex]), along = line.along(vertices_[vertex]);
    any_left = any_left || side >= -snap;
    any_right = any_right || side <= snap;
    any_after = any_after || along >= 0;
    any_before = any_before || along <= line.length;
  }
  return any_left && any_right && any_after && any_before;
}

/// @return false if the line does not divide the cell
bool PatchCutter::find_crossing(const Cell& cell, const Line& line, double snap,
                                Crossing* crossing) const {
  std::vector<double> side;
  for (const std::uint32_t vertex : cell) {
    const double exact = line.side(vertices_[vertex]);
    side.push_back(std::fabs(exact) <= snap ? 0 : exact);
  }
  SideChange changes[2];
  if (!find_side_changes(side, changes))
    return false;
  const auto along = [&](const SideChange& change) {
    const double from = line.along(vertices_[cell[change.corner]]);
    const double to = line.along(vertices_[cell[next_of(change.corner, cell.size())]]);
    return from + change.share * (to - from);
  };
  const double first = along(changes[0]), second = along(changes[1]);
  *crossing = {changes[0], changes[1], std::min(first, second), std::max(first, second)};
  return true;
}

bool PatchCutter::has_resolved_area(const Cell& cell) const {
  std::vector<Vec3> points;
  for (const std::uint32_t vertex : cell)
    points.push_back(vertices_[vertex]);
  PolygonShape shape = measure_polygon(points);
  shape.resolution *= 64; // what is left of it after the next cuts
  return has_area(points, shape);
}

/// @param ends  receives those of the new edge
/// @return false if the pieces would be too small
bool PatchCutter::cut_cell(std::uint32_t patch, std::size_t number, const Crossing& crossing,
                           std::uint32_t ends[2]) {
  const Cell cell = cells_[patch][number];
  const std::size_t count = cell.size();
  const SideChange changes[2] = {crossing.enters, crossing.leaves};
  for (const std::size_t e : {0u, 1u}) {
    const auto [k, share] = changes[e];
    ends[e] = share == 0 ? cell[k] : split_edge(cell[k], cell[next_of(k, count)], share);
  }
  Cell pieces[2];
  for (const std::size_t e : {0u, 1u}) {
    const SideChange &from = changes[e], &to = changes[1 - e];
    pieces[e].push_back(ends[e]);
    for (std::size_t k = next_of(from.corner, count); k != to.corner; k = next_of(k, count))
      pieces[e].push_back(cell[k]);
    if (to.share != 0)
      pieces[e].push_back(cell[to.corner]);
    pieces[e].push_back(ends[1 - e]);
  }
  if (!has_resolved_area(pieces[0]) || !has_resolved_area(pieces[1]))
    return false; // a vertex on the border may stay: it does no harm
  cells_[patch][number] = std::move(pieces[0]);
  cells_[patch].push_back(std::move(pieces[1]));
  ++cell_count_;
  return true;
}

/// Makes a vertex on the edge from a to b where it is `along` a line, unless one is as near as
/// that.
void PatchCutter::split_at(std::uint32_t a, std::uint32_t b, const Line& line, double along,
                           double snap) {
  const double at_a = line.along(vertices_[a]), at_b = line.along(vertices_[b]);
  const double low = std::min(at_a, at_b), high = std::max(at_a, at_b);
  if (!(along - low > snap && high - along > snap))
    return;
  if (const std::uint32_t between = vertices_.split(a, b); between != SplitEdges::kNone) {
    split_at(a, between, line, along, snap);
    split_at(between, b, line, along, snap);
  } else {
    split_edge(a, b, (along - at_a) / (at_b - at_a));
  }
}

void PatchCutter::cut(std::uint32_t patch, const Vec3& begin, const Vec3& end, EdgeLight light,
                      double snap) {
  const Line line(begin, end, patches_->normal[patch]);
  if (!(line.length > snap))
    return;
  Crossing crossing;
  const std::size_t cell_count = cells_[patch].size();
  for (std::size_t c = 0; c < cell_count; ++c) {
    if (!may_touch(cells_[patch][c], line, snap))
      continue;
    insert_hanging(&cells_[patch][c]);
    if (!find_crossing(cells_[patch][c], line, snap, &crossing))
      continue;
    const double overlap = std::min(crossing.end, line.length) - std::max(crossing.begin, 0.0);
    std::uint32_t ends[2];
    if (!(crossing.end - crossing.begin > snap && overlap > snap) ||
        !cut_cell(patch, c, crossing, ends) || light != EdgeLight::kJumps)
      continue;
    split_at(ends[0], ends[1], line, 0, snap);
    split_at(ends[0], ends[1], line, line.length, snap);
  }
}

void PatchCutter::note_light(std::uint32_t patch, const Vec3& begin, const Vec3& end,
                             EdgeLight light, double snap) {
  const Line line(begin, end, patches_->normal[patch]);
  if (!(line.length > snap))
    return;
  for (Cell& cell : cells_[patch]) {
    if (!may_touch(cell, line, snap))
      continue;
    insert_hanging(&cell);
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const std::uint32_t a = cell[k], b = cell[next_of(k, cell.size())];
      if (std::fabs(line.side(vertices_[a])) > snap || std::fabs(line.side(vertices_[b])) > snap)
        continue;
      const double at_a = line.along(vertices_[a]), at_b = line.along(vertices_[b]);
      const double low = std::min(at_a, at_b), high = std::max(at_a, at_b);
      if (std::min(high, line.length) - std::max(low, 0.0) >= kLeastPart * (high - low))
        vertices_.note_light(a, b, light);
    }
  }
}

Status PatchCutter::make_mesh(PatchSet* cells) const {
  *cells = {};
  HC_TRY(check_mesh_size(cell_count_, 0, vertices_.vertex_count(), "begin with a coarser mesh"));
  HC_TRY(cells->vertices.append(std::span<const Vec3>(vertices_.positions())));
  HC_TRY(cells->corner_offsets.push_back(0));
  for (std::uint32_t patch = 0; patch < cells_.size(); ++patch)
    for (const Cell& cut : cells_[patch]) {
      Cell cell = cut;
      insert_hanging(&cell);
      HC_TRY(cells->corners.append(std::span<const std::uint32_t>(cell)));
      HC_TRY(check_mesh_size(0, cells->corners.size(), 0, "begin with a coarser mesh"));
      HC_TRY(cells->corner_offsets.push_back(static_cast<std::uint32_t>(cells->corners.size())));
      HC_TRY(vertices_.append_lights(cell, &cells->edge_light));
      HC_TRY(cells->face.push_back(patches_->face[patch]));
      HC_TRY(cells->parent.push_back(patches_->parent[patch]));
      HC_TRY(cells->material.push_back(patches_->material[patch]));
      HC_TRY(cells->group.push_back(patches_->group[patch]));
    }
  HC_TRY(measure_patches(cells));
  cells->front_count = cells->patch_count();
  return {};
}

} // namespace hemicube::radiosity
