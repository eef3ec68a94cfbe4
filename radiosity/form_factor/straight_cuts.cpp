#include "radiosity/form_factor/straight_cuts.h"

#include "radiosity/mesh/polygon_shape.h"

namespace hemicube::radiosity {
namespace {

constexpr int kMostAroundAVertex = 64;
constexpr std::uint64_t kStepsPerHalfEdge = 16; // of all cuts together: they must end

// A line must be shorter by this much to be preferred to the other: not by rounding.
constexpr double kShorter = 0.9;

class Cutter {
public:
  explicit Cutter(CoplanarMesh* mesh)
      : mesh_(*mesh), steps_left_(kStepsPerHalfEdge * mesh->half_edge_count()) {}

  Status run();

private:
  bool is_reflex(std::uint32_t arriving) const;
  Status follow(std::uint32_t arriving, const Vec3& direction, Buffer<std::uint32_t>* path);
  bool turn_away(std::uint32_t* leaving);
  std::uint32_t straight_on(std::uint32_t arriving, const Vec3& start, const Vec3& direction,
                            bool* at_outline);
  double length(const Buffer<std::uint32_t>& path) const;

  double resolution(std::uint32_t h) const { return mesh_.cell(mesh_.cell_of(h)).resolution; }
  const Vec3& normal(std::uint32_t h) const { return mesh_.cell(mesh_.cell_of(h)).plane.normal; }

  CoplanarMesh& mesh_;
  std::uint64_t steps_left_;
};

Status Cutter::run() {
  Buffer<std::uint32_t> on, back;
  for (std::uint32_t h = 0; h < mesh_.half_edge_count() && steps_left_ > 0; ++h) {
    if (mesh_.twin(h) != kNoHalfEdge || mesh_.twin(mesh_.next(h)) == kNoHalfEdge)
      continue; // not at the outline, or a corner of one cell
    std::uint32_t leaving = mesh_.next(h);
    if (!turn_away(&leaving) || mesh_.twin(leaving) != kNoHalfEdge)
      continue;
    if (turn_side(normal(h), resolution(h) / 2, mesh_.vector(h), mesh_.vector(leaving)) >= 0)
      continue;
    HC_TRY(follow(h, mesh_.vector(h), &on));
    HC_TRY(follow(h, -mesh_.vector(leaving), &back));
    const bool use_back = !back.empty() && (on.empty() || length(back) < kShorter * length(on));
    for (const std::uint32_t cut : use_back ? back : on)
      mesh_.part(cut);
  }
  return {};
}

/// From a half-edge that leaves a vertex, on around the vertex through the cells on its right, to
/// the one without a twin. False if there is none near.
bool Cutter::turn_away(std::uint32_t* leaving) {
  for (int k = 0; k < kMostAroundAVertex; ++k) {
    const std::uint32_t twin = mesh_.twin(*leaving);
    if (twin == kNoHalfEdge)
      return true;
    *leaving = mesh_.next(twin);
    steps_left_ -= steps_left_ > 0;
  }
  return false;
}

/// The half-edge that leaves the end of another in a direction; kNoHalfEdge if there is none.
/// @param at_outline  receives whether the outline was met on the way around the vertex
std::uint32_t Cutter::straight_on(std::uint32_t arriving, const Vec3& start, const Vec3& direction,
                                  bool* at_outline) {
  *at_outline = false;
  std::uint32_t leaving = mesh_.next(arriving);
  for (int k = 0; k < kMostAroundAVertex; ++k) {
    steps_left_ -= steps_left_ > 0;
    const Vec3 reached = mesh_.position(mesh_.to(leaving)) - start;
    if (glm::dot(mesh_.vector(leaving), direction) > 0 &&
        turn_side(normal(leaving), resolution(leaving) / 2, direction, reached) == 0)
      return leaving;
    const std::uint32_t twin = mesh_.twin(leaving);
    *at_outline = twin == kNoHalfEdge;
    if (twin == kNoHalfEdge || twin == arriving)
      return kNoHalfEdge;
    leaving = mesh_.next(twin);
  }
  return kNoHalfEdge;
}

/// The paired half-edges from the end of another straight on to the outline; none if they do not
/// get there.
Status Cutter::follow(std::uint32_t arriving, const Vec3& direction, Buffer<std::uint32_t>* path) {
  path->clear();
  const Vec3 start = mesh_.position(mesh_.to(arriving));
  bool at_outline = false;
  for (std::uint32_t h = arriving; steps_left_ > 0;) {
    h = straight_on(h, start, direction, &at_outline);
    if (h == kNoHalfEdge)
      break;
    if (mesh_.twin(h) == kNoHalfEdge) // the outline itself goes on in that direction
      return {};
    HC_TRY(path->push_back(h));
  }
  if (!at_outline)
    path->clear();
  return {};
}

double Cutter::length(const Buffer<std::uint32_t>& path) const {
  const Vec3 start = mesh_.position(mesh_.from(path[0]));
  return glm::length(mesh_.position(mesh_.to(path.end()[-1])) - start);
}

} // namespace

Status cut_at_reflex_corners(CoplanarMesh* mesh) {
  return Cutter(mesh).run();
}

} // namespace hemicube::radiosity
