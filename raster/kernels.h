#pragma once

// The seam between the algorithm and the instruction sets: plain data and function pointers.
// Included by the ISA files, so it includes nothing but <stdint.h>.
#include <stdint.h>

namespace hemicube::raster {

/// Polygons are handled 16 at a time, and so are the children of a node: one vector of floats on
/// the widest instruction set.
enum { kBatch = 16 };

/// Boxes of up to kBatch children, relative to the origin of their tree.
struct alignas(64) Node {
  float center[3][kBatch];
  float half[3][kBatch];  ///< half extents; negative where there is no child
  float axis[3][kBatch];  ///< mean unit normal of the fronts of a cluster's polygons
  float spread[kBatch];   ///< how far a unit normal can be from the axis; 2 = anything
  uint32_t child[kBatch]; ///< index of a node, or of a cluster
  int32_t count;
  uint32_t clusters; ///< bit c: child c is a cluster
};

/// What a window of a face sees, for boxes: single precision, every bound widened by what rounding
/// can do.
struct NodeProblem {
  float eye[3];        ///< relative to the origin of the tree
  float slack;         ///< boxes are grown by this on all sides
  float inward[5][3];  ///< planes through the eye, normals inwards: 4 window sides, the horizon
  int32_t plane_count; ///< 4 without a horizon
  float frame[3][3];   ///< right, up, forward
  float x_scale, x_offset, y_scale, y_offset; ///< column of the window = x/z * scale + offset
  float columns, rows;                        ///< of the window
  int32_t find_away;                          ///< NodeResult::away is asked for
};

/// What a node's children may touch of a window.
struct alignas(64) NodeResult {
  float nearest[kBatch];                  ///< 1/z is nowhere larger
  int32_t x_begin[kBatch], x_end[kBatch]; ///< pixels of the window
  int32_t y_begin[kBatch], y_end[kBatch];
  uint32_t reached; ///< bit c: child c may touch the window
  uint32_t away;    ///< bit c: all polygons of child c, a cluster, are seen from the back
};

/// Up to kBatch polygons, in double.
struct Cluster {
  const double* corners; ///< [corner][axis][kBatch]; polygons with fewer corners repeat their last
  const double* planes;  ///< [normal x y z, point x y z, -1 if Plane::reversed, else 1][kBatch]
  const uint32_t* ids;   ///< [kBatch]
  int32_t corner_count;
  uint32_t present; ///< bit p: there is a polygon p
};

/// A polygon whose plane passes the eye at less than this fraction of its farthest vertex' distance
/// is seen edge-on: it covers nothing, and its depth would be rounding errors.
constexpr double kThroughEye = 0x1p-45;

/// A polygon is edge-on to the receiver when no vertex rises above its plane by more than this
/// fraction of its distance.
constexpr double kEdgeOn = 0x1p-20;

/// A window of a face and the frame it looks along, for polygons.
struct WindowProblem {
  double eye[3];
  double frame[3][3];                    ///< right, up, forward
  double skip_normal[3], skip_point[3];  ///< the plane left out; NaN = none
  double x0, dx, y0, dy;                 ///< PixelGrid
  double columns_per_x, rows_per_y;      ///< 1/dx, 1/dy
  double x_begin, x_end, y_begin, y_end; ///< pixels of the grid
  double unit;                ///< a power of 2: times this, coordinates are at most about 1
  double x_reach, y_reach;    ///< bounds of |x| and |y| over the grid, for the error of a depth
  double edge_on_to_eye;      ///< larger squares of distances per unit of normal are not edge-on
  double edge_on_to_receiver; ///< nor are larger heights above the receiver's plane
  int32_t above_horizon, horizon_axis; ///< axis of the frame that is the receiver's normal
  int32_t draw_backs;
};

/// Pixels of a window, at most, along each side.
constexpr int32_t kMaxWindowSize = 256;

/// Hierarchical z: of each tile, a square of pixels counted from the window's corner, the depth of
/// the farthest pixel is kept.
constexpr int32_t kTileShift = 4, kTileSize = 1 << kTileShift;
constexpr int32_t kTilesPerRow = kMaxWindowSize / kTileSize;

/// Polygons as one window of a face sees them: all that drawing needs. Every floating-point
/// decision about coverage and depth is made here, once, from the same numbers for both sides of an
/// edge.
struct PolygonBatch {
  /// [corner][slope, offset as a left edge, offset as a right edge][kBatch]: a row y lies between
  /// the largest left and the smallest right slope * y + offset.
  double* edges;
  int32_t corner_count;
  alignas(64) int32_t x_begin[kBatch], x_end[kBatch]; ///< pixels of the grid
  alignas(64) int32_t y_begin[kBatch], y_end[kBatch];
  alignas(64) double facing[kBatch];                  ///< 1 if the front is seen, else -1
  alignas(64) double x_first[kBatch], x_last[kBatch]; ///< x_begin, x_end
  alignas(64) double depth_per_row[kBatch], depth_at_origin[kBatch]; ///< 1/z of pixel (0, y)
  alignas(64) float depth_per_pixel[kBatch];
  alignas(64) float depth_error[kBatch]; ///< rounding moves 1/z of a pixel by less
  alignas(64) float nearest[kBatch];     ///< 1/z of a pixel is cut off here
  alignas(64) uint32_t item[kBatch];
};

/// The planes of one window, and the farthest depth of each tile.
struct WindowPlanes {
  uint32_t* items; ///< pixel (x, y) of the window at y * pitch + x
  float* depths;
  int32_t pitch;
  int32_t x, y; ///< of the grid: the window's corner
  int32_t height;
  float* farthest; ///< [tile row][kTilesPerRow]
  uint32_t* dirty; ///< [tile row] bit x: farthest is out of date
};

/// Pixels, or tiles, x0..x1 by y0..y1 of a window, both ends included.
struct Range {
  int32_t x0, y0, x1, y1;
};

/// The tiles that pixels lie in.
inline Range tiles_of(const Range& pixels) {
  return {pixels.x0 >> kTileShift, pixels.y0 >> kTileShift, pixels.x1 >> kTileShift,
          pixels.y1 >> kTileShift};
}

/// What is already drawn over some tiles: nothing that covers one, something, or all that is
/// behind.
enum class Occlusion : int32_t { kOpen, kCovered, kHidden };

/// The kernels of one instruction set. Every one gives the same bits on every instruction set.
struct Kernels {
  const char* name;

