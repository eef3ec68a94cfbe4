// Kernels over boxes, in single precision: which children of a node a window sees, and which tiles
// hide them. They only ever decide what need not be drawn.

static inline F f_dot(const float* a, const F* b) {
  return f_add(f_add(f_mul(f_set(a[0]), b[0]), f_mul(f_set(a[1]), b[1])), f_mul(f_set(a[2]), b[2]));
}

static inline F f_absolute_dot(const float* a, const F* b) {
  return f_add(f_add(f_mul(f_abs(f_set(a[0])), b[0]), f_mul(f_abs(f_set(a[1])), b[1])),
               f_mul(f_abs(f_set(a[2])), b[2]));
}

/// Bounds of the projections of boxes, in pixels of the window.
struct BoxBounds {
  F x_low, x_high, y_low, y_high, z_low;
};

/// @param center  in the frame of the window
/// @param sides   half sides, in the frame of the window: [side][axis]
static inline BoxBounds project_boxes(const F* center, const F (*sides)[3]) {
  BoxBounds b = {f_set(1e30f), f_set(-1e30f), f_set(1e30f), f_set(-1e30f), f_set(1e30f)};
  for (int corner = 0; corner < 8; ++corner) {
    F v[3];
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = center[axis];
      for (int side = 0; side < 3; ++side)
        v[axis] = (corner >> side & 1) != 0 ? f_add(v[axis], sides[side][axis])
                                            : f_sub(v[axis], sides[side][axis]);
    }
    const F inverse = f_div(f_set(1.0f), v[2]);
    const F x = f_mul(v[0], inverse), y = f_mul(v[1], inverse);
    b.x_low = f_min(x, b.x_low);
    b.x_high = f_max(x, b.x_high);
    b.y_low = f_min(y, b.y_low);
    b.y_high = f_max(y, b.y_high);
    b.z_low = f_min(v[2], b.z_low);
  }
  return b;
}

/// Writes the pixels from one fraction of a side of the window to another, clipped to the window.
static inline void store_pixels(F a, F b, float scale, float offset, float size, M everything,
                                int32_t* begin, int32_t* end) {
  const F margin = f_set(0.25f), zero = f_set(0.0f), whole = f_set(size);
  const F p = f_add(f_mul(a, f_set(scale)), f_set(offset));
  const F q = f_add(f_mul(b, f_set(scale)), f_set(offset));
  const F low = f_sub(f_min(p, q), margin), high = f_add(f_max(p, q), margin);
  // Truncation rounds down what is not negative; the end is the pixel after.
  f_store_int(begin, f_select(everything, zero, f_min(f_max(low, zero), whole)));
  f_store_int(end,
              f_select(everything, whole, f_min(f_max(f_add(high, f_set(1.0f)), zero), whole)));
}

