#include "radiosity/cli/wedge_layer.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/output/patch_id_picture.h"
#include "raster/types.h"

#include <initializer_list>

namespace hemicube::radiosity::cli {
namespace {

constexpr Color kPastEdges = {240, 130, 20}, kPastCorners = {40, 110, 230};
constexpr int kFill = 48, kOutline = 200; ///< of 256

/// Appends triangles, seen from both sides, to a mesh.
class Triangles {
public:
  explicit Triangles(PatchSet* mesh) : mesh_(*mesh) {}

  Status add(const Vec3& a, const Vec3& b, const Vec3& c) {
    // A triangle that double precision cannot tell from a line has no place in a picture.
    const Vec3 across = glm::cross(b - a, c - a);
    if (!(glm::length(across) > 1e-12 * glm::length(b - a) * glm::length(c - a)))
      return {};
    HC_TRY(add_side({a, b, c}));
    return add_side({a, c, b});
  }

private:
  Status add_side(std::initializer_list<Vec3> points) {
    for (const Vec3& point : points) {
      HC_TRY(mesh_.corners.push_back(static_cast<std::uint32_t>(mesh_.vertices.size())));
      HC_TRY(mesh_.vertices.push_back(point));
    }
    return mesh_.corner_offsets.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
  }

  PatchSet& mesh_;
};

void blend(const Color& color, int share, std::uint8_t* pixel) {
  for (std::size_t channel = 0; channel < 3; ++channel)
    pixel[channel] =
        static_cast<std::uint8_t>((pixel[channel] * (256 - share) + color[channel] * share) / 256);
}

} // namespace

Status draw_wedges(Session* session, const Camera& camera, ColorImage* image) {
  const PatchSet& patches = session->loaded.patches;
  const std::uint32_t surfaces = patches.patch_count();
  PatchSet mesh; // the patches, then the wedges
  HC_TRY(mesh.vertices.assign(patches.vertices));
  HC_TRY(mesh.corners.assign(patches.corners));
  HC_TRY(mesh.corner_offsets.assign(patches.corner_offsets));
  Triangles triangles(&mesh);
  std::vector<bool> is_past_edge; // [wedge triangle]
  for (const DiscontinuityLine& line : session->loaded.lines) {
    if (line.light != EdgeLight::kBends)
      continue;
    HC_TRY(triangles.add(line.apex, line.begin, line.end));
    const bool from_corner = line.source[0] == line.apex;
    if (!from_corner)
      HC_TRY(triangles.add(line.apex, line.source[0], line.source[1]));
    is_past_edge.resize(mesh.corner_offsets.size() - 1 - surfaces, from_corner);
  }
  HC_TRY(mesh.area.resize(mesh.corner_offsets.size() - 1)); // the count of patches
  PatchIdPicture ids;
  HC_TRY(draw_patch_ids(mesh, camera, *session->line.options.kernels, session->workers(), &ids));
  // Both sides of a wedge are one thing.
  const auto thing = [&](std::size_t at) {
    const std::uint32_t id = ids.ids[at];
    return id == raster::kNoItem || id < surfaces ? 0 : 1 + (id - surfaces) / 2;
  };
  for (std::uint32_t y = 0; y < ids.height; ++y)
    for (std::uint32_t x = 0; x < ids.width; ++x) {
      const std::size_t at = std::size_t{y} * ids.width + x;
      const std::uint32_t own = thing(at);
      if (own == 0)
        continue;
      const bool is_outline = (x > 0 && thing(at - 1) != own) ||
                              (x + 1 < ids.width && thing(at + 1) != own) ||
                              (y > 0 && thing(at - ids.width) != own) ||
                              (y + 1 < ids.height && thing(at + ids.width) != own);
      blend(is_past_edge[2 * (own - 1)] ? kPastEdges : kPastCorners, is_outline ? kOutline : kFill,
            image->pixel(x, y));
    }
  return {};
}

} // namespace hemicube::radiosity::cli
