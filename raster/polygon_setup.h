#pragma once

#include "raster/face_view.h"
#include "raster/memory.h"
#include "raster/polygons.h"
#include "raster/span_kernel.h"
#include "raster/tile.h"

namespace hemicube::raster {

/// A polygon as a view sees it.
struct ViewPolygon {
  Vec3 depth{0, 0, 0}; ///< 1/z along direction d is dot(depth, d), both in the view's axes
  std::uint32_t id = 0;
  std::uint8_t faces = 0; ///< bit f: it may show in hemicube face f
  bool facing = false;    ///< its front is turned to the eye
};

/// All polygons of a set transformed into a view: once per hemicube, whatever the number of faces.
class ViewSetup {
public:
  Status init(const Polygons& polygons);

  void prepare(const Polygons& polygons, std::span<const Plane> planes, const View& view);

  /// The polygons that may be drawn, by ascending id.
  std::span<const ViewPolygon> drawn() const noexcept { return {polygons_.data(), count_}; }

  /// Position of a vertex relative to the eye, in the view's axes.
  const Vec3& vertex(std::uint32_t index) const noexcept { return vertices_[index]; }

  /// Normal of the plane through the eye and the edge that starts at a corner; a direction d with
  /// dot(edge, d) > 0 lies inside if the polygon is facing, outside if not. The edge of the
  /// neighbour, which runs the other way, has exactly the negated normal.
  const Vec3& edge(std::size_t corner) const noexcept { return edges_[corner]; }

private:
  void transform_vertices(const Polygons& polygons, const View& view);
  bool set_up(const Polygons& polygons, const Plane& plane, const View& view, std::uint32_t id,
              ViewPolygon* polygon);

  Buffer<Vec3> vertices_;          ///< [vertex]
  Buffer<std::uint16_t> outcodes_; ///< [vertex] sides of the planes that bound the faces
  Buffer<Vec3> edges_;             ///< [corner]
  Buffer<ViewPolygon> polygons_;
  std::size_t count_ = 0;
};

/// A polygon as one window of a face sees it: all the kernels need. Every floating-point decision
/// about coverage and depth is made here, once, from the same numbers for both sides of an edge.
struct FacePolygon {
  RowProblem rows{};
  float depth_per_pixel = 0;
  float nearest = 0; ///< 1/z is nowhere larger in the window
  TileRange tiles;   ///< all it can touch
};

/// Room for the edges of one polygon in a face.
struct EdgeScratch {
  Buffer<double> slope, offset;
  Status init(const Polygons& polygons);
};

/// @return false if the polygon covers no pixel of the window
bool set_up_in_face(const Polygons& polygons, const ViewSetup& setup, const ViewPolygon& polygon,
                    Face face, const PixelGrid& grid, const Window& window, EdgeScratch* scratch,
                    FacePolygon* result);

} // namespace hemicube::raster
