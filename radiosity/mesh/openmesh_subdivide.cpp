#include "radiosity/mesh/openmesh_subdivide.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_topology.h"
#include "raster/types.h"

#include <cfloat>
#include <exception>
#include <initializer_list>

namespace hemicube::radiosity {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;

template <typename Handle> std::size_t number(Handle handle) {
  return static_cast<std::size_t>(handle.idx());
}

// The same bits from both ends.
double edge_length(const PatchSet& patches, std::span<const std::uint32_t> corners, std::size_t k) {
  return glm::length(patches.vertices[corners[(k + 1) % corners.size()]] -
                     patches.vertices[corners[k]]);
}

bool too_long(double length, double max_edge) {
  return max_edge > 0 && length > max_edge;
}

bool any_too_long(const PatchSet& patches, std::span<const double> max_edge) {
  for (std::uint32_t patch = 0; patch < patches.face.size(); ++patch) {
    const std::span<const std::uint32_t> corners = patches.corners_of(patch);
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (too_long(edge_length(patches, corners, k), max_edge[patch]))
        return true;
  }
  return false;
}

// One round: which edges are halved, and the patches that result.
class Round {
public:
  Round(const PatchSet& patches, std::span<const double> max_edge)
      : in_(patches), max_edge_(max_edge) {}

  Status connect() { return build_half_edges(in_, &half_edges_); }

  // Faces with a piece that is not connected; the pieces of a face are consecutive.
  std::uint64_t unconnected_faces() const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < half_edges_.unconnected.size(); ++i)
      count += i == 0 ||
               in_.face[half_edges_.unconnected[i]] != in_.face[half_edges_.unconnected[i - 1]];
    return count;
  }

  // Marks the edges that are too long, then what must be cut with them.
  void mark_edges() {
    marked_.assign(half_edges_.mesh.n_edges(), 0);
    for (std::uint32_t patch = 0; patch < in_.face.size(); ++patch) {
      const std::span<const std::uint32_t> corners = in_.corners_of(patch);
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (too_long(edge_length(in_, corners, k), max_edge_[patch]))
          mark(edge(patch, k));
    }
    while (!touched_.empty()) {
      const std::uint32_t patch = touched_.back();
      touched_.pop_back();
      const std::size_t count = in_.corners_of(patch).size();
      for (std::size_t k = 0; k < count; ++k)
        if (count != 4 || is_marked(patch, (k + 2) % 4))
          mark(edge(patch, k));
    }
  }

  Status split(PatchSet* out, std::vector<double>* out_max_edge) {
    HC_TRY(check_size());
    out_ = out;
    out_max_edge_ = out_max_edge;
    new_vertices_.assign(half_edges_.mesh.n_halfedges(), NewVertex{});
    HC_TRY(out->vertices.assign(in_.vertices));
    HC_TRY(out->corner_offsets.push_back(0));
    for (std::uint32_t patch = 0; patch < in_.face.size(); ++patch)
      HC_TRY(split_patch(patch));
    return {};
  }

