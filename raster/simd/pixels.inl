// Drawing and reading pixels: lanes are rows while spans are found, then pixels.

enum { kMaxRows = 256 };

/// The spans of a polygon's rows, in pixels of the grid. Both ends were rounded up, so that
/// neighbours share no pixel and leave none.
struct RowSpans {
  int32_t begin[kMaxRows + 16], count[kMaxRows + 16];
  float depth[kMaxRows + 16]; ///< 1/z of pixel (0, y)
};

/// @param corner_count  batch->corner_count, as a constant where that pays
static inline void find_spans(const PolygonBatch* batch, int p, int32_t corner_count,
                              RowSpans* spans) {
  const D first = d_set(batch->x_begin[p]), last = d_set(batch->x_end[p]), zero = d_set(0);
  const D depth_per_row = d_set(batch->depth_per_row[p]);
  const D depth_at_origin = d_set(batch->depth_at_origin[p]);
  const int32_t top = batch->y_begin[p], count = batch->y_end[p] - top;
  for (int32_t k = 0; k < count; k += kDoubles) {
    const D row = d_add(d_set(top + k), d_iota());
    D left = first, right = last;
    const double* edge = batch->edges + p;
    for (int32_t c = 0; c < corner_count; ++c) {
      left = d_max(d_add(d_mul(d_set(edge[0]), row), d_set(edge[kBatch])), left);
      right = d_min(d_add(d_mul(d_set(edge[2 * kBatch]), row), d_set(edge[3 * kBatch])), right);
      edge += 4 * kBatch;
    }
    // Between these columns both ends fit an int32.
    left = d_ceil(d_min(left, last));
    right = d_ceil(d_max(right, first));
    d_store_int(spans->begin + k, left);
    d_store_int(spans->count + k, d_max(d_sub(right, left), zero));
    d_store_float(spans->depth + k, d_add(d_mul(depth_per_row, row), depth_at_origin));
  }
}

/// What all pixels of a polygon share.
struct Ink {
  F per_pixel, nearest;
  U item;
};

/// Draws the first `count` of kFloats pixels.
/// @param columns  their columns in the grid
static inline void draw_pixels(const Ink* ink, const float* columns, F row_depth, int32_t count,
                               uint32_t* items, float* depths) {
  const F depth = f_min(
      f_max(f_add(f_mul(ink->per_pixel, f_load(columns)), row_depth), f_set(0.0f)), ink->nearest);
  const F old_depth = f_load(depths);
  const U old_item = u_load(items);
  const M nearer = m_or(f_greater(depth, old_depth),
                        m_and(f_equal(depth, old_depth), u_less(ink->item, old_item)));
  const M wins = m_and(nearer, m_first(count));
  f_store_where(depths, wins, depth, old_depth);
  u_store_where(items, wins, ink->item, old_item);
}

static inline void draw_spans(const PolygonBatch* batch, int p, const RowSpans* spans,
                              const WindowPlanes* planes) {
  const Ink ink = {f_set(batch->depth_per_pixel[p]), f_set(batch->nearest[p]),
                   u_set(batch->item[p])};
  const int32_t count = batch->y_end[p] - batch->y_begin[p];
  const int64_t start =
      static_cast<int64_t>(batch->y_begin[p] - planes->y) * planes->pitch - planes->x;
  const float* columns = planes->columns - planes->x;
  uint32_t* items = planes->items + start;
  float* depths = planes->depths + start;
  if (batch->x_end[p] - batch->x_begin[p] <= kFloats) {
    for (int32_t k = 0; k < count; ++k) {
      const int32_t x = spans->begin[k];
      draw_pixels(&ink, columns + x, f_set(spans->depth[k]), spans->count[k], items + x,
                  depths + x);
      items += planes->pitch;
      depths += planes->pitch;
    }
    return;
  }
  for (int32_t k = 0; k < count; ++k) {
    const F row_depth = f_set(spans->depth[k]);
    int32_t x = spans->begin[k];
    for (int32_t left = spans->count[k]; left > 0; left -= kFloats, x += kFloats)
      draw_pixels(&ink, columns + x, row_depth, left, items + x, depths + x);
    items += planes->pitch;
    depths += planes->pitch;
  }
}

static void draw(const PolygonBatch* batch, uint32_t polygons, const WindowPlanes* planes) {
  RowSpans spans;
  for (; polygons != 0; polygons &= polygons - 1) {
    const int p = __builtin_ctz(polygons);
    switch (batch->corner_count) {
    case 3:
      find_spans(batch, p, 3, &spans);
      break;
    case 4:
      find_spans(batch, p, 4, &spans);
      break;
    default:
      find_spans(batch, p, batch->corner_count, &spans);
    }
    draw_spans(batch, p, &spans, planes);
  }
}

static int32_t take_runs(uint32_t* items, float* depths, int32_t count, int32_t* begins,
                         uint32_t* run_items) {
  int32_t found = 0;
  for (int32_t x = 0; x < count; x += kFloats) {
    const U here = u_load(items + x);
    const M same = u_equal(here, u_load(items + x - 1));
    M begin = m_and(m_not(same), m_first(count - x));
    if (x == 0)
      begin = m_or(begin, m_first(1));
    u_compress(reinterpret_cast<uint32_t*>(begins + found),
               u_add(u_set(static_cast<uint32_t>(x)), u_iota()), begin);
    u_compress(run_items + found, here, begin);
    found += __builtin_popcount(m_bits(begin));
  }
  const U nothing = u_set(0xffffffffu);
  const F far_away = f_set(0.0f);
  for (int32_t x = 0; x < count; x += kFloats) {
    u_store(items + x, nothing);
    f_store(depths + x, far_away);
  }
  return found;
}
