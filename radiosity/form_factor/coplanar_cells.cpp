#include "radiosity/form_factor/coplanar_cells.h"

#include "radiosity/mesh/polygon_shape.h"
#include "radiosity/mesh/weld.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

// Two small cells know their common plane only up to rounding times how far they reach beyond each
// other. What is joined in the end is measured against one plane, without this allowance.
constexpr double kReach = 4;

// More edges at one place than this are the spine of a book, not a wall.
constexpr std::size_t kMostAlongAnEdge = 16;
constexpr std::size_t kMostAtAVertex = 64;
constexpr std::size_t kMostInAChain = 256;

Cell measure_cell(std::span<const Vec3> points) {
  Cell cell;
  const PolygonShape shape = measure_polygon(points);
  Vec3 mean(0, 0, 0);
  for (const Vec3& point : points)
    mean += point - points[0];
  cell.plane.origin = points[0] + mean / static_cast<double>(points.size());
  cell.plane.normal = shape.area_vector / shape.area;
  cell.resolution = shape.resolution;
  cell.can_join = has_area(points, shape);
  for (const Vec3& point : points)
    cell.can_join &= std::fabs(cell.plane.side(point)) <= cell.resolution;
  return cell;
}

} // namespace

Status CellSet::append(const Cell& cell, std::span<const std::uint32_t> corners_of_cell) noexcept {
  if (offsets.empty())
    HC_TRY(offsets.push_back(0));
  HC_TRY(cells.push_back(cell));
  HC_TRY(corners.append(corners_of_cell));
  return offsets.push_back(static_cast<std::uint32_t>(corners.size()));
}

Status CellSet::init(const PatchSet& patches) {
  Buffer<std::uint32_t> first;
  HC_TRY(weld_positions(patches.vertices.span(), &first));
  HC_TRY(cells.reserve(patches.patch_count()));
  HC_TRY(offsets.reserve(patches.patch_count() + 1));
  HC_TRY(corners.reserve(patches.corners.size()));
  Buffer<std::uint32_t> welded;
  Buffer<Vec3> points;
  for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
    welded.clear();
    points.clear();
    for (const std::uint32_t corner : patches.corners_of(p)) {
      HC_TRY(welded.push_back(first[corner]));
      HC_TRY(points.push_back(patches.vertices[corner]));
    }
    Cell cell = measure_cell(points.span());
    cell.can_join &= points.size() <= kMostCorners;
    HC_TRY(append(cell, welded.span()));
  }
  return {};
}

Status CoplanarMesh::connect(const CellSet& cells, bool split) {
  set_ = &cells;
  HC_TRY(offsets_.assign(cells.offsets.span()));
  HC_TRY(corners_.assign(cells.corners.span()));
  split_slack_.clear();
  HC_TRY(split_slack_.resize(cells.count()));
  HC_TRY(name_cells());
  HC_TRY(pair());
  bool any = false;
  if (split)
    HC_TRY(find_chains(&any));
  if (!any)
    return {};
  HC_TRY(insert_chains());
  HC_TRY(name_cells());
  return pair();
}

Status CoplanarMesh::name_cells() {
  HC_TRY(cell_of_.resize(corners_.size()));
  for (std::uint32_t c = 0; c < cell_count(); ++c)
    for (std::uint32_t h = offsets_[c]; h < offsets_[c + 1]; ++h)
      cell_of_[h] = c;
  return {};
}

bool CoplanarMesh::lies_in(std::uint32_t cell, const Plane& plane, double tolerance) const {
  for (std::uint32_t h = offsets_[cell]; h < offsets_[cell + 1]; ++h)
    if (!(std::fabs(plane.side(vertices_[corners_[h]])) <= tolerance))
      return false;
  return true;
}

bool CoplanarMesh::coplanar(std::uint32_t a, std::uint32_t b) const {
  const Cell &first = cell(a), &second = cell(b);
  if (!first.can_join || !second.can_join ||
      !(glm::dot(first.plane.normal, second.plane.normal) > 0))
    return false;
  const double tolerance = kReach * std::max(first.resolution, second.resolution);
  return lies_in(a, second.plane, tolerance) || lies_in(b, first.plane, tolerance);
}

/// Half-edges that may be paired, by the lower of their two vertices, or those without a twin by
/// the vertex they start from.
Status CoplanarMesh::bucket_by_vertex(bool unpaired_from) {
  bucket_begin_.clear();
  HC_TRY(bucket_begin_.resize(vertices_.size() + 2));
  const auto vertex_of = [&](std::uint32_t h) {
    return unpaired_from ? from(h) : std::min(from(h), to(h));
  };
  const auto wanted = [&](std::uint32_t h) {
    return cell(cell_of_[h]).can_join && !(unpaired_from && twin_[h] != kNoHalfEdge);
  };
  for (std::uint32_t h = 0; h < half_edge_count(); ++h)
    if (wanted(h))
      ++bucket_begin_[vertex_of(h) + 2];
  for (std::size_t v = 2; v < bucket_begin_.size(); ++v)
    bucket_begin_[v] += bucket_begin_[v - 1];
  HC_TRY(bucket_.resize(corners_.size()));
  for (std::uint32_t h = 0; h < half_edge_count(); ++h)
    if (wanted(h))
      bucket_[bucket_begin_[vertex_of(h) + 1]++] = h;
  return {};
}

