#pragma once

#include "raster/face_view.h"
#include "raster/polygons.h"
#include "raster/types.h"
#include "tests/support/drawn_face.h"

#include <string>
#include <vector>

/// The oracle of the rasterizer: what a pixel sees, straight from the definition, in long double,
/// one polygon after the other. Slow, and without anything in common with the rasterizer but the
/// View.
namespace hemicube::test {

/// How far a drawn 1/z may be from the exact one, as a fraction of the largest 1/z its plane
/// reaches on the face: a few roundings to float, and the nudge that lets a facing polygon win over
/// a back-facing one wherever the two are equally deep up to rounding.
inline constexpr long double kDepthError = 2e-6L;

/// What the pixel sees and how safely that was decided.
struct NaivePixel {
  raster::Item item = raster::kNoItem;
  long double inverse_depth = 0; ///< 1/z of the item, z measured along the face's forward axis
  /// Distance in pixels of the pixel centre from the nearest edge that could change the answer,
  /// less what the rounding of corners to double may move that edge by.
  long double edge_margin = 0;
  /// Smallest difference in 1/z to any other polygon that covers the pixel and to the background,
  /// as a fraction of the largest 1/z the planes reach on the face; less what rounding may move the
  /// planes by.
  long double depth_gap = 0;
  long double depth_error = 0; ///< how far the drawn 1/z of the item may be off

  /// False where rounding may decide otherwise: the centre lies on an edge, or two surfaces meet
  /// there, or one that may be seen edge-on, or too near or too far for a float.
  bool decided() const { return edge_margin > 1e-6L && depth_gap > kDepthError; }
};

struct NaiveImage {
  int width = 0, height = 0;
  std::vector<NaivePixel> pixels; ///< [y][x]
  const NaivePixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Finds for every pixel of a face the nearest polygon whose cone (seen from the eye) holds the
/// pixel's direction. Honours View::skip and View::draw_backs; View::above_horizon changes nothing
/// on the faces of a hemicube, whose pixels all look above it.
NaiveImage naive_image(const raster::Polygons& polygons, const raster::View& view,
                       raster::Face face, const raster::PixelGrid& grid);

int undecided_count(const NaiveImage& image);

/// Where a drawn face is not what the oracle sees, as far as that is certain: the first such pixel,
/// and how many there are; empty if there is none.
std::string difference(const NaiveImage& naive, const DrawnFace& drawn);

} // namespace hemicube::test
