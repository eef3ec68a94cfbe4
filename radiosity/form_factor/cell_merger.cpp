#include "radiosity/form_factor/cell_merger.h"

#include "radiosity/form_factor/straight_cuts.h"

#include <algorithm>
#include <bit>

namespace hemicube::radiosity {
namespace {

// Meshes need a handful; the rest is left to those made to need one round per cell.
constexpr int kMostRounds = 40;

constexpr std::uint32_t kNotJoined = 0xffffffff;

struct PairEdge {
  std::uint32_t length_class, half_edge;
};

/// Lengths within about 6 % are one class: rounding decides nothing among the edges of a grid. The
/// factor keeps powers of two and their multiples by 3 and 5 away from the borders of the classes.
std::uint32_t length_class(const Vec3& edge) {
  const double squared = 1.0825 * glm::dot(edge, edge);
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(squared) >> 49);
}

} // namespace

Status CellMerger::merge(CellSet* cells, Buffer<std::uint32_t>* cell_of) {
  cell_of->clear();
  HC_TRY(cell_of->resize(cells->count()));
  for (std::uint32_t c = 0; c < cells->count(); ++c)
    (*cell_of)[c] = c;
  bool pairs = false;
  for (int round = 0; round < kMostRounds; ++round) {
    HC_TRY(mesh_.connect(*cells, !pairs));
    HC_TRY(begin_round());
    HC_TRY(pairs ? join_pairs() : join_regions());
    if (joined_.count() > 0)
      HC_TRY(end_round(cells, cell_of));
    else if (pairs)
      break;
    pairs = joined_.count() == 0;
  }
  return {};
}

Status CellMerger::begin_round() {
  joined_.cells.clear();
  joined_.offsets.clear();
  joined_.corners.clear();
  HC_TRY(leader_.resize(mesh_.cell_count()));
  HC_TRY(union_of_.resize(mesh_.cell_count()));
  for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c)
    leader_[c] = c;
  union_of_.fill(kNotJoined);
  return union_.init(mesh_);
}

Status CellMerger::try_join(std::span<const std::uint32_t> members, bool* joined) {
  *joined = union_.join(members);
  if (!*joined)
    return {};
  const std::uint32_t lowest = *std::min_element(members.begin(), members.end());
  for (const std::uint32_t c : members)
    leader_[c] = lowest;
  union_of_[lowest] = joined_.count();
  return joined_.append(union_.cell(), union_.corners());
}

Status CellMerger::join_regions() {
  HC_TRY(cut_at_reflex_corners(&mesh_));
  visited_.clear();
  HC_TRY(visited_.resize(mesh_.cell_count()));
  for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c) {
    if (visited_[c] != 0)
      continue;
    HC_TRY(collect_region(c));
    bool joined = false;
    if (region_.size() > 1)
      HC_TRY(try_join(region_.span(), &joined));
  }
  return {};
}

/// All cells that hang together with one by paired half-edges.
Status CellMerger::collect_region(std::uint32_t start) {
  region_.clear();
  HC_TRY(region_.push_back(start));
  visited_[start] = 1;
  for (std::size_t k = 0; k < region_.size(); ++k)
    for (std::uint32_t h = mesh_.begin(region_[k]); h < mesh_.end(region_[k]); ++h) {
      const std::uint32_t twin = mesh_.twin(h);
      if (twin == kNoHalfEdge || visited_[mesh_.cell_of(twin)] != 0)
        continue;
      visited_[mesh_.cell_of(twin)] = 1;
      HC_TRY(region_.push_back(mesh_.cell_of(twin)));
    }
  return {};
}

Status CellMerger::join_pairs() {
  Buffer<PairEdge> edges;
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.twin(h) != kNoHalfEdge && h < mesh_.twin(h))
      HC_TRY(edges.push_back({length_class(mesh_.vector(h)), h}));
  std::sort(edges.begin(), edges.end(), [](const PairEdge& a, const PairEdge& b) {
    return a.length_class != b.length_class ? a.length_class > b.length_class
                                            : a.half_edge < b.half_edge;
  });
  visited_.clear();
  HC_TRY(visited_.resize(mesh_.cell_count()));
  for (const PairEdge& edge : edges) {
    const std::uint32_t members[2] = {mesh_.cell_of(edge.half_edge),
                                      mesh_.cell_of(mesh_.twin(edge.half_edge))};
    bool joined = false;
    if (visited_[members[0]] == 0 && visited_[members[1]] == 0 && members[0] != members[1])
      HC_TRY(try_join(members, &joined));
    if (joined)
      visited_[members[0]] = visited_[members[1]] = 1;
  }
  return {};
}

Status CellMerger::end_round(CellSet* cells, Buffer<std::uint32_t>* cell_of) {
  CellSet merged;
  Buffer<std::uint32_t> renamed;
  HC_TRY(renamed.resize(cells->count()));
  for (std::uint32_t c = 0; c < cells->count(); ++c) {
    if (leader_[c] != c) {
      renamed[c] = renamed[leader_[c]];
      continue;
    }
    renamed[c] = merged.count();
    const bool is_union = union_of_[c] != kNotJoined;
    const CellSet& source = is_union ? joined_ : *cells;
    const std::uint32_t index = is_union ? union_of_[c] : c;
    HC_TRY(merged.append(source.cells[index], source.corners_of(index)));
  }
  for (std::uint32_t& name : *cell_of)
    name = renamed[name];
  std::swap(*cells, merged);
  return {};
}

} // namespace hemicube::radiosity
