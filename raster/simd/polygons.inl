// Set-up of polygons in a window, in double: lanes are polygons.

/// A polygon whose plane passes the eye at less than this fraction of its farthest vertex' distance
/// is seen edge-on: it covers nothing, and its depth would be rounding errors.
constexpr double kThroughEye = 0x1p-45;

/// A polygon is edge-on to the receiver when no vertex rises above its plane by more than this
/// fraction of its distance.
constexpr double kEdgeOn = 0x1p-20;

/// Rounding cannot carry an edge further than this, in pixels, past the ends of its projection.
constexpr double kPixelMargin = 0x1p-4;

/// A crossing that bounds nothing.
constexpr double kNowhere = 1e300;

static inline D d_dot(D ax, D ay, D az, D bx, D by, D bz) {
  return d_add(d_add(d_mul(ax, bx), d_mul(ay, by)), d_mul(az, bz));
}

static inline D d_set_dot(const double* a, D x, D y, D z) {
  return d_dot(d_set(a[0]), d_set(a[1]), d_set(a[2]), x, y, z);
}

/// What the corners of kDoubles polygons have in common.
struct CornerSummary {
  D x_low, x_high, y_low, y_high; ///< pixels; meaningless where a corner is not in front
  D nearest;                      ///< largest 1/z; likewise
  D farthest;                     ///< largest squared distance
  N some_in_front, all_in_front, some_above;
};

/// Moves corners into the frame of the window: [corner][axis][kBatch].
static inline CornerSummary move_corners(const double* corners, int32_t corner_count,
                                         const WindowProblem* w, double* moved) {
  const D zero = d_set(0), one = d_set(1);
  CornerSummary s = {
      d_set(kNowhere), d_set(-kNowhere), d_set(kNowhere), d_set(-kNowhere), zero, zero,
      n_none(),        n_not(n_none()),  n_none()};
  const int up = w->horizon_axis, across = 3 - up; // 1 or 2: the axes besides `right`
  for (int32_t c = 0; c < corner_count; ++c) {
    const D x = d_sub(d_load(corners), d_set(w->eye[0]));
    const D y = d_sub(d_load(corners + kBatch), d_set(w->eye[1]));
    const D z = d_sub(d_load(corners + 2 * kBatch), d_set(w->eye[2]));
    D v[3];
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = d_dot(x, y, z, d_set(w->frame[axis][0]), d_set(w->frame[axis][1]),
                      d_set(w->frame[axis][2]));
      d_store(moved + axis * kBatch, v[axis]);
    }
    // In this order the sum is the same for every face of a hemicube.
    const D height_squared = d_mul(v[up], v[up]);
    const D distance_squared =
        d_add(d_add(d_mul(v[0], v[0]), d_mul(v[across], v[across])), height_squared);
    s.farthest = d_max(distance_squared, s.farthest);
    const D edge_on = d_mul(d_set(kEdgeOn * kEdgeOn), distance_squared);
    s.some_above =
        n_or(s.some_above, n_and(d_greater(v[up], zero), d_greater(height_squared, edge_on)));

    const N in_front = d_greater(v[2], zero);
    s.some_in_front = n_or(s.some_in_front, in_front);
    s.all_in_front = n_and(s.all_in_front, in_front);
    const D inverse = d_div(one, v[2]);
    s.nearest = d_max(inverse, s.nearest);
    const D column = d_mul(d_sub(d_mul(v[0], inverse), d_set(w->x0)), d_set(w->columns_per_x));
    const D row = d_mul(d_sub(d_mul(v[1], inverse), d_set(w->y0)), d_set(w->rows_per_y));
    s.x_low = d_min(column, s.x_low);
    s.x_high = d_max(column, s.x_high);
    s.y_low = d_min(row, s.y_low);
    s.y_high = d_max(row, s.y_high);
    corners += 3 * kBatch;
    moved += 3 * kBatch;
  }
  return s;
}

/// Polygons that lie, as far as they are in front, beyond one side of the window by a pixel.
static inline N beyond_a_side(const double* moved, int32_t corner_count, const WindowProblem* w) {
  const D zero = d_set(0);
  N left = n_not(n_none()), right = left, below = left, above = left;
  for (int32_t c = 0; c < corner_count; ++c, moved += 3 * kBatch) {
    const D z = d_load(moved + 2 * kBatch);
    const D column = d_mul(d_sub(d_load(moved), d_mul(z, d_set(w->x0))), d_set(w->columns_per_x));
    const D row =
        d_mul(d_sub(d_load(moved + kBatch), d_mul(z, d_set(w->y0))), d_set(w->rows_per_y));
    left = n_and(left, d_greater(zero, d_sub(column, d_mul(d_set(w->x_begin - 1), z))));
    right = n_and(right, d_greater(d_sub(column, d_mul(d_set(w->x_end), z)), zero));
    below = n_and(below, d_greater(zero, d_sub(row, d_mul(d_set(w->y_begin - 1), z))));
    above = n_and(above, d_greater(d_sub(row, d_mul(d_set(w->y_end), z)), zero));
  }
  return n_or(n_or(left, right), n_or(below, above));
}

