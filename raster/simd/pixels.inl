// Drawing and reading pixels: lanes are rows of polygons while spans are found, then pixels.

/// Rows that are solved at a time, at most; at least those of 16 low polygons, or of a window.
constexpr int32_t kMaxSpans = 2 * kMaxWindowSize;

/// A polygon of no more rows shares vectors with others.
constexpr int32_t kLowRows = 6;

/// Rows of polygons, and their spans. Both ends were rounded up, so that neighbours share no pixel
/// and leave none.
struct SpanList {
  alignas(64) int32_t polygon[kMaxSpans + 16];
  alignas(64) int32_t row[kMaxSpans + 16];   ///< of the window
  alignas(64) int32_t count[kMaxSpans + 16]; ///< pixels
  // Of a span's first pixel:
  alignas(64) int32_t pixel[kMaxSpans + 16]; ///< index into the planes of the window
  alignas(64) float column[kMaxSpans + 16];  ///< of the grid
  alignas(64) float depth[kMaxSpans + 16];   ///< 1/z of pixel (0, row) of the grid
  // Indices of spans:
  alignas(64) int32_t narrow[kMaxSpans + 16]; ///< of 1 .. kFloats pixels
  alignas(64) int32_t wide[kMaxSpans + 16];   ///< of more
  int32_t size, narrow_size, wide_size;
};

/// Adds the rows first .. last - 1 of a polygon.
static inline void add_rows(int p, int32_t first, int32_t last, SpanList* spans) {
  uint32_t* polygon = reinterpret_cast<uint32_t*>(spans->polygon + spans->size);
  uint32_t* row = reinterpret_cast<uint32_t*>(spans->row + spans->size);
  for (int32_t k = 0; k < last - first; k += kFloats) {
    u_store(polygon + k, u_set(static_cast<uint32_t>(p)));
    u_store(row + k, u_add(u_set(static_cast<uint32_t>(first + k)), u_iota()));
  }
  spans->size += last - first;
}

/// Tables of a batch, for the polygons whose numbers are lanes.
struct OfLanes {
  I polygons;
  D operator()(const double* table) const { return d_lookup(table, polygons); }
};

/// The same for one polygon in all lanes.
struct OfOne {
  int polygon;
  D operator()(const double* table) const { return d_set(table[polygon]); }
};

/// Solves rows k .. k + kDoubles - 1 of the list.
/// @param corner_count  batch->corner_count, as a constant where that pays
/// @param end           rows from here on are none
template <typename Of>
static inline void solve_rows(const PolygonBatch* batch, Of of, int32_t corner_count,
                              const WindowPlanes* planes, int32_t k, int32_t end, SpanList* spans) {
  const D window_row = d_load_int(spans->row + k), row = d_add(window_row, d_set(planes->y));
  const D first = of(batch->x_first), last = of(batch->x_last);
  D left = first, right = last;
  const double* edge = batch->edges;
  for (int32_t c = 0; c < corner_count; ++c) {
    const D sloped = d_mul(of(edge), row);
    left = d_max(d_add(sloped, of(edge + kBatch)), left);
    right = d_min(d_add(sloped, of(edge + 2 * kBatch)), right);
    edge += 3 * kBatch;
  }
  // Between these columns both ends fit an int32.
  left = d_ceil(d_min(left, last));
  right = d_ceil(d_max(right, first));
  const D count = d_sub(right, left);
  d_store_int(spans->count + k, count);
  d_store_int(spans->pixel + k,
              d_add(d_mul(window_row, d_set(planes->pitch)), d_sub(left, d_set(planes->x))));
  d_store_float(spans->column + k, left);
  d_store_float(spans->depth + k,
                d_add(d_mul(of(batch->depth_per_row), row), of(batch->depth_at_origin)));
  const N inside = d_greater(d_set(end - k), d_iota());
  const N is_wide = n_and(inside, d_greater(count, d_set(kFloats)));
  const N is_narrow = n_and(n_and(inside, d_greater(count, d_set(0))), n_not(is_wide));
  spans->narrow_size += n_compress(spans->narrow + spans->narrow_size, k, is_narrow);
  if (n_bits(is_wide) != 0)
    spans->wide_size += n_compress(spans->wide + spans->wide_size, k, is_wide);
}

