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

    if (node->leaf != 0) {
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
  const int32_t size = 1 << planes->tile_shift;
  const int32_t rows = planes->height - y * size < size ? planes->height - y * size : size;
  const float* depths = planes->depths + static_cast<int64_t>(y) * size * planes->pitch + x * size;
  // Mostly a tile that is not covered yet shows it in a corner.
  const float* last = depths + static_cast<int64_t>(rows - 1) * planes->pitch;
  if (depths[0] == 0 || depths[size - 1] == 0 || last[0] == 0 || last[size - 1] == 0)
    return 0;
  F least = f_set(3e38f);
  const M inside = m_first(size);
  for (int32_t row = 0; row < rows; ++row) {
    for (int32_t k = 0; k < size; k += kFloats)
      least = f_min(f_select(inside, f_load(depths + k), least), least);
    depths += planes->pitch;
  }
  float lanes[kFloats];
  f_store(lanes, least);
  float result = lanes[0];
  for (int k = 1; k < kFloats; ++k)
    result = lanes[k] < result ? lanes[k] : result;
  return result;
}

static inline uint32_t hiding_tiles(const float* farthest, float nearest, uint32_t columns) {
  uint32_t hiding = 0;
  for (int32_t x = 0; x < kBatch; x += kFloats)
    hiding |= m_bits(f_greater(f_load(farthest + x), f_set(nearest))) << x;
  return hiding & columns;
}

static Occlusion occlusion(const WindowPlanes* planes, const TileRange* tiles, float nearest) {
  const uint32_t columns = (2u << tiles->x1) - (1u << tiles->x0);
  uint32_t some = 0;
  for (int32_t y = tiles->y0; y <= tiles->y1; ++y) {
    float* farthest = planes->farthest + y * kBatch;
    // Depths only ever come nearer: what was found before is still a bound.
    uint32_t hiding = hiding_tiles(farthest, nearest, columns);
    some |= hiding;
    for (uint32_t open = columns & ~hiding; open != 0; open &= open - 1) {
      const uint32_t bit = open & -open;
      if ((planes->dirty[y] & bit) == 0)
        return some != 0 ? Occlusion::kPartial : Occlusion::kNone;
      const int x = __builtin_ctz(open);
      farthest[x] = farthest_of_tile(planes, x, y);
      planes->dirty[y] = static_cast<uint16_t>(planes->dirty[y] & ~bit);
      if (!(farthest[x] > nearest))
        return some != 0 ? Occlusion::kPartial : Occlusion::kNone;
      some |= bit;
    }
  }
  return Occlusion::kFull;
}
