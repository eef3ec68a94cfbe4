#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/scene/scene.h"
#include "raster/face_view.h"

namespace hemicube::radiosity {

/// A camera as the rasterizer takes it. The frame is right-handed with axis_x to the right of the
/// picture, axis_y *down* it and axis_z forward, so that pixel (0, 0) is the picture's upper left.
struct CameraView {
  raster::View view;      ///< everything in front of the eye; back faces are not drawn
  raster::PixelGrid grid; ///< for Face::kTop
};

inline constexpr std::uint32_t kMaxSamples = 8;

/// @param samples  pixels of the grid along each side of a pixel of the picture, 1..kMaxSamples
/// @return kInvalidArgument for a camera that shows nothing: position and target equal, up along
/// the
///         view, field of view or size out of range, numbers not finite
/// Deterministic: + - * / sqrt only.
Status camera_view(const Camera& camera, std::uint32_t samples, CameraView* out);

/// A camera for a scene without one: outside the bounding box, looking at its centre, so near that
/// the box just fits. Of the sides +z, -z, +x, -x (with +y up), -y and +y (with +z up) it takes the
/// first one from which nearly the most area faces it (a later side must show 5 % more), and stands
/// a little to the right and above. Back faces are not drawn, so it looks into a closed room
/// through the wall, and into an open one through the opening.
Camera fit_camera(const PatchSet& patches, std::uint32_t width, std::uint32_t height);

} // namespace hemicube::radiosity
