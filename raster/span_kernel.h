#pragma once

// The seam between the algorithm and the instruction sets: plain data and function pointers.
// Included by the ISA files, so it includes nothing but <stdint.h>.
#include <stdint.h>

namespace hemicube::raster {

/// Row y of a polygon covers the pixels from the largest of its left crossings to the smallest of
/// its right crossings; edge e crosses the row at x = slope[e] y + offset[e], in pixels of the
/// grid.
struct RowProblem {
  const double* slope;
  const double* offset;
  int32_t left_end;    ///< edges 0 .. left_end-1 bound on the left
  int32_t right_begin; ///< edges right_begin .. edge_end-1 bound on the right
  int32_t edge_end;
  int32_t row_begin, row_end; ///< rows asked for, absolute
  int32_t x_begin, x_end;     ///< columns the polygon can touch, within the window, absolute
  double depth_per_row, depth_at_origin; ///< 1/z of pixel (0, y) is per_row * y + at_origin
};

/// Spans [x_begin[k], x_end[k]) of rows row_begin + k; empty if x_begin >= x_end. Both ends are
/// rounded up, so that neighbours share no pixel and leave none. Arrays hold kSpanPadding more
/// elements.
struct RowSpans {
  int32_t* x_begin;
  int32_t* x_end;
  float* depth; ///< 1/z of pixel (0, y)
};
enum { kSpanPadding = 16 };

/// Draws spans into planes of items and depths. A pixel is taken over if 1/z is larger, or equal
/// and the item is lower. Vectors may touch, and put back unchanged, up to 15 pixels past a span's
/// end.
struct FillProblem {
  uint32_t* items; ///< pixel (origin_x, row_begin)
  float* depths;
  int32_t pitch;    ///< elements from row to row
  int32_t origin_x; ///< column of element 0
  int32_t row_count;
  float depth_per_pixel;
  uint32_t item;
};

/// The kernels of one instruction set. Every one gives the same bits on every instruction set.
struct Kernels {
  const char* name;
  void (*solve_rows)(const RowProblem* problem, const RowSpans* spans);
  void (*fill_rows)(const FillProblem* problem, const RowSpans* spans);

  /// The smallest of width x height values, width a multiple of 8.
  float (*smallest)(const float* values, int32_t pitch, int32_t width, int32_t height);

  /// Writes the positions k in 1 .. count-1 with items[k] != items[k-1], ascending; returns how
  /// many.
  int32_t (*run_breaks)(const uint32_t* items, int32_t count, int32_t* breaks);
};

} // namespace hemicube::raster