/// What all pixels of a span share.
struct Ink {
  F per_pixel, nearest, row_depth;
  U item;
};

static inline Ink ink_of(const PolygonBatch* batch, const SpanList* spans, int32_t k) {
  const int32_t p = spans->polygon[k];
  return {f_set(batch->depth_per_pixel[p]), f_set(batch->nearest[p]), f_set(spans->depth[k]),
          u_set(batch->item[p])};
}

/// Draws the first `count` of kFloats pixels.
/// @param columns  their columns in the grid
static inline void draw_pixels(const Ink& ink, F columns, int32_t count, uint32_t* items,
                               float* depths) {
  const F depth =
      f_min(f_max(f_add(f_mul(ink.per_pixel, columns), ink.row_depth), f_set(0.0f)), ink.nearest);
  const F old_depth = f_load(depths);
  const U old_item = u_load(items);
  const M nearer = m_or(f_greater(depth, old_depth),
                        m_and(f_equal(depth, old_depth), u_less(ink.item, old_item)));
  const M wins = m_and(nearer, m_first(count));
  f_store_where(depths, wins, depth, old_depth);
  u_store_where(items, wins, ink.item, old_item);
}

static inline void draw_spans(const PolygonBatch* batch, const SpanList* spans,
                              const WindowPlanes* planes) {
  for (int32_t j = 0; j < spans->narrow_size; ++j) {
    const int32_t k = spans->narrow[j], at = spans->pixel[k];
    draw_pixels(ink_of(batch, spans, k), f_add(f_set(spans->column[k]), f_iota()), spans->count[k],
                planes->items + at, planes->depths + at);
  }
  for (int32_t j = 0; j < spans->wide_size; ++j) {
    const int32_t k = spans->wide[j], count = spans->count[k];
    const Ink ink = ink_of(batch, spans, k);
    uint32_t* items = planes->items + spans->pixel[k];
    float* depths = planes->depths + spans->pixel[k];
    F columns = f_add(f_set(spans->column[k]), f_iota());
    for (int32_t x = 0; x < count; x += kFloats) {
      draw_pixels(ink, columns, count - x, items + x, depths + x);
      columns = f_add(columns, f_set(kFloats));
    }
  }
}

/// Solves and draws the polygons whose bits are set: lanes are rows of one of them, or, where they
/// are low, of several.
static inline void draw_polygons(const PolygonBatch* batch, uint32_t polygons, int32_t corner_count,
                                 const WindowPlanes* planes, SpanList* spans) {
  uint32_t high = 0;
  spans->size = spans->narrow_size = spans->wide_size = 0;
  for (uint32_t left = polygons; left != 0; left &= left - 1) {
    const int p = __builtin_ctz(left);
    const int32_t first = batch->y_begin[p] - planes->y, last = batch->y_end[p] - planes->y;
    if (last - first > kLowRows)
      high |= 1u << p;
    else
      add_rows(p, first, last, spans);
  }
  for (int32_t k = 0; k < 16; ++k) // what a vector takes beyond the end
    spans->polygon[spans->size + k] = 0;
  for (int32_t k = 0; k < spans->size; k += kDoubles)
    solve_rows(batch, OfLanes{i_load(spans->polygon + k)}, corner_count, planes, k, spans->size,
               spans);
  for (; high != 0; high &= high - 1) {
    const int p = __builtin_ctz(high);
    const int32_t first = batch->y_begin[p] - planes->y, last = batch->y_end[p] - planes->y;
    if (spans->size + last - first > kMaxSpans) {
      draw_spans(batch, spans, planes);
      spans->size = spans->narrow_size = spans->wide_size = 0;
    }
    int32_t k = spans->size;
    add_rows(p, first, last, spans);
    for (; k < spans->size; k += kDoubles)
      solve_rows(batch, OfOne{p}, corner_count, planes, k, spans->size, spans);
  }
  draw_spans(batch, spans, planes);
}

static void draw(const PolygonBatch* batch, uint32_t polygons, const WindowPlanes* planes) {
  SpanList spans;
  if (batch->corner_count == 4)
    draw_polygons(batch, polygons, 4, planes, &spans);
  else if (batch->corner_count == 3)
    draw_polygons(batch, polygons, 3, planes, &spans);
  else
    draw_polygons(batch, polygons, batch->corner_count, planes, &spans);
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
