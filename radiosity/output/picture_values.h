#pragma once

#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// A quantity that pictures show.
enum class Quantity : std::uint8_t {
  kRadiance,   ///< L = B / pi, W/(m^2 sr): what an eye sees
  kRadiosity,  ///< B, W/m^2
  kIrradiance, ///< H, W/m^2
  kExitance,   ///< E, W/m^2
  kError       ///< how far B varies inside a patch; see picture_values()
};

/// What a picture shows of every patch.
struct PictureValues {
  Quantity quantity = Quantity::kRadiance;
  std::uint32_t band_count = 0;
  Buffer<double> patch; ///< [patch][band], W/m^2 (B where it is L that is shown); NaN = not known
  Buffer<float> corner; ///< [corner][band] the same, from vertex_radiosities(); NaN beside what is
                        ///< not known; empty: each patch shows its one value
};

/// Values of a quantity on a solution, reconstructed at the corners where it varies.
///
/// The error of a patch, in a band, is the largest difference between its constant radiosity and
/// its reconstructed corner values, over the area-weighted mean of B - E in that band: by how much
/// of the mean reflected light the mesh may be too coarse there. It is 0 where nothing is
/// reflected, and constant on a patch. Exitance is constant too.
/// @param flat  do not reconstruct: each patch shows what was computed
/// @return kOutOfMemory
Status picture_values(const PatchSet& patches, const Solution& solution, Quantity quantity,
                      bool flat, PictureValues* values);

/// Radiosity as pictures show it: where light is still unshot, with what the ambient term makes of
/// it (Cohen et al. 1988). Tables and PLY files never have it.
/// @return kOutOfMemory
Status displayed_values(const PatchSet& patches, const Solution& solution, PictureValues* values);

/// Patches of which a band is not known: they are drawn as background.
std::uint32_t unknown_count(const PictureValues& values) noexcept;

} // namespace hemicube::radiosity
