#pragma once

#include "radiosity/output/look_picture.h"
#include "raster/face_view.h"

namespace hemicube::radiosity {

/// Where the light of a patch is lost, as the pixels of its hemicube show it.
struct HemicubeLosses {
  double space = 0; ///< fraction of the hemisphere
  Vec3 space_towards{0, 0,
                     0}; ///< unit, in the axes of the scene: the direction in which space weighs
                         ///< most, so that one certainly sees it there; 0 if none is seen

  struct Back {
    std::uint32_t patch;
    double fraction;
  };
  Buffer<Back> backs; ///< whose backs are seen, most first, of equal ones the lower patch
};

/// @param weights  of the hemicube's resolution
/// @param view     that the hemicube was rendered from
/// @return kOutOfMemory
Status find_losses(const HemicubeImage& hemicube, const DeltaFormFactors& weights,
                   const raster::View& view, HemicubeLosses* losses);

} // namespace hemicube::radiosity