private:
  // The middle of an edge, and the ends by index: patches share it only if they share both.
  struct NewVertex {
    std::uint32_t low = 0, high = 0;
    std::uint32_t vertex = kNone;
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  EdgeHandle edge(std::uint32_t patch, std::size_t k) const {
    return half_edges_.mesh.edge_handle(half_edges_.leaving[in_.corner_offsets[patch] + k]);
  }
  bool is_marked(std::uint32_t patch, std::size_t k) const {
    return marked_[number(edge(patch, k))] != 0;
  }

  void mark(EdgeHandle first) {
    if (marked_[number(first)] != 0)
      return;
    EdgeHandle edge = first;
    do {
      marked_[number(edge)] = 1;
      for (const unsigned side : {0u, 1u}) {
        const FaceHandle face =
            half_edges_.mesh.face_handle(half_edges_.mesh.halfedge_handle(edge, side));
        if (face.is_valid())
          touched_.push_back(static_cast<std::uint32_t>(face.idx()));
      }
      edge = half_edges_.next_coincident[number(edge)];
    } while (edge != first);
  }

  Status check_size() const {
    std::uint64_t patches = 0, corners = 0, vertices = in_.vertices.size();
    for (std::uint32_t patch = 0; patch < in_.face.size(); ++patch) {
      const std::uint64_t count = in_.corners_of(patch).size();
      const bool cut_0 = is_marked(patch, 0), cut_1 = is_marked(patch, 1);
      const std::uint64_t pieces = !(cut_0 || cut_1) ? 1
                                   : count == 4      ? (cut_0 ? 2u : 1u) * (cut_1 ? 2u : 1u)
                                   : count == 3      ? 4
                                                     : count;
      patches += pieces;
      corners += pieces == 1 ? count : pieces * (count == 3 ? 3 : 4);
      vertices += pieces == 1 ? 0 : count + 1; // or fewer
    }
    return check_mesh_size(patches, corners, vertices, "raise max_edge");
  }

  Status split_patch(std::uint32_t patch) {
    const std::span<const std::uint32_t> c = in_.corners_of(patch);
    middles_.clear();
    for (std::size_t k = 0; k < c.size(); ++k) {
      std::uint32_t vertex = kNone;
      if (is_marked(patch, k))
        HC_TRY(middle_of(patch, k, &vertex));
      middles_.push_back(vertex);
    }
    const std::vector<std::uint32_t>& m = middles_;
    // cppcheck-suppress containerOutOfBounds ; a patch has three corners or more
    if (m[0] == kNone && m[1] == kNone)
      return add(patch, c);
    if (c.size() == 3) {
      HC_TRY(add(patch, {c[0], m[0], m[2]}));
      HC_TRY(add(patch, {m[0], c[1], m[1]}));
      HC_TRY(add(patch, {m[2], m[1], c[2]}));
      return add(patch, {m[1], m[2], m[0]});
    }
    if (m[1] == kNone) {
      HC_TRY(add(patch, {c[0], m[0], m[2], c[3]}));
      return add(patch, {m[0], c[1], c[2], m[2]});
    }
    if (m[0] == kNone) {
      HC_TRY(add(patch, {c[0], c[1], m[1], m[3]}));
      return add(patch, {m[3], m[1], c[2], c[3]});
    }
    std::uint32_t centre = kNone;
    HC_TRY(add_centre(c, &centre));
    if (c.size() == 4) {
      HC_TRY(add(patch, {c[0], m[0], centre, m[3]}));
      HC_TRY(add(patch, {m[0], c[1], m[1], centre}));
      HC_TRY(add(patch, {centre, m[1], c[2], m[2]}));
      return add(patch, {m[3], centre, m[2], c[3]});
    }
    for (std::size_t k = 0; k < c.size(); ++k)
      HC_TRY(add(patch, {c[k], m[k], centre, m[(k + c.size() - 1) % c.size()]}));
    return {};
  }

  Status middle_of(std::uint32_t patch, std::size_t k, std::uint32_t* vertex) {
    const std::span<const std::uint32_t> corners = in_.corners_of(patch);
    const std::uint32_t a = corners[k], b = corners[(k + 1) % corners.size()];
    const std::uint32_t low = a < b ? a : b, high = a < b ? b : a;
    const EdgeHandle first = edge(patch, k);
    EdgeHandle edge = first;
    do {
      for (const unsigned side : {0u, 1u}) {
        const NewVertex& there =
            new_vertices_[number(half_edges_.mesh.halfedge_handle(edge, side))];
        if (there.vertex != kNone && there.low == low && there.high == high) {
          *vertex = there.vertex;
          return {};
        }
      }
      edge = half_edges_.next_coincident[number(edge)];
    } while (edge != first);
    const Vec3 middle = 0.5 * (in_.vertices[a] + in_.vertices[b]);
    if (middle == in_.vertices[a] || middle == in_.vertices[b])
      return Status::error(StatusCode::kBadScene, "an edge of face ", in_.face[patch],
                           " of length ", edge_length(in_, corners, k),
                           " cannot be halved in double precision: raise max_edge");
    HC_TRY(add_vertex(middle, vertex));
    new_vertices_[number(half_edges_.leaving[in_.corner_offsets[patch] + k])] = {low, high,
                                                                                 *vertex};
    return {};
  }

  Status add_centre(std::span<const std::uint32_t> corners, std::uint32_t* vertex) {
    Vec3 sum(0, 0, 0); // relative to the first corner
    for (const std::uint32_t corner : corners)
      sum += in_.vertices[corner] - in_.vertices[corners[0]];
    return add_vertex(in_.vertices[corners[0]] + sum / static_cast<double>(corners.size()), vertex);
  }

  Status add_vertex(const Vec3& position, std::uint32_t* vertex) {
    *vertex = static_cast<std::uint32_t>(out_->vertices.size());
    return out_->vertices.push_back(position);
  }

  Status add(std::uint32_t patch, std::initializer_list<std::uint32_t> corners) {
    return add(patch, std::span<const std::uint32_t>(corners.begin(), corners.size()));
  }
  Status add(std::uint32_t patch, std::span<const std::uint32_t> corners) {
    HC_TRY(out_->corners.append(corners));
    HC_TRY(out_->corner_offsets.push_back(static_cast<std::uint32_t>(out_->corners.size())));
    HC_TRY(out_->face.push_back(in_.face[patch]));
    HC_TRY(out_->parent.push_back(in_.parent[patch]));
    HC_TRY(out_->material.push_back(in_.material[patch]));
    HC_TRY(out_->group.push_back(in_.group[patch]));
    out_max_edge_->push_back(max_edge_[patch]);
    return {};
  }

  const PatchSet& in_;
  std::span<const double> max_edge_;
  HalfEdges half_edges_;
  std::vector<std::uint8_t> marked_;    // [edge]
  std::vector<std::uint32_t> touched_;  // patches with a newly marked edge
  std::vector<NewVertex> new_vertices_; // [half-edge]
  std::vector<std::uint32_t> middles_;  // [corner] of the patch at hand
  PatchSet* out_ = nullptr;
  std::vector<double>* out_max_edge_ = nullptr;
};