static void test_node(const Node* node, const NodeProblem* problem, NodeResult* result) {
  result->reached = 0;
  result->away = 0;
  const F slack = f_set(problem->slack), zero = f_set(0.0f);
  for (int32_t first = 0; first < node->count; first += kFloats) {
    F center[3], half[3];
    for (int axis = 0; axis < 3; ++axis) {
      center[axis] = f_sub(f_load(node->center[axis] + first), f_set(problem->eye[axis]));
      half[axis] = f_add(f_load(node->half[axis] + first), slack);
    }
    M outside = m_not(m_first(node->count - first));
    for (int32_t k = 0; k < problem->plane_count; ++k) {
      const float* plane = problem->inward[k];
      outside =
          m_or(outside, f_greater(zero, f_add(f_dot(plane, center), f_absolute_dot(plane, half))));
    }
    const uint32_t reached = ~m_bits(outside) & ((1u << kFloats) - 1);
    if (reached == 0)
      continue;

    F v[3], sides[3][3];
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = f_dot(problem->frame[axis], center);
      for (int side = 0; side < 3; ++side)
        sides[side][axis] = f_mul(f_set(problem->frame[axis][side]), half[side]);
    }
    const BoxBounds b = project_boxes(v, sides);
    const M behind = m_not(f_greater(b.z_low, slack));
    store_pixels(b.x_low, b.x_high, problem->x_scale, problem->x_offset, problem->columns, behind,
                 result->x_begin + first, result->x_end + first);
    store_pixels(b.y_low, b.y_high, problem->y_scale, problem->y_offset, problem->rows, behind,
                 result->y_begin + first, result->y_end + first);
    const F nearest = f_div(f_set(1.0f + 0x1p-15f), b.z_low);
    f_store(result->nearest + first, f_select(behind, f_set(3e38f), nearest));
    result->reached |= reached << first;

    if (problem->find_away != 0) {
      F axis[3], spread_by = f_set(0.0f), towards = f_set(0.0f), across = f_set(0.0f);
      for (int k = 0; k < 3; ++k) {
        axis[k] = f_load(node->axis[k] + first);
        towards = f_add(towards, f_mul(axis[k], center[k]));
        across = f_add(across, f_mul(f_abs(axis[k]), half[k]));
        spread_by = f_add(spread_by, f_add(f_abs(center[k]), half[k]));
      }
      const F least = f_sub(f_sub(towards, across), f_mul(f_load(node->spread + first), spread_by));
      result->away |= m_bits(f_greater(least, zero)) << first;
    }
  }
  result->away &= result->reached;
}

/// The smallest depth of a tile; 0 if a pixel is empty.
static float farthest_of_tile(const WindowPlanes* planes, int32_t x, int32_t y) {
  constexpr int32_t size = kTileSize;
  const int32_t rows = planes->height - y * size < size ? planes->height - y * size : size;
  const float* depths = planes->depths + static_cast<int64_t>(y) * size * planes->pitch + x * size;
  // Mostly a tile that is not covered yet shows it in a corner.
  const float* last = depths + static_cast<int64_t>(rows - 1) * planes->pitch;
  if (depths[0] == 0 || depths[size - 1] == 0 || last[0] == 0 || last[size - 1] == 0)
    return 0;
  F least = f_set(3e38f);
  for (int32_t row = 0; row < rows; ++row) {
    for (int32_t k = 0; k < size; k += kFloats)
      least = f_min(f_load(depths + k), least);
    depths += planes->pitch;
  }
  float lanes[kFloats];
  f_store(lanes, least);
  float result = lanes[0];
  for (int k = 1; k < kFloats; ++k)
    result = lanes[k] < result ? lanes[k] : result;
  return result;
}

/// Depths only ever come nearer: what was found for a tile before is still a bound, and is brought
/// up to date only where it would decide.
static inline bool tile_hides(const WindowPlanes* planes, int32_t x, int32_t y, float nearest) {
  float* farthest = planes->farthest + y * kTilesPerRow + x;
  const uint32_t bit = 1u << x;
  if (!(*farthest > nearest) && (planes->dirty[y] & bit) != 0) {
    *farthest = farthest_of_tile(planes, x, y);
    planes->dirty[y] &= ~bit;
  }
  return *farthest > nearest;
}

static inline int32_t larger(int32_t a, int32_t b) {
  return a > b ? a : b;
}
static inline int32_t smaller(int32_t a, int32_t b) {
  return a < b ? a : b;
}

/// Whether nothing at 1/z = nearest would be seen in the pixels that lie in a tile. A tile that
/// reaches beyond them says too little.
static bool pixels_hide(const WindowPlanes* planes, const Range* pixels, int32_t x, int32_t y,
                        float nearest) {
  constexpr int32_t shift = kTileShift, last = kTileSize - 1;
  const int32_t x0 = larger(pixels->x0, x << shift), x1 = smaller(pixels->x1, (x << shift) + last);
  const int32_t y0 = larger(pixels->y0, y << shift), y1 = smaller(pixels->y1, (y << shift) + last);
  if (x1 - x0 == last && y1 - y0 == last)
    return false;
  const float* depths = planes->depths + static_cast<int64_t>(y0) * planes->pitch;
  for (int32_t row = y0; row <= y1; ++row, depths += planes->pitch)
    for (int32_t k = x0; k <= x1; k += kFloats) {
      const M seen =
          m_and(m_first(x1 + 1 - k), m_not(f_greater(f_load(depths + k), f_set(nearest))));
      if (m_bits(seen) != 0)
        return false;
    }
  return true;
}

