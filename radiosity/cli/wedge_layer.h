#pragma once

#include "radiosity/cli/session.h"
#include "radiosity/output/color_image.h"

namespace hemicube::radiosity::cli {

/// Draws the wedges of light that the session's patches were cut along over an image of what a
/// camera sees: translucent, their outlines stronger. From corners of emitters past edges in
/// orange, from edges of emitters past corners in blue.
/// @param image  of the camera's size
Status draw_wedges(Session* session, const Camera& camera, ColorImage* image);

} // namespace hemicube::radiosity::cli
