#include "radiosity/form_factor/ladder_setup.h"

#include "radiosity/form_factor/seen_patches.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

/// Scenes of more faces are looked at through an item buffer first: of what it does not show, the
/// geometry is not asked.
constexpr std::uint32_t kManyFaces = 2048;

/// What rung exact leaves of the visible share of a pair, and what integrals over unobstructed
/// areas may be off by, relative.
constexpr double kExactShare = 1e-6;
constexpr double kExactIntegral = 1e-10;
constexpr double kAreaIntegral = 1e-5;
/// Of rung adaptive: at most, and for each unit of its target.
constexpr double kLargestIntegral = 1e-4, kIntegralPerTarget = 2e-4;

/// The errors of the shares of pairs are estimated from above and add up as squares.
constexpr double kSharePerTarget = 1;

/// Cells that carry more than this of a form factor, or of the integral on rung exact, are always
/// cut: what their points do not show must not matter.
constexpr double kUnseenPerTarget = 0.1;
constexpr double kExactPart = 1.0 / 4096;

constexpr std::uint32_t kManyPoints = 1u << 16, kMostPoints = 1u << 22;

} // namespace

const char* rung_name(Rung rung) noexcept {
  constexpr const char* kNames[] = {"hemicube", "analytic", "area", "adaptive", "exact"};
  return kNames[static_cast<int>(rung)];
}

Status LadderSetup::init(RowGeometry* geometry_in, const RungSetting& setting_in,
                         const raster::Kernels& kernels, bool hash_items) {
  geometry = geometry_in;
  setting = setting_in;
  if (setting.rung != Rung::kHemicube)
    HC_TRY(geometry_in->need_facets());
  if (!needs_hemicubes())
    return {};
  HC_TRY(geometry_in->need_tree());
  return hemicube.init(geometry->tree(), setting.resolution, kernels, hash_items);
}

bool LadderSetup::needs_hemicubes() const noexcept {
  if (setting.rung == Rung::kHemicube)
    return true;
  const SceneFacets& facets = geometry->facets();
  return facets.anything_hides() &&
         (setting.rung <= Rung::kArea || facets.face_count() > SeenTargets::kMostBlockers);
}

bool LadderSetup::looks_first() const noexcept {
  return setting.rung != Rung::kHemicube && needs_hemicubes() &&
         geometry->facets().face_count() > kManyFaces;
}

Effort LadderSetup::effort(double form_factor) const noexcept {
  if (setting.rung == Rung::kExact)
    return {kExactShare, kExactPart, kMostPoints};
  return {kSharePerTarget * setting.target, kUnseenPerTarget * setting.target / form_factor,
          kManyPoints};
}

double LadderSetup::integral_error() const noexcept {
  if (setting.rung == Rung::kExact)
    return kExactIntegral;
  return setting.rung == Rung::kAdaptive
             ? std::min(kIntegralPerTarget * setting.target, kLargestIntegral)
             : kAreaIntegral;
}

} // namespace hemicube::radiosity
