// The kernels, written once over the operations of an ops_<isa>.h that the including file has
// pulled into the enclosing namespace. No algorithmic choice depends on the vector width.

static void solve_rows(const RowProblem* problem, const RowSpans* spans) {
  const D first = d_set(problem->x_begin);
  const D end = d_set(problem->x_end);
  const D depth_per_row = d_set(problem->depth_per_row);
  const D depth_at_origin = d_set(problem->depth_at_origin);
  for (int32_t y = problem->row_begin; y < problem->row_end; y += kDoubles) {
    const D row = d_add(d_set(y), d_iota());
    D left = first;
    for (int32_t e = 0; e < problem->left_end; ++e)
      left = d_max(d_add(d_mul(d_set(problem->slope[e]), row), d_set(problem->offset[e])), left);
    D right = end;
    for (int32_t e = problem->right_begin; e < problem->edge_end; ++e)
      right = d_min(d_add(d_mul(d_set(problem->slope[e]), row), d_set(problem->offset[e])), right);
    const int32_t k = y - problem->row_begin;
    // Between these columns both ends fit an int32.
    d_store_ceil(spans->x_begin + k, d_min(left, end));
    d_store_ceil(spans->x_end + k, d_max(right, first));
    d_store_float(spans->depth + k, d_add(d_mul(depth_per_row, row), depth_at_origin));
  }
}

static void fill_rows(const FillProblem* problem, const RowSpans* spans) {
  const F zero = f_set(0.0f);
  const F slope = f_set(problem->depth_per_pixel);
  const U item = u_set(problem->item);
  uint32_t* items = problem->items;
  float* depths = problem->depths;
  for (int32_t k = 0; k < problem->row_count; ++k) {
    const int32_t end = spans->x_end[k];
    const F row_depth = f_set(spans->depth[k]);
    for (int32_t x = spans->x_begin[k]; x < end; x += kFloats) {
      const int32_t at = x - problem->origin_x;
      const F column = f_add(f_set(static_cast<float>(x)), f_iota());
      F depth = f_add(f_mul(slope, column), row_depth);
      depth = f_select(f_greater(depth, zero), depth, zero);
      const F old_depth = f_load(depths + at);
      const U old_item = u_load(items + at);
      const M nearer = m_or(f_greater(depth, old_depth),
                            m_and(f_equal(depth, old_depth), u_less(item, old_item)));
      const M wins = m_and(nearer, m_first(end - x));
      if (m_bits(wins) == 0)
        continue;
      f_store(depths + at, f_select(wins, depth, old_depth));
      u_store(items + at, u_select(wins, item, old_item));
    }
    items += problem->pitch;
    depths += problem->pitch;
  }
}

static float smallest(const float* values, int32_t pitch, int32_t width, int32_t height) {
  F least = f_load(values);
  for (int32_t y = 0; y < height; ++y)
    for (int32_t x = 0; x < width; x += kFloats)
      least = f_min(f_load(values + static_cast<int64_t>(y) * pitch + x), least);
  float lanes[kFloats];
  f_store(lanes, least);
  float result = lanes[0];
  for (int k = 1; k < kFloats; ++k)
    result = lanes[k] < result ? lanes[k] : result;
  return result;
}

static int32_t run_breaks(const uint32_t* items, int32_t count, int32_t* breaks) {
  int32_t found = 0;
  for (int32_t x = 1; x < count; x += kFloats) {
    const M same = u_equal(u_load(items + x), u_load(items + x - 1));
    uint32_t changes = ~m_bits(same) & m_bits(m_first(count - x));
    while (changes != 0) {
      breaks[found++] = x + __builtin_ctz(changes);
      changes &= changes - 1;
    }
  }
  return found;
}
