#pragma once

#include "radiosity/output/color_image.h"
#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// Which patch the middle of each pixel shows, rows from the top.
struct PatchIdPicture {
  std::uint32_t width = 0, height = 0;
  Buffer<std::uint32_t> ids; ///< [row][column]; raster::kNoItem for background
};

/// One sample a pixel: a mean of two patches is none. Back faces are not drawn.
/// @return kInvalidArgument for a camera that shows nothing; kOutOfMemory
Status draw_patch_ids(const PatchSet& patches, const Camera& camera, const raster::Kernels& kernels,
                      Executor& executor, PatchIdPicture* picture);

/// Every patch in its item_color(), background black.
/// @return kOutOfMemory
Status patch_id_image(const PatchIdPicture& picture, ColorImage* image);

} // namespace hemicube::radiosity
