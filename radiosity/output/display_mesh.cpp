#include "radiosity/output/display_mesh.h"

#include "radiosity/elementary.h"
#include "radiosity/mesh/straight_corners.h"
#include "radiosity/output/display_bands.h"
#include "radiosity/output/interpolation.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

class MeshBuilder {
public:
  MeshBuilder(const PatchSet& patches, const CornerVertices& vertices,
              std::span<const std::uint8_t> is_straight, DisplayMesh* mesh)
      : patches_(patches), vertices_(vertices), is_straight_(is_straight), mesh_(*mesh) {}

  void add_vertex(const Vec3& position, const Vec3& radiance) {
    for (int k = 0; k < 3; ++k) {
      mesh_.positions.push_back(static_cast<float>(position[k]));
      mesh_.radiances.push_back(static_cast<float>(radiance[k]));
    }
  }

  void add_patch(std::uint32_t patch) {
    const std::uint32_t begin = patches_.corner_offsets[patch];
    const auto count = static_cast<std::uint32_t>(patches_.corners_of(patch).size());
    const auto corners = std::span(vertices_.of_corner).subspan(begin, count);
    const auto straight = is_straight_.subspan(begin, count);
    if (std::find(straight.begin(), straight.end(), 1) != straight.end()) {
      const std::uint32_t centre = add_centre(patch, corners);
      for (std::uint32_t k = 0; k < count; ++k)
        add_triangle(centre, corners[k], corners[(k + 1) % count]);
      return;
    }
    const std::uint32_t first = count == 4 && is_cut_from_second(corners) ? 1 : 0;
    for (std::uint32_t k = 1; k + 1 < count; ++k)
      add_triangle(corners[first], corners[(first + k) % count], corners[(first + k + 1) % count]);
  }

private:
  static Vec3 triple(const std::vector<float>& values, std::uint32_t vertex) {
    const float* at = &values[std::size_t{3} * vertex];
    return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
  }
  Vec3 position(std::uint32_t vertex) const { return triple(mesh_.positions, vertex); }
  Vec3 radiance(std::uint32_t vertex) const { return triple(mesh_.radiances, vertex); }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (glm::cross(position(b) - position(a), position(c) - position(a)) != Vec3{0, 0, 0})
      mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }

  bool is_cut_from_second(std::span<const std::uint32_t> quad) const {
    const auto contrast = [&](std::uint32_t a, std::uint32_t b) {
      const Vec3 difference = radiance(a) - radiance(b);
      return std::fabs(difference.x) + std::fabs(difference.y) + std::fabs(difference.z);
    };
    const double first = contrast(quad[0], quad[2]), second = contrast(quad[1], quad[3]);
    return second < first ||
           (second == first && glm::distance(position(quad[1]), position(quad[3])) <
                                   glm::distance(position(quad[0]), position(quad[2])));
  }

  /// Adds the centre of a patch and what the patch shows there.
  std::uint32_t add_centre(std::uint32_t patch, std::span<const std::uint32_t> corners) {
    double weights[kMaxInterpolatedCorners];
    const bool is_interpolated = corners.size() <= kMaxInterpolatedCorners;
    if (is_interpolated)
      interpolation_weights(patches_, is_straight_, patch, patches_.centre[patch], weights);
    Vec3 sum{0, 0, 0};
    for (std::size_t k = 0; k < corners.size(); ++k)
      sum += (is_interpolated ? weights[k] : 1 / static_cast<double>(corners.size())) *
             radiance(corners[k]);
    add_vertex(patches_.centre[patch], sum);
    return static_cast<std::uint32_t>(mesh_.vertex_count() - 1);
  }

  const PatchSet& patches_;
  const CornerVertices& vertices_;
  std::span<const std::uint8_t> is_straight_;
  DisplayMesh& mesh_;
};

/// The patches by material, ascending within one. @param first  [material + 1] into the result
std::vector<std::uint32_t> patches_by_material(const PatchSet& patches,
                                               std::vector<std::size_t>* first) {
  for (const std::uint32_t material : patches.material)
    ++(*first)[material + 1];
  for (std::size_t k = 1; k < first->size(); ++k)
    (*first)[k] += (*first)[k - 1];
  std::vector<std::uint32_t> order(patches.patch_count());
  std::vector<std::size_t> next = *first;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    order[next[patches.material[patch]]++] = patch;
  return order;
}

} // namespace

Status build_display_mesh(const Scene& scene, const PatchSet& patches,
                          const CornerVertices& vertices, DisplayMesh* mesh) {
  *mesh = DisplayMesh{};
  Buffer<std::uint8_t> is_straight;
  HC_TRY(find_straight_corners(patches, &is_straight));
  MeshBuilder builder(patches, vertices, is_straight.span(), mesh);
  const DisplayBands display(scene.bands);
  for (std::size_t vertex = 0; vertex < vertices.count(); ++vertex) {
    const float* at = vertices.position(vertex);
    builder.add_vertex(
        {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])},
        display(vertices.radiosity(vertex)) / kPi);
  }
  std::vector<std::size_t> first_patch(std::size_t{scene.materials.size()} + 1);
  const std::vector<std::uint32_t> order = patches_by_material(patches, &first_patch);
  for (std::size_t material = 0; material + 1 < first_patch.size(); ++material) {
    mesh->first.push_back(mesh->triangles.size());
    for (std::size_t k = first_patch[material]; k < first_patch[material + 1]; ++k)
      builder.add_patch(order[k]);
  }
  mesh->first.push_back(mesh->triangles.size());
  return {};
}

} // namespace hemicube::radiosity
