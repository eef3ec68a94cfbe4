#pragma once

#include "radiosity/form_factor/scene_facets.h"
#include "radiosity/form_factor/visible_part.h"

namespace hemicube::radiosity {

/// Whether two pieces say the same of each other. Of coincident fronts only that of the lowest id
/// is seen, but all see.
inline bool are_mutual(const PatchPiece& a, const PatchPiece& b) noexcept {
  return !a.is_covered && !b.is_covered;
}

/// Which of two pieces of one scene a pair belongs to: points are placed on the smaller one, where
/// less varies; of equal ones on that whose centre comes first, whatever the order of faces.
inline bool owns_pair(const PatchPiece& a, const PatchPiece& b) noexcept {
  if (a.area != b.area)
    return a.area < b.area;
  for (int axis = 0; axis < 3; ++axis)
    if (a.facet.centre[axis] != b.facet.centre[axis])
      return a.facet.centre[axis] < b.facet.centre[axis];
  return &a < &b;
}

/// A piece of a patch, or the back of a face, that a receiver may see, and what may be in between.
struct SeenTarget {
  const PatchPiece* piece = nullptr; ///< null for the back of a face
  std::uint32_t face = 0;
  bool is_back() const noexcept { return piece == nullptr; }
  std::size_t first_blocker = 0, blocker_count = 0; ///< none: provably seen whole
  bool is_crowded = false; ///< more may be in between than is worth looking at one by one
  bool is_whole() const noexcept { return blocker_count == 0 && !is_crowded; }
};

/// Finds what a receiver may see, by geometry alone. One per worker.
class SeenTargets {
public:
  /// @param receiver  a patch, or a point: a facet with a single corner
  /// @param own_face  the face the receiver lies on, which it does not see; kNoFace for none
  /// @param is_wanted  [face] 0 for those to leave out; empty = all are wanted
  /// @param owner      leaves out the pieces whose pairs with this one belong to them; null for
  /// none
  /// @return kOutOfMemory
  Status find(const SceneFacets& scene, const Facet& receiver, std::uint32_t own_face,
              std::span<const std::uint8_t> is_wanted, const PatchPiece* owner);

  std::span<const SeenTarget> targets() const noexcept { return targets_.span(); }
  std::span<const Blocker> blockers_of(const SeenTarget& target) const noexcept {
    return blockers_.span().subspan(target.first_blocker, target.blocker_count);
  }

  /// Facets that were tested against shafts since this was made.
  std::uint64_t test_count() const noexcept { return test_count_; }

  static constexpr std::uint32_t kNoFace = 0xffffffffu;
  /// Between two patches, and between a receiver and a face of many.
  static constexpr std::size_t kMostBlockers = 64, kMostBetween = 512;

private:
  Status find_front(const SceneFacets& scene, const Facet& receiver, std::uint32_t face);
  Status find_back(const SceneFacets& scene, const Facet& receiver, std::uint32_t face);
  Status gather(const SceneFacets& scene, Shaft* shaft, std::uint32_t face, bool* is_hidden);
  Status add_piece(const SceneFacets& scene, const Facet& receiver, std::uint32_t face,
                   const PatchPiece& piece);
  Status add_target(SeenTarget* target);

  Buffer<SeenTarget> targets_;
  Buffer<Blocker> blockers_;
  Buffer<std::uint32_t> between_; ///< faces that may lie between receiver and the face at hand
  std::uint32_t own_face_ = kNoFace;
  const PatchPiece* owner_ = nullptr;
  std::uint64_t test_count_ = 0;
};

/// The same facet seen from behind: corners reversed.
/// @param corners  receives them
Facet reversed(const Facet& facet, ConvexPolygon* corners) noexcept;

} // namespace hemicube::radiosity
