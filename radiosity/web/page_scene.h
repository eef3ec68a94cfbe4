#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/scene/scene.h"

namespace hemicube::radiosity::web {

/// What the page is made of: a scene that was read and meshed where there are readers.
struct PageScene {
  Scene scene;         ///< materials, bands and the camera; no faces
  PatchSet patches;    ///< as read: without backs, and without what measure_patches() fills
  double exposure = 1; ///< of the picture; fixed, so that light is seen to grow
};

/// All of it as plain bytes, lowest first. @param bytes  receives them
/// @return kOutOfMemory
Status pack_page_scene(const PageScene& page, Buffer<std::byte>* bytes);

/// The same again, patches measured and backs added.
/// @return kBadScene if the bytes are not those of pack_page_scene(); kOutOfMemory
Status unpack_page_scene(std::span<const std::byte> bytes, PageScene* page);

} // namespace hemicube::radiosity::web