static Occlusion occlusion(const WindowPlanes* planes, const Range* pixels, float nearest) {
  const Range tiles = tiles_of(*pixels);
  const uint32_t columns =
      static_cast<uint32_t>((uint64_t{2} << tiles.x1) - (uint64_t{1} << tiles.x0));
  bool some_covered = false;
  for (int32_t y = tiles.y0; y <= tiles.y1; ++y) {
    const float* farthest = planes->farthest + y * kTilesPerRow;
    uint32_t covered = 0, hiding = 0;
    for (int32_t x = tiles.x0 & -kFloats; x <= tiles.x1; x += kFloats) {
      covered |= m_bits(f_greater(f_load(farthest + x), f_set(0.0f))) << x;
      hiding |= m_bits(f_greater(f_load(farthest + x), f_set(nearest))) << x;
    }
    some_covered = some_covered || (covered & columns) != 0;
    for (uint32_t left = columns & ~hiding; left != 0; left &= left - 1) {
      const int x = __builtin_ctz(left);
      if (!tile_hides(planes, x, y, nearest) && !pixels_hide(planes, pixels, x, y, nearest))
        return some_covered || farthest[x] != 0 ? Occlusion::kCovered : Occlusion::kOpen;
    }
  }
  return Occlusion::kHidden;
}

/// Testing more tiles than this costs more than drawing.
constexpr int32_t kMaxTilesTested = 16;

static inline bool is_hidden(const PolygonBatch* batch, int p, const WindowPlanes* planes) {
  constexpr int32_t shift = kTileShift;
  const int32_t x_begin = batch->x_begin[p] - planes->x, x_last = batch->x_end[p] - planes->x - 1;
  const int32_t y_begin = batch->y_begin[p] - planes->y, y_last = batch->y_end[p] - planes->y - 1;
  const Range tiles = {x_begin >> shift, y_begin >> shift, x_last >> shift, y_last >> shift};
  if ((tiles.x1 - tiles.x0 + 1) * (tiles.y1 - tiles.y0 + 1) > kMaxTilesTested)
    return false;
  const double per_row = batch->depth_per_row[p];
  const double per_pixel = static_cast<double>(batch->depth_per_pixel[p]);
  const double at_corner = batch->depth_at_origin[p] + per_row * planes->y + per_pixel * planes->x +
                           static_cast<double>(batch->depth_error[p]);
  for (int32_t y = tiles.y0; y <= tiles.y1; ++y)
    for (int32_t x = tiles.x0; x <= tiles.x1; ++x) {
      // The nearest point of the plane over the polygon's part of the tile.
      const int32_t row =
          per_row > 0 ? smaller(y_last, ((y + 1) << shift) - 1) : larger(y_begin, y << shift);
      const int32_t column =
          per_pixel > 0 ? smaller(x_last, ((x + 1) << shift) - 1) : larger(x_begin, x << shift);
      const auto depth = static_cast<float>(at_corner + per_row * row + per_pixel * column);
      // Within the bounds that pixels are drawn with: at depth 0 an empty pixel hides nothing.
      const float least = depth < batch->nearest[p] ? depth : batch->nearest[p];
      const float nearest = least > 0 ? least : 0;
      if (!tile_hides(planes, x, y, nearest))
        return false;
    }
  return true;
}

static uint32_t hidden(const PolygonBatch* batch, uint32_t polygons, const WindowPlanes* planes) {
  uint32_t found = 0;
  for (; polygons != 0; polygons &= polygons - 1) {
    const int p = __builtin_ctz(polygons);
    found |= (is_hidden(batch, p, planes) ? 1u : 0u) << p;
  }
  return found;
}
