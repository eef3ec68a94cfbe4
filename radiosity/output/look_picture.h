#pragma once

#include "radiosity/hemicube/delta_form_factors.h"
#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/color_image.h"
#include "raster/simd/dispatch.h"
#include "raster/types.h"

#include <array>
#include <cstdint>

namespace hemicube::radiosity {

/// One face of a hemicube, row-major over raster::hemicube_grid.
struct FaceImage {
  Buffer<raster::Item> items;
  Buffer<float> depths; ///< 1/z along the face's axis; 0 = space
};

/// Everything a hemicube sees.
struct HemicubeImage {
  std::uint32_t resolution = 0;
  std::array<FaceImage, raster::kFaceCount> faces;
};

/// Renders the hemicube of a patch.
/// @param resolution  even, kMinResolution..kMaxResolution
/// @return kInvalidArgument, kOutOfMemory
Status render_hemicube(const PatchSet& patches, std::uint32_t patch, std::uint32_t resolution,
                       const raster::Kernels& kernels, HemicubeImage* image);

/// Where light is lost: colours that no item has.
inline constexpr Color kSpaceColor = {255, 0, 255}, kBackColor = {255, 0, 0};

/// Three panels side by side, each the unfolded hemicube: item colours (back-facing ones striped
/// with kBackColor, space kSpaceColor); depth (nearest white, by 1/z, space black); weight of each
/// pixel (the heaviest white).
/// @param weights  of the same resolution
/// @return kOutOfMemory
Status draw_look(const HemicubeImage& hemicube, const DeltaFormFactors& weights, ColorImage* image);

/// The colour of an item: by its id alone, never dark, different for the first 5 million ids.
Color item_color(std::uint32_t id) noexcept;

} // namespace hemicube::radiosity
