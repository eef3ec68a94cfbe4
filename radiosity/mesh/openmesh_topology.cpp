#include "radiosity/mesh/openmesh_topology.h"

#include "radiosity/mesh/weld.h"

#include <OpenMesh/Core/System/omstream.hh>

#include <algorithm>
#include <exception>

namespace hemicube::radiosity {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// OpenMesh walks around a vertex to find an edge of it. This keeps a fan of 10^6 patches from
// taking 10^12 steps; what is past it is unconnected, and found again as a coincident edge.
constexpr std::uint32_t kMaxPatchesAtVertex = 1024;

// The kernel explains every face it refuses on its message stream.
class QuietOpenMesh {
public:
  QuietOpenMesh() : was_enabled_(omerr().is_enabled()) { omerr().disable(); }
  ~QuietOpenMesh() {
    omerr().flush(); // a disabled stream drops what it holds
    if (was_enabled_)
      omerr().enable();
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

private:
  bool was_enabled_;
};

class Connector {
public:
  Connector(const PatchSet& patches, HalfEdges* result) : patches_(patches), result_(*result) {}

  Status run() {
    HC_TRY(weld_positions(patches_.vertices, &place_));
    result_.mesh.reserve(place_.size(), patches_.corners.size(), patches_.face.size());
    for (std::size_t i = 0; i < place_.size(); ++i)
      result_.mesh.add_vertex();
    patches_at_.resize(place_.size());
    result_.leaving.resize(patches_.corners.size());
    for (std::uint32_t patch = 0; patch < patches_.face.size(); ++patch)
      add(patch);
    link_coincident_edges();
    return {};
  }

private:
  void add(std::uint32_t patch) {
    const std::span<const std::uint32_t> corners = patches_.corners_of(patch);
    handles_.clear();
    for (const std::uint32_t corner : corners)
      handles_.push_back(VertexHandle(static_cast<int>(place_[corner])));
    FaceHandle face;
    if (connectable())
      face = result_.mesh.add_face(handles_);
    if (face.is_valid()) {
      for (const VertexHandle vertex : handles_)
        ++patches_at_[static_cast<std::size_t>(vertex.idx())];
    } else {
      for (VertexHandle& vertex : handles_)
        vertex = result_.mesh.add_vertex();
      face = result_.mesh.add_face(handles_);
      result_.unconnected.push_back(patch);
    }
    note_half_edges(face, patches_.corner_offsets[patch]);
  }

  // add_face stops the program if a vertex is named twice.
  bool connectable() {
    sorted_ = handles_;
    std::sort(sorted_.begin(), sorted_.end());
    return std::adjacent_find(sorted_.begin(), sorted_.end()) == sorted_.end() &&
           std::all_of(handles_.begin(), handles_.end(), [&](VertexHandle vertex) {
             return patches_at_[static_cast<std::size_t>(vertex.idx())] < kMaxPatchesAtVertex;
           });
  }

  void note_half_edges(FaceHandle face, std::size_t first_corner) {
    HalfedgeHandle half_edge = result_.mesh.halfedge_handle(face);
    while (result_.mesh.from_vertex_handle(half_edge) != handles_[0])
      half_edge = result_.mesh.next_halfedge_handle(half_edge);
    for (std::size_t k = 0; k < handles_.size(); ++k) {
      result_.leaving[first_corner + k] = half_edge;
      half_edge = result_.mesh.next_halfedge_handle(half_edge);
    }
  }

  struct PlacedEdge {
    std::uint32_t low, high; // places of the ends
    EdgeHandle edge;
    bool same_place(const PlacedEdge& other) const {
      return low == other.low && high == other.high;
    }
    bool operator<(const PlacedEdge& other) const {
      return low != other.low     ? low < other.low
             : high != other.high ? high < other.high
                                  : edge < other.edge;
    }
  };

  void link_coincident_edges() {
    std::vector<EdgeHandle>& next = result_.next_coincident;
    next.resize(result_.mesh.n_edges());
    for (std::size_t i = 0; i < next.size(); ++i)
      next[i] = EdgeHandle(static_cast<int>(i));
    if (result_.unconnected.empty())
      return; // connected patches share the edges at one place
    const std::vector<PlacedEdge> edges = placed_edges();
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      EdgeHandle last = edges[begin].edge;
      for (end = begin + 1; end < edges.size() && edges[end].same_place(edges[begin]); ++end)
        if (edges[end].edge != last) {
          next[static_cast<std::size_t>(last.idx())] = edges[end].edge;
          last = edges[end].edge;
        }
      next[static_cast<std::size_t>(last.idx())] = edges[begin].edge;
    }
  }

  // Sorted; an edge with two patches is there twice.
  std::vector<PlacedEdge> placed_edges() const {
    std::vector<PlacedEdge> edges;
    edges.reserve(result_.leaving.size());
    for (std::uint32_t patch = 0; patch < patches_.face.size(); ++patch) {
      const std::span<const std::uint32_t> corners = patches_.corners_of(patch);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::uint32_t a = place_[corners[k]];
        const std::uint32_t b = place_[corners[(k + 1) % corners.size()]];
        const HalfedgeHandle leaving = result_.leaving[patches_.corner_offsets[patch] + k];
        edges.push_back({std::min(a, b), std::max(a, b), result_.mesh.edge_handle(leaving)});
      }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  const PatchSet& patches_;
  HalfEdges& result_;
  Buffer<std::uint32_t> place_;           // [vertex] lowest vertex at the same place
  std::vector<std::uint32_t> patches_at_; // [place] connected ones
  std::vector<VertexHandle> handles_, sorted_;
};

} // namespace

Status build_half_edges(const PatchSet& patches, HalfEdges* half_edges) {
  constexpr std::size_t kMaxCorners = std::size_t{1} << 30; // two half-edges each, numbered by int
  if (patches.corners.size() > kMaxCorners || patches.vertices.size() > kMaxCorners)
    return Status::error(StatusCode::kBadScene, "a mesh of ", patches.corners.size(),
                         " corners and ", patches.vertices.size(),
                         " vertices is too large for subdivision, at most ", kMaxCorners,
                         " of each: raise max_edge or split the scene");
  try {
    const QuietOpenMesh quiet;
    return Connector(patches, half_edges).run();
  } catch (
      const std::exception&) { // std::bad_alloc, or std::length_error for more than there can be
    return Status::error(StatusCode::kOutOfMemory, "out of memory connecting ", patches.face.size(),
                         " patches");
  }
}

} // namespace hemicube::radiosity