/// Writes where the edges cross the rows.
static inline void set_up_edges(const double* moved, int32_t corner_count, const WindowProblem* w,
                                D facing_sign, double* edges) {
  const D zero = d_set(0), x0 = d_set(w->x0), y0 = d_set(w->y0), dx = d_set(w->dx),
          dy = d_set(w->dy);
  for (int32_t c = 0; c < corner_count; ++c) {
    const double* a = moved + c * 3 * kBatch;
    const double* b = c + 1 < corner_count ? a + 3 * kBatch : moved;
    D sum[3], difference[3];
    for (int axis = 0; axis < 3; ++axis) {
      const D from = d_load(a + axis * kBatch), to = d_load(b + axis * kBatch);
      sum[axis] = d_add(from, to);
      difference[axis] = d_sub(from, to);
    }
    // (a + b) x (a - b): -2 a x b without its cancellation, and exactly negated for the neighbour,
    // who walks the edge the other way.
    const D nx = d_sub(d_mul(sum[1], difference[2]), d_mul(difference[1], sum[2]));
    const D ny = d_sub(d_mul(sum[2], difference[0]), d_mul(difference[2], sum[0]));
    const D nz = d_sub(d_mul(sum[0], difference[1]), d_mul(difference[0], sum[1]));
    D per_x = d_mul(nx, dx);
    const D per_y = d_mul(ny, dy);
    const D constant = d_add(nz, d_add(d_mul(nx, x0), d_mul(ny, y0)));
    // An edge along the rows, or nearly: tilted just enough to divide by, the same way for both of
    // its polygons.
    const D least = d_mul(d_set(0x1p-60), d_add(d_abs(per_y), d_abs(constant)));
    const D tilt = d_copysign(least, d_select(d_equal(per_x, zero), per_y, per_x));
    per_x = d_select(d_greater(least, d_abs(per_x)), tilt, per_x);
    const D slope = d_div(d_negate(per_y), per_x);
    const D offset = d_div(d_negate(constant), per_x);
    // Where it is still 0 the edge points at the eye: it bounds nothing.
    const D side = d_mul(per_x, facing_sign);
    const N left = d_greater(side, zero), right = d_greater(zero, side);
    d_store(edges, d_select(left, slope, zero));
    d_store(edges + kBatch, d_select(left, offset, d_set(-kNowhere)));
    d_store(edges + 2 * kBatch, d_select(right, slope, zero));
    d_store(edges + 3 * kBatch, d_select(right, offset, d_set(kNowhere)));
    edges += 4 * kBatch;
  }
}

/// Writes the pixels a polygon can cover.
/// @return those with any
static inline N store_bounds(D low, D high, N known, double begin, double end, int32_t* first,
                             int32_t* last) {
  const D from = d_set(begin), to = d_set(end), margin = d_set(kPixelMargin);
  low = d_select(known, d_min(d_max(d_sub(low, margin), from), to), from);
  high = d_select(known, d_max(d_min(d_add(high, margin), to), from), to);
  low = d_ceil(low);
  high = d_ceil(high);
  d_store_int(first, low);
  d_store_int(last, high);
  return d_greater(high, low);
}

/// Distance of the eye from the planes, times the lengths of their normals; and +1 where the front
/// is seen, else -1.
struct Facing {
  D distance, sign;
};

static inline Facing find_facing(const double* planes, const WindowProblem* w) {
  D to_plane[3];
  for (int axis = 0; axis < 3; ++axis)
    to_plane[axis] = d_sub(d_load(planes + (3 + axis) * kBatch), d_set(w->eye[axis]));
  const D distance = d_dot(d_load(planes), d_load(planes + kBatch), d_load(planes + 2 * kBatch),
                           to_plane[0], to_plane[1], to_plane[2]);
  const N facing = d_greater(d_set(0), d_mul(distance, d_load(planes + 6 * kBatch)));
  return {distance, d_select(facing, d_set(1), d_set(-1))};
}