Status CoplanarMesh::pair() {
  HC_TRY(twin_.resize(corners_.size()));
  twin_.fill(kNoHalfEdge);
  HC_TRY(bucket_by_vertex(false));
  const auto higher = [&](std::uint32_t h) { return std::max(from(h), to(h)); };
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const auto bucket =
        bucket_.span().subspan(bucket_begin_[v], bucket_begin_[v + 1] - bucket_begin_[v]);
    std::sort(bucket.begin(), bucket.end(), [&](std::uint32_t a, std::uint32_t b) {
      return higher(a) != higher(b) ? higher(a) < higher(b) : a < b;
    });
    for (std::size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
      while (end < bucket.size() && higher(bucket[end]) == higher(bucket[begin]))
        ++end;
      if (end - begin > 1 && end - begin <= kMostAlongAnEdge)
        pair_run(bucket.subspan(begin, end - begin));
    }
  }
  return {};
}

/// @param half_edges  all that run along one edge
void CoplanarMesh::pair_run(std::span<const std::uint32_t> half_edges) {
  std::uint32_t partner[kMostAlongAnEdge];
  int candidates[kMostAlongAnEdge] = {};
  for (std::uint32_t i = 0; i < half_edges.size(); ++i)
    for (std::uint32_t k = 0; k < i; ++k)
      if (from(half_edges[i]) != from(half_edges[k]) &&
          coplanar(cell_of_[half_edges[i]], cell_of_[half_edges[k]])) {
        partner[i] = k;
        partner[k] = i;
        ++candidates[i];
        ++candidates[k];
      }
  for (std::uint32_t i = 0; i < half_edges.size(); ++i)
    if (candidates[i] == 1 && candidates[partner[i]] == 1)
      twin_[half_edges[i]] = half_edges[partner[i]];
}

Status CoplanarMesh::find_chains(bool* any) {
  HC_TRY(bucket_by_vertex(true));
  HC_TRY(chain_begin_.resize(corners_.size()));
  HC_TRY(chain_length_.resize(corners_.size()));
  chain_length_.fill(0);
  chains_.clear();
  // Each half-edge is in one chain at most, unless cells coincide: those may go without.
  for (std::uint32_t h = 0; h < half_edge_count() && chains_.size() <= corners_.size(); ++h) {
    if (twin_[h] != kNoHalfEdge || !cell(cell_of_[h]).can_join)
      continue;
    if (chains_.capacity() < chains_.size() + kMostInAChain)
      HC_TRY(chains_.reserve(2 * chains_.size() + kMostInAChain));
    double off = 0;
    chain_begin_[h] = static_cast<std::uint32_t>(chains_.size());
    const std::size_t length = chain_along(h, &off);
    if (length == 0)
      continue;
    *any = true;
    chain_length_[h] = static_cast<std::uint32_t>(length);
    double& slack = split_slack_[cell_of_[h]];
    slack = std::max(slack, off);
  }
  return {};
}

/// Appends the inner vertices of the chain of unpaired half-edges that runs along h, the other way.
/// @param off  receives how far they lie off the edge, at most
/// @return their number; 0 if there is no chain, or it does not end where h starts
std::size_t CoplanarMesh::chain_along(std::uint32_t h, double* off) {
  const std::size_t begin = chains_.size();
  std::uint32_t at = to(h);
  for (std::size_t length = 0; length <= kMostInAChain; ++length) {
    const std::uint32_t g = link(h, at, off);
    if (g == kNoHalfEdge)
      break;
    at = to(g);
    if (at == from(h))
      return length;
    if (length == kMostInAChain || !chains_.push_back(at).ok())
      break;
  }
  while (chains_.size() > begin)
    chains_.pop_back();
  return 0;
}

/// The unpaired half-edge that runs from a vertex of h towards its start, not beyond it, of a
/// coplanar cell; kNoHalfEdge if there is none or more than one.
std::uint32_t CoplanarMesh::link(std::uint32_t h, std::uint32_t at, double* off) const {
  if (bucket_begin_[at + 1] - bucket_begin_[at] > kMostAtAVertex)
    return kNoHalfEdge;
  const Vec3 start = vertices_[from(h)];
  const Vec3 edge = vertices_[to(h)] - start;
  const double length = glm::length(edge);
  const double before = glm::dot(vertices_[at] - start, edge);
  const double tolerance = cell(cell_of_[h]).resolution / 2;
  std::uint32_t found = kNoHalfEdge;
  double found_off = 0;
  for (std::uint32_t k = bucket_begin_[at]; k < bucket_begin_[at + 1]; ++k) {
    const std::uint32_t g = bucket_[k];
    const Vec3 reached = vertices_[to(g)] - start;
    const double along = glm::dot(reached, edge);
    if (!(along < before) || (to(g) != from(h) && !(along > 0)))
      continue;
    const double distance = glm::length(glm::cross(reached, edge)) / length;
    if (!(distance <= tolerance) || !coplanar(cell_of_[h], cell_of_[g]))
      continue;
    if (found != kNoHalfEdge)
      return kNoHalfEdge;
    found = g;
    found_off = distance;
  }
  *off = std::max(*off, found_off);
  return found;
}

Status CoplanarMesh::insert_chains() {
  Buffer<std::uint32_t> corners;
  HC_TRY(corners.reserve(corners_.size() + chains_.size()));
  for (std::uint32_t c = 0; c < cell_count(); ++c) {
    const std::uint32_t first = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t h = offsets_[c]; h < offsets_[c + 1]; ++h) {
      HC_TRY(corners.push_back(corners_[h]));
      for (std::uint32_t k = chain_length_[h]; k-- > 0;)
        HC_TRY(corners.push_back(chains_[chain_begin_[h] + k]));
    }
    offsets_[c] = first;
  }
  offsets_[cell_count()] = static_cast<std::uint32_t>(corners.size());
  corners_.swap(corners);
  return {};
}

} // namespace hemicube::radiosity