Status check_arguments(const PatchSet& coarse, std::span<const double> max_edge) {
  if (max_edge.size() != coarse.patch_count())
    return Status::error(StatusCode::kInvalidArgument, "max_edge has ", max_edge.size(),
                         " values for ", coarse.patch_count(), " patches");
  if (coarse.front_count != coarse.patch_count())
    return Status::error(StatusCode::kInvalidArgument,
                         "subdivide before the backs of two-sided patches are added, not after");
  for (std::size_t i = 0; i < max_edge.size(); ++i)
    if (!(max_edge[i] >= 0 && max_edge[i] <= DBL_MAX))
      return Status::error(StatusCode::kInvalidArgument, "max_edge of patch ", i, " is ",
                           max_edge[i], ": give a length, or 0 for no limit");
  return {};
}

// Into how many pieces halving cuts a length; counted no further than there can be patches.
double pieces_of(double length, double max_edge) {
  double count = 1;
  while (too_long(length, max_edge) && count <= raster::kMaxPolygonCount) {
    length *= 0.5;
    count *= 2;
  }
  return count;
}

// Refuses a hopeless max_edge before memory is spent on it. The pieces of a patch are at least
// those that its own edges ask for: a quad is cut into a grid, a triangle into the square of its
// longest edge's.
Status check_piece_count(const PatchSet& coarse, std::span<const double> max_edge) {
  double total = 0, smallest = DBL_MAX;
  for (std::uint32_t patch = 0; patch < coarse.patch_count(); ++patch) {
    const std::span<const std::uint32_t> corners = coarse.corners_of(patch);
    double most[2] = {1, 1};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const double pieces = pieces_of(edge_length(coarse, corners, k), max_edge[patch]);
      most[k % 2] = pieces > most[k % 2] ? pieces : most[k % 2];
    }
    const double longest = most[0] > most[1] ? most[0] : most[1];
    total += corners.size() == 4   ? most[0] * most[1]
             : corners.size() == 3 ? longest * longest
                                   : longest;
    if (max_edge[patch] > 0 && max_edge[patch] < smallest)
      smallest = max_edge[patch];
  }
  if (total > raster::kMaxPolygonCount - 1)
    return Status::error(StatusCode::kBadScene, "max_edge ", smallest, " would make ", total,
                         " patches or more, at most ", raster::kMaxPolygonCount - 1,
                         " can be numbered: raise it");
  return {};
}

Status copy_fronts(const PatchSet& from, PatchSet* to) {
  HC_TRY(to->vertices.assign(from.vertices));
  HC_TRY(to->corner_offsets.assign(from.corner_offsets));
  HC_TRY(to->corners.assign(from.corners));
  HC_TRY(to->face.assign(from.face));
  HC_TRY(to->material.assign(from.material));
  HC_TRY(to->group.assign(from.group));
  HC_TRY(to->parent.resize(from.face.size()));
  for (std::uint32_t i = 0; i < from.face.size(); ++i)
    to->parent[i] = i;
  return {};
}

Status subdivide_in_rounds(const PatchSet& coarse, std::span<const double> max_edge, PatchSet* fine,
                           MeshReport* report) {
  *fine = PatchSet();
  HC_TRY(copy_fronts(coarse, fine));
  std::vector<double> limits(max_edge.begin(), max_edge.end());
  bool limited = false;
  for (const double limit : limits)
    limited = limited || limit > 0;
  for (bool first = limited; first || any_too_long(*fine, limits); first = false) {
    Round round(*fine, limits);
    HC_TRY(round.connect());
    if (first)
      report->non_manifold_faces = round.unconnected_faces();
    round.mark_edges();
    PatchSet next;
    std::vector<double> next_limits;
    HC_TRY(round.split(&next, &next_limits));
    *fine = std::move(next);
    limits.swap(next_limits);
  }
  return {};
}

} // namespace

Status subdivide(const PatchSet& coarse, std::span<const double> max_edge, PatchSet* fine,
                 MeshReport* report) {
  HC_TRY(check_arguments(coarse, max_edge));
  HC_TRY(check_piece_count(coarse, max_edge));
  try {
    HC_TRY(subdivide_in_rounds(coarse, max_edge, fine, report));
  } catch (
      const std::exception&) { // std::bad_alloc, or std::length_error for more than there can be
    return Status::error(StatusCode::kOutOfMemory, "out of memory subdividing ",
                         coarse.patch_count(), " patches");
  }
  const Status measured = measure_patches(fine);
  if (measured.code() == StatusCode::kBadScene)
    return Status::error(StatusCode::kBadScene, measured.message(), ": raise max_edge");
  fine->front_count = fine->patch_count();
  return measured;
}

} // namespace hemicube::radiosity