/// Writes 1/z as a plane over the pixels.
static inline void store_depth(const double* planes, int first, const WindowProblem* w,
                               const Facing& facing, D nearest, N known, PolygonBatch* batch) {
  D depth[3];
  for (int axis = 0; axis < 3; ++axis)
    depth[axis] = d_div(d_set_dot(w->frame[axis], d_load(planes), d_load(planes + kBatch),
                                  d_load(planes + 2 * kBatch)),
                        facing.distance);
  // Where a facing and a back-facing polygon are equally deep up to rounding - along every
  // silhouette - the facing one must win: both are moved apart by the rounding they can suffer.
  // Three roundings of 2^-24 of numbers no larger than the sum; 2^-21 leaves some room.
  const D reach = d_add(
      d_add(d_mul(d_abs(depth[0]), d_set(w->x_reach)), d_mul(d_abs(depth[1]), d_set(w->y_reach))),
      d_abs(depth[2]));
  const D error = d_mul(d_set(0x1p-21), reach);
  const D at_origin =
      d_add(depth[2], d_add(d_mul(depth[0], d_set(w->x0)), d_mul(depth[1], d_set(w->y0))));
  d_store_float(batch->depth_per_pixel + first, d_mul(depth[0], d_set(w->dx)));
  d_store(batch->depth_per_row + first, d_mul(depth[1], d_set(w->dy)));
  d_store(batch->depth_at_origin + first, d_add(at_origin, d_mul(error, facing.sign)));
  d_store_float(batch->depth_error + first, d_mul(d_set(3), error));
  // No pixel is nearer than the nearest corner but for rounding, which in the plane of a polygon
  // seen at a grazing angle can be anything.
  nearest = d_mul(nearest, d_set(1 + 0x1p-16));
  d_store_float(batch->nearest + first, d_select(known, nearest, d_set(3e38)));
}

/// @return bit p: polygon p of the vector may cover a pixel
static inline uint32_t find_bounds_of_vector(const Cluster* cluster, int first,
                                             const WindowProblem* w, double* moved,
                                             PolygonBatch* batch) {
  const double* planes = cluster->planes + first;
  const Facing facing = find_facing(planes, w);
  N same = n_not(n_none());
  D normal[3];
  for (int axis = 0; axis < 3; ++axis) {
    normal[axis] = d_load(planes + axis * kBatch);
    same = n_and(same, d_equal(normal[axis], d_set(w->skip_normal[axis])));
    same = n_and(same, d_equal(d_load(planes + (3 + axis) * kBatch), d_set(w->skip_point[axis])));
  }
  N alive = n_not(same);
  if (w->draw_backs == 0)
    alive = n_and(alive, d_greater(facing.sign, d_set(0)));

  const CornerSummary s =
      move_corners(cluster->corners + first, cluster->corner_count, w, moved + first);
  const D normal_squared = d_dot(normal[0], normal[1], normal[2], normal[0], normal[1], normal[2]);
  const D through_eye = d_mul(d_mul(d_set(kThroughEye * kThroughEye), normal_squared), s.farthest);
  alive = n_and(alive, d_greater(d_mul(facing.distance, facing.distance), through_eye));
  alive = n_and(alive, s.some_in_front);
  if (w->above_horizon != 0)
    alive = n_and(alive, s.some_above);
  alive = n_and(alive, store_bounds(s.x_low, s.x_high, s.all_in_front, w->x_begin, w->x_end,
                                    batch->x_begin + first, batch->x_end + first));
  alive = n_and(alive, store_bounds(s.y_low, s.y_high, s.all_in_front, w->y_begin, w->y_end,
                                    batch->y_begin + first, batch->y_end + first));
  if (n_bits(n_and(alive, n_not(s.all_in_front))) != 0)
    alive = n_and(
        alive, n_or(s.all_in_front, n_not(beyond_a_side(moved + first, cluster->corner_count, w))));
  if (n_bits(alive) != 0)
    store_depth(planes, first, w, facing, s.nearest, s.all_in_front, batch);
  return n_bits(alive);
}

static uint32_t find_bounds(const Cluster* cluster, const WindowProblem* problem, double* moved,
                            PolygonBatch* batch) {
  uint32_t alive = 0;
  for (int first = 0; first < kBatch; first += kDoubles)
    if ((cluster->present >> first & ((1u << kDoubles) - 1)) != 0)
      alive |= find_bounds_of_vector(cluster, first, problem, moved, batch) << first;
  return alive & cluster->present;
}

static inline void set_up_vector(const Cluster* cluster, int first, const WindowProblem* w,
                                 const double* moved, PolygonBatch* batch) {
  const double* planes = cluster->planes + first;
  const Facing facing = find_facing(planes, w);
  set_up_edges(moved + first, cluster->corner_count, w, facing.sign, batch->edges + first);

  const uint32_t fronts = n_bits(d_greater(facing.sign, d_set(0)));
  for (int k = 0; k < kDoubles; ++k)
    batch->item[first + k] = cluster->ids[first + k] | (~fronts >> k & 1) << 31;
}

static void set_up(const Cluster* cluster, const WindowProblem* problem, const double* moved,
                   uint32_t polygons, PolygonBatch* batch) {
  batch->corner_count = cluster->corner_count;
  for (int first = 0; first < kBatch; first += kDoubles)
    if ((polygons >> first & ((1u << kDoubles) - 1)) != 0)
      set_up_vector(cluster, first, problem, moved, batch);
}
