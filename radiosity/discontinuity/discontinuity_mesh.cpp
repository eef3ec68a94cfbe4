#include "radiosity/discontinuity/discontinuity_mesh.h"

#include "radiosity/discontinuity/contact_lines.h"
#include "radiosity/discontinuity/patch_cutter.h"
#include "radiosity/discontinuity/shadow_lines.h"
#include "raster/fp_environment.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace hemicube::radiosity {
namespace {

/// Of the root of a patch's area: how exactly contacts are met.
constexpr double kContactSnap = 0x1p-14;
constexpr double kSnapPart = 32;
constexpr std::uint64_t kFewElements = 20000, kMostPieces = 4;

class DiscontinuityMesher {
public:
  DiscontinuityMesher(const Scene& scene, const PatchSet& patches,
                      const DiscontinuityLimits& limits, DiscontinuityReport* report)
      : scene_(scene), patches_(patches), report_(*report) {
    report_ = {};
    report_.limits = limits;
  }

  Status find(std::vector<DiscontinuityLine>* lines);
  Status cut(std::span<const DiscontinuityLine> lines, PatchSet* elements);

private:
  Status check();
  template <typename Visit> void for_each_patch(const DiscontinuityLine& line, Visit visit) const;
  bool is_lit(std::uint32_t patch, const DiscontinuityLine& line) const {
    return line.on_front || scene_.two_sided[patches_.material[patch]] != 0;
  }
  double snap_of(std::uint32_t patch, const DiscontinuityLine& line) const {
    const double resolved = 4 * edges_.depth(line.face);
    return std::max(resolved, line.light == EdgeLight::kJumps
                                  ? kContactSnap * std::sqrt(patches_.area[patch])
                                  : report_.limits.snap);
  }

  const Scene& scene_;
  const PatchSet& patches_;
  DiscontinuityReport& report_;
  SceneFacets facets_;
  OccluderEdges edges_;
};

Status DiscontinuityMesher::check() {
  DiscontinuityLimits& limits = report_.limits;
  if (!(limits.snap >= 0 && std::isfinite(limits.snap)))
    return Status::error(StatusCode::kInvalidArgument, "lines closer than ", limits.snap,
                         " cannot be one: give a length, or 0 for one that is chosen");
  const std::uint64_t patches = patches_.patch_count();
  if (patches_.front_count != patches)
    return Status::error(StatusCode::kInvalidArgument,
                         "cut patches before their backs are added, not after");
  if (limits.max_elements == 0)
    limits.max_elements = std::max(kFewElements, kMostPieces * patches);
  if (limits.max_elements < patches)
    return Status::error(StatusCode::kInvalidArgument, "at most ", limits.max_elements,
                         " elements are allowed, but there are ", patches,
                         " patches to begin with: allow more, or give a coarser mesh");
  if (limits.snap == 0) { // a mean would be that of one large floor under many small things
    std::vector<double> areas(patches_.area.begin(), patches_.area.end());
    std::sort(areas.begin(), areas.end());
    limits.snap = std::sqrt(areas[areas.size() / 2]) / kSnapPart;
  }
  return {};
}

Status DiscontinuityMesher::find(std::vector<DiscontinuityLine>* lines) {
  HC_TRY(check());
  HC_TRY(facets_.build(patches_));
  HC_TRY(edges_.build(facets_));
  lines->clear();
  find_contact_lines(edges_, lines);
  report_.contact_lines = lines->size();
  std::vector<EmitterFace> emitters;
  HC_TRY(find_emitters(scene_, patches_, &emitters));
  report_.emitters = emitters.size();
  ShadowLineReport wedges;
  double power = 0, treated = 0;
  for (const EmitterFace& emitter : emitters) {
    power += emitter.power;
    if (report_.emitters_treated == report_.limits.max_emitters)
      continue;
    ++report_.emitters_treated;
    treated += emitter.power;
    find_shadow_lines(edges_, emitter, report_.limits.max_wedges, lines, &wedges);
  }
  report_.power_treated = power > 0 ? treated / power : 0;
  report_.wedges = wedges.wedges;
  report_.wedges_skipped = wedges.wedges_skipped;
  report_.shadow_lines = lines->size() - report_.contact_lines;
  std::stable_sort(lines->begin(), lines->end(),
                   [](const DiscontinuityLine& a, const DiscontinuityLine& b) {
                     return a.light != b.light ? a.light > b.light : a.strength > b.strength;
                   });
  return {};
}

Status DiscontinuityMesher::cut(std::span<const DiscontinuityLine> lines, PatchSet* elements) {
  PatchCutter cutter;
  HC_TRY(cutter.init(patches_));
  std::size_t done = 0;
  for (; done < lines.size() && cutter.cell_count() < report_.limits.max_elements; ++done)
    for_each_patch(lines[done], [&](std::uint32_t patch, double snap) {
      cutter.cut(patch, lines[done].begin, lines[done].end, lines[done].light, snap);
    });
  report_.lines_skipped = lines.size() - done;
  for (const DiscontinuityLine& line : lines.first(done))
    for_each_patch(line, [&](std::uint32_t patch, double snap) {
      cutter.note_light(patch, line.begin, line.end, line.light, snap);
    });
  report_.patches = patches_.patch_count();
  report_.elements = cutter.cell_count();
  return cutter.make_mesh(elements);
}

/// Calls visit(patch, snap) for the patches that a line may run through and that are lit there.
template <typename Visit>
void DiscontinuityMesher::for_each_patch(const DiscontinuityLine& line, Visit visit) const {
  const Vec3 low = glm::min(line.begin, line.end), high = glm::max(line.begin, line.end);
  for (const std::uint32_t patch : facets_.patches_of(line.face)) {
    if (!is_lit(patch, line))
      continue;
    const double snap = snap_of(patch, line);
    bool is_near = false;
    for (const PatchPiece& piece : facets_.pieces_of(patch)) {
      bool overlaps = true;
      for (int axis = 0; axis < 3; ++axis)
        overlaps = overlaps && low[axis] <= piece.facet.high[axis] + snap &&
                   piece.facet.low[axis] <= high[axis] + snap;
      is_near = is_near || overlaps;
    }
    if (is_near)
      visit(patch, snap);
  }
}

} // namespace

Status cut_discontinuities(const Scene& scene, const PatchSet& patches,
                           const DiscontinuityLimits& limits, PatchSet* elements,
                           std::vector<DiscontinuityLine>* lines, DiscontinuityReport* report) {
  const FloatEnvironment environment;
  try {
    DiscontinuityMesher mesher(scene, patches, limits, report);
    HC_TRY(mesher.find(lines));
    return mesher.cut(*lines, elements);
  } catch (const std::bad_alloc&) {
    return Status::error(StatusCode::kOutOfMemory,
                         "out of memory looking for the borders of shadows on ",
                         patches.patch_count(), " patches");
  }
}

} // namespace hemicube::radiosity
