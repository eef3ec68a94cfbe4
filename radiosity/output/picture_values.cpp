#include "radiosity/output/picture_values.h"

#include "radiosity/elementary.h"
#include "radiosity/output/vertex_radiosity.h"

#include <cmath>
#include <limits>

namespace hemicube::radiosity {
namespace {

/// The area-weighted mean of B - E in a band.
double mean_reflected(const PatchSet& patches, const Solution& solution, std::uint32_t band) {
  double light = 0, area = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const std::size_t at = std::size_t{patch} * solution.band_count + band;
    light += patches.area[patch] * (solution.radiosity[at] - solution.exitance[at]);
    area += patches.area[patch];
  }
  return light / area;
}

Status error_values(const PatchSet& patches, const Solution& solution, Buffer<double>* error) {
  const std::uint32_t bands = solution.band_count;
  Buffer<float> corner;
  HC_TRY(vertex_radiosities(patches, solution.radiosity, bands, &corner));
  error->clear();
  HC_TRY(error->resize(solution.radiosity.size()));
  for (std::uint32_t band = 0; band < bands; ++band) {
    const double mean = mean_reflected(patches, solution, band);
    if (!(mean > 0))
      continue;
    for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
      const std::size_t at = std::size_t{patch} * bands + band;
      double largest = 0;
      for (std::size_t k = patches.corner_offsets[patch]; k < patches.corner_offsets[patch + 1];
           ++k)
        largest = max_number(largest, std::fabs(static_cast<double>(corner[k * bands + band]) -
                                                solution.radiosity[at]));
      (*error)[at] = largest / mean;
    }
  }
  return {};
}

/// Reconstructs values of which some are not known: NaN at the corners that would need those.
Status reconstruct_known(const PatchSet& patches, PictureValues* values) {
  Buffer<double> filled, known;
  Buffer<float> known_corner; // exactly 1 where all around is known
  HC_TRY(filled.assign(values->patch));
  HC_TRY(known.resize(filled.size(), 1));
  for (std::size_t at = 0; at < filled.size(); ++at)
    if (std::isnan(filled[at]))
      filled[at] = known[at] = 0;
  HC_TRY(vertex_radiosities(patches, filled, values->band_count, &values->corner));
  HC_TRY(vertex_radiosities(patches, known, values->band_count, &known_corner));
  for (std::size_t at = 0; at < known_corner.size(); ++at)
    if (known_corner[at] != 1)
      values->corner[at] = std::numeric_limits<float>::quiet_NaN();
  return {};
}

} // namespace

Status picture_values(const PatchSet& patches, const Solution& solution, Quantity quantity,
                      bool flat, PictureValues* values) {
  values->quantity = quantity;
  values->band_count = solution.band_count;
  values->corner.clear();
  if (quantity == Quantity::kError)
    return error_values(patches, solution, &values->patch);
  if (quantity == Quantity::kExitance)
    return values->patch.assign(solution.exitance);
  HC_TRY(values->patch.assign(quantity == Quantity::kIrradiance ? solution.irradiance
                                                                : solution.radiosity));
  if (flat)
    return {};
  if (unknown_count(*values) != 0)
    return reconstruct_known(patches, values);
  return vertex_radiosities(patches, values->patch, values->band_count, &values->corner);
}

Status displayed_values(const PatchSet& patches, const Solution& solution, PictureValues* values) {
  *values = {};
  values->band_count = solution.band_count;
  HC_TRY(values->patch.assign(solution.radiosity));
  for (std::size_t at = 0; at < values->patch.size() && !solution.ambient.empty(); ++at)
    values->patch[at] += solution.reflectance[at] * solution.ambient[at % solution.band_count];
  return vertex_radiosities(patches, values->patch, values->band_count, &values->corner);
}

std::uint32_t unknown_count(const PictureValues& values) noexcept {
  std::uint32_t count = 0;
  for (std::size_t first = 0; first < values.patch.size(); first += values.band_count) {
    bool known = true;
    for (std::uint32_t band = 0; band < values.band_count; ++band)
      known = known && !std::isnan(values.patch[first + band]);
    count += known ? 0 : 1;
  }
  return count;
}

} // namespace hemicube::radiosity
