#pragma once

#include "tests/support/drawn_face.h"
#include "tests/support/scenes_shared.h"

#include <string>
#include <vector>

namespace hemicube::test {

/// One grid to draw.
struct Drawing {
  raster::Face face;
  raster::PixelGrid grid;
};

/// A view, and what is drawn of it.
struct Look {
  raster::View view;
  std::vector<Drawing> drawings;
};

/// The five faces of a hemicube.
std::vector<Drawing> hemicube_drawings(std::uint32_t resolution);

/// The one grid of a camera.
/// @param half_height  of the picture at distance 1
/// @param downwards    row 0 is the topmost of the face, and dy negative
Drawing camera_drawing(int width, int height, double half_height, bool downwards);

/// Draws all of a look, face by face, with one begin.
std::vector<DrawnFace> draw_look(Drawer* drawer, const Look& look,
                                 int window_width = raster::kMaxWindowSize,
                                 int window_height = raster::kMaxWindowSize);

/// What a look must show, from the definition: every polygon is drawn alone by the scalar kernels,
/// without culling, and every pixel takes the largest 1/z, among equals the lowest item. The
/// view's switches are applied here, not by the rasterizer: what is below the horizon, seen from
/// its back, or has the vertices of the receiver.
std::vector<DrawnFace> composed_look(const PolygonSet& polygons, const Look& look);

/// Where two drawings differ first, and in how many pixels; empty if no bit differs.
std::string difference(const DrawnFace& expected, const DrawnFace& actual);

/// The same for all drawings of a look, with the view and the grid.
std::string difference(const Look& look, const std::vector<DrawnFace>& expected,
                       const std::vector<DrawnFace>& actual);

} // namespace hemicube::test