  void (*test_node)(const Node* node, const NodeProblem* problem, NodeResult* result);

  /// Moves a cluster's corners into the frame of a window, [corner][axis][kBatch], followed by the
  /// same as floats, and finds which pixels its polygons can touch, and how deep they lie: all of
  /// the batch but edges and items.
  /// @return bit p: polygon p may cover a pixel
  uint32_t (*find_bounds)(const Cluster* cluster, const WindowProblem* problem, double* moved,
                          PolygonBatch* batch);

  /// Finds edges and items of the polygons whose bits are set.
  void (*set_up)(const Cluster* cluster, const WindowProblem* problem, const double* moved,
                 uint32_t polygons, PolygonBatch* batch);

  /// Draws the polygons of a batch whose bits are set. A pixel is taken over if 1/z is larger, or
  /// equal and the item is lower. Vectors may touch, and put back unchanged, up to 15 pixels past a
  /// row's end.
  void (*draw)(const PolygonBatch* batch, uint32_t polygons, const WindowPlanes* planes);

  /// What the pixels hold, for something nowhere nearer than 1/z = nearest.
  Occlusion (*occlusion)(const WindowPlanes* planes, const Range* pixels, float nearest);

  /// @return bit p: polygon p of the batch, one of those whose bits are set, is behind what its
  /// tiles
  ///         already hold
  uint32_t (*hidden)(const PolygonBatch* batch, uint32_t polygons, const WindowPlanes* planes);

  /// Splits a row of items into runs of equal items and then clears the row: items to kNoItem,
  /// depths to 0. Writes where each run begins, the first at 0, and what it holds; both arrays have
  /// room for 16 more than `count`. Element -1 of the row is read.
  /// @return the number of runs
  int32_t (*take_runs)(uint32_t* items, float* depths, int32_t count, int32_t* begins,
                       uint32_t* run_items);
};

} // namespace hemicube::raster
