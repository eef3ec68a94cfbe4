#include "radiosity/refine/variation.h"

#include "radiosity/mesh/one_surface.h"
#include "radiosity/mesh/openmesh_topology.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Of more elements on one edge only so many are compared: work stays linear.
constexpr int kMostOnEdge = 64;

/// Neighbours on the same surface, each once per common edge.
class Neighbours {
public:
  explicit Neighbours(const PatchSet& elements) : elements_(elements) {}
  Status connect() { return build_half_edges(elements_, &half_edges_); }

  /// Calls visit(neighbour, middle of the common edge).
  template <typename Visit> void for_each(std::uint32_t element, Visit visit) const {
    const OpenMesh::PolyConnectivity& mesh = half_edges_.mesh;
    const auto corners = elements_.corners_of(element);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (elements_.light_across(elements_.corner_offsets[element] + k) == EdgeLight::kJumps)
        continue;
      const Vec3 middle = 0.5 * (elements_.vertices[corners[k]] +
                                 elements_.vertices[corners[(k + 1) % corners.size()]]);
      const OpenMesh::EdgeHandle first =
          mesh.edge_handle(half_edges_.leaving[elements_.corner_offsets[element] + k]);
      OpenMesh::EdgeHandle edge = first;
      int count = 0;
      do {
        for (const unsigned side : {0u, 1u}) {
          const OpenMesh::FaceHandle face = mesh.face_handle(mesh.halfedge_handle(edge, side));
          const auto other = static_cast<std::uint32_t>(face.idx());
          if (face.is_valid() && other != element && are_one_surface(elements_, element, other))
            visit(other, middle);
        }
        edge = half_edges_.next_coincident[static_cast<std::size_t>(edge.idx())];
      } while (edge != first && ++count < kMostOnEdge);
    }
  }

private:
  const PatchSet& elements_;
  HalfEdges half_edges_;
};

} // namespace

Status find_variation(const PatchSet& elements, std::span<const double> radiosity,
                      std::span<const double> exitance, std::span<const double> scale,
                      std::vector<double>* variation) {
  Neighbours neighbours(elements);
  HC_TRY(neighbours.connect());
  const std::size_t bands = scale.size();
  variation->assign(elements.patch_count(), 0);
  for (std::uint32_t element = 0; element < elements.patch_count(); ++element) {
    double& largest = (*variation)[element];
    bool is_alone = true;
    neighbours.for_each(element, [&](std::uint32_t neighbour, const Vec3& middle) {
      is_alone = false;
      const double own = glm::length(middle - elements.centre[element]);
      const double other = glm::length(middle - elements.centre[neighbour]);
      for (std::size_t band = 0; band < bands; ++band) {
        if (!(scale[band] > 0))
          continue;
        const double step =
            std::fabs(radiosity[element * bands + band] - radiosity[neighbour * bands + band]);
        largest = std::max(largest, step / scale[band] * (2 * own / (own + other)));
      }
    });
    for (std::size_t band = 0; band < bands && is_alone; ++band)
      if (scale[band] > 0)
        largest = std::max(largest,
                           (radiosity[element * bands + band] - exitance[element * bands + band]) /
                               scale[band]);
  }
  return {};
}

} // namespace hemicube::radiosity
