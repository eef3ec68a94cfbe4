#include "radiosity/output/patch_id_picture.h"

#include "radiosity/output/look_picture.h"
#include "radiosity/output/picture_blocks.h"

namespace hemicube::radiosity {

Status draw_patch_ids(const PatchSet& patches, const Camera& camera, const raster::Kernels& kernels,
                      Executor& executor, PatchIdPicture* picture) {
  CameraView view;
  HC_TRY(camera_view(camera, 1, &view));
  picture->width = camera.width;
  picture->height = camera.height;
  picture->ids.clear();
  HC_TRY(picture->ids.resize(std::size_t{camera.width} * camera.height));
  const auto copy = [&](const raster::ItemBuffer& buffer, const PixelBlock& block) {
    for (std::int32_t y = block.top; y < block.bottom; ++y)
      std::copy_n(buffer.items(y), block.right - block.left,
                  picture->ids.data() + static_cast<std::size_t>(y) * camera.width +
                      static_cast<std::size_t>(block.left));
  };
  return for_each_picture_block(patches, view, 1, 0, kernels, executor, copy);
}

Status patch_id_image(const PatchIdPicture& picture, ColorImage* image) {
  HC_TRY(image->init(picture.width, picture.height));
  for (std::size_t i = 0; i < picture.ids.size(); ++i)
    if (picture.ids[i] != raster::kNoItem)
      image->set(i % picture.width, i / picture.width, item_color(picture.ids[i]));
  return {};
}

} // namespace hemicube::radiosity
