#include "radiosity/form_factor/seen_patches.h"

namespace hemicube::radiosity {

Facet reversed(const Facet& facet, ConvexPolygon* corners) noexcept {
  corners->count = 0;
  for (std::size_t k = facet.corners.size(); k-- > 0;)
    corners->append(facet.corners[k]);
  Facet back = facet;
  back.corners = corners->span();
  back.plane.normal = -facet.plane.normal;
  return back;
}

Status SeenTargets::find(const SceneFacets& scene, const Facet& receiver, std::uint32_t own_face,
                         std::span<const std::uint8_t> is_wanted, const PatchPiece* owner) {
  targets_.clear();
  blockers_.clear();
  own_face_ = own_face;
  owner_ = owner;
  const double tolerance = scene.tolerance();
  for (std::uint32_t face = 0; face < scene.face_count(); ++face) {
    const std::uint32_t first = scene.first_face_of(face);
    if (first == own_face || (!is_wanted.empty() && is_wanted[first] == 0))
      continue;
    const Facet& facet = scene.face(face);
    if (receiver.has_behind(facet, tolerance))
      continue;
    const bool shows_front = !facet.has_behind(receiver, tolerance);
    const bool shows_back = !facet.has_in_front(receiver, tolerance);
    if (shows_front && first == face)
      HC_TRY(find_front(scene, receiver, face));
    if (shows_back)
      HC_TRY(find_back(scene, receiver, face));
  }
  return {};
}

/// Fills between_.
Status SeenTargets::gather(const SceneFacets& scene, Shaft* shaft, std::uint32_t face,
                           bool* is_hidden) {
  between_.clear();
  *is_hidden = false;
  Status status;
  scene.tree().for_each_in_box(shaft->low(), shaft->high(), [&](std::uint32_t other) {
    const std::uint32_t first = scene.first_face_of(other);
    if (first == scene.first_face_of(face) || first == own_face_ || !scene.can_block(other))
      return true;
    ++test_count_;
    const Shaft::Verdict verdict = shaft->test(scene.face(other));
    *is_hidden = verdict == Shaft::Verdict::kBlocksAll;
    if (verdict == Shaft::Verdict::kMayBlock)
      status = between_.push_back(other);
    return status.ok() && !*is_hidden && between_.size() <= kMostBetween;
  });
  return status;
}

Status SeenTargets::find_front(const SceneFacets& scene, const Facet& receiver,
                               std::uint32_t face) {
  const auto pieces = scene.pieces_of(scene.patches_of(face)[0]);
  bool is_hidden = false;
  if (pieces.size() > 1) { // the patch is several faces: no shaft holds it all
    for (const PatchPiece& piece : pieces) {
      Shaft shaft(receiver, piece.facet, scene.tolerance());
      HC_TRY(gather(scene, &shaft, face, &is_hidden));
      if (!is_hidden)
        HC_TRY(add_piece(scene, receiver, face, piece));
    }
    return {};
  }
  Shaft shaft(receiver, scene.face(face), scene.tolerance());
  HC_TRY(gather(scene, &shaft, face, &is_hidden));
  if (is_hidden)
    return {};
  for (const std::uint32_t patch : scene.patches_of(face))
    for (const PatchPiece& piece : scene.pieces_of(patch))
      HC_TRY(add_piece(scene, receiver, face, piece));
  return {};
}

Status SeenTargets::add_piece(const SceneFacets& scene, const Facet& receiver, std::uint32_t face,
                              const PatchPiece& piece) {
  const double tolerance = scene.tolerance();
  if (owner_ != nullptr && are_mutual(*owner_, piece) && !owns_pair(*owner_, piece))
    return {};
  if (receiver.has_behind(piece.facet, tolerance) || piece.facet.has_behind(receiver, tolerance))
    return {};
  SeenTarget target;
  target.piece = &piece;
  target.face = face;
  target.first_blocker = blockers_.size();
  target.is_crowded = between_.size() > kMostBetween;
  if (!between_.empty() && !target.is_crowded) {
    Shaft shaft(receiver, piece.facet, tolerance);
    for (const std::uint32_t other : between_) {
      ++test_count_;
      const Shaft::Verdict verdict = shaft.test(scene.face(other));
      if (verdict == Shaft::Verdict::kBlocksAll) {
        while (blockers_.size() > target.first_blocker)
          blockers_.pop_back();
        return {};
      }
      if (verdict == Shaft::Verdict::kMayBlock)
        HC_TRY(blockers_.push_back({&scene.face(other), other, false}));
    }
  }
  // Of coincident fronts that of the lower id is seen.
  for (const std::uint32_t other : scene.overlaps_of(face))
    if (glm::dot(scene.face(other).plane.normal, piece.facet.plane.normal) > 0)
      for (const std::uint32_t copy : scene.patches_of(other))
        if (copy < piece.patch)
          for (const PatchPiece& part : scene.pieces_of(copy))
            HC_TRY(blockers_.push_back({&part.facet, other, true}));
  return add_target(&target);
}

/// Ends a target whose blockers are the last ones.
Status SeenTargets::add_target(SeenTarget* target) {
  target->blocker_count = blockers_.size() - target->first_blocker;
  if (target->is_crowded || target->blocker_count > kMostBlockers) {
    target->is_crowded = true;
    target->blocker_count = 0;
    while (blockers_.size() > target->first_blocker)
      blockers_.pop_back();
  }
  return targets_.push_back(*target);
}

Status SeenTargets::find_back(const SceneFacets& scene, const Facet& receiver, std::uint32_t face) {
  ConvexPolygon corners;
  const Facet back = reversed(scene.face(face), &corners);
  Shaft shaft(receiver, back, scene.tolerance());
  bool is_hidden = false;
  HC_TRY(gather(scene, &shaft, face, &is_hidden));
  if (is_hidden)
    return {};
  SeenTarget target;
  target.face = face;
  target.first_blocker = blockers_.size();
  for (const std::uint32_t other : between_)
    HC_TRY(blockers_.push_back({&scene.face(other), other, false}));
  // Fronts hide the backs of coincident faces; of coincident backs the lower one is seen.
  for (const std::uint32_t other : scene.overlaps_of(face))
    if (glm::dot(scene.face(other).plane.normal, back.plane.normal) > 0 || other < face)
      HC_TRY(blockers_.push_back({&scene.face(other), other, true}));
  return add_target(&target);
}

} // namespace hemicube::radiosity
