// Set-up of polygons in a window, in double: lanes are polygons.

/// Rounding cannot carry an edge further than this, in pixels, past the ends of its projection.
constexpr float kPixelMargin = 0x1p-4f;

/// Nearer corners, in units of the farthest, are not projected: single precision would divide by
/// nothing.
constexpr float kLeastDepth = 1e-30f;

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
  D z_low, z_high;
  D highest; ///< above the receiver's plane
};

/// Moves corners into the frame of the window: [corner][axis][kBatch], and the same in units of the
/// window, rounded.
static inline CornerSummary move_corners(const double* corners, int32_t corner_count,
                                         const WindowProblem* w, double* moved, float* rounded) {
  CornerSummary s = {d_set(kNowhere), d_set(-kNowhere), d_set(-kNowhere)};
  for (int32_t c = 0; c < corner_count; ++c) {
    const D x = d_sub(d_load(corners), d_set(w->eye[0]));
    const D y = d_sub(d_load(corners + kBatch), d_set(w->eye[1]));
    const D z = d_sub(d_load(corners + 2 * kBatch), d_set(w->eye[2]));
    D v[3];
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = d_dot(x, y, z, d_set(w->frame[axis][0]), d_set(w->frame[axis][1]),
                      d_set(w->frame[axis][2]));
      d_store(moved + axis * kBatch, v[axis]);
      d_store_float(rounded + axis * kBatch, d_mul(v[axis], d_set(w->unit)));
    }
    s.z_low = d_min(v[2], s.z_low);
    s.z_high = d_max(v[2], s.z_high);
    s.highest = d_max(w->horizon_axis == 2 ? v[2] : v[1], s.highest);
    corners += 3 * kBatch;
    moved += 3 * kBatch;
    rounded += 3 * kBatch;
  }
  return s;
}

/// Polygons that are not edge-on to the eye, and rise above the horizon where there is one.
/// @param across  distance of the eye from their planes times the lengths of their normals, squared
static inline N not_edge_on(const double* moved, int32_t corner_count, const WindowProblem* w,
                            D normal_squared, D across) {
  const int up = w->horizon_axis, other = 3 - up; // 1 or 2: the axes besides `right`
  D farthest = d_set(0);
  N above = w->above_horizon != 0 ? n_none() : n_not(n_none());
  for (int32_t c = 0; c < corner_count; ++c, moved += 3 * kBatch) {
    const D height = d_load(moved + up * kBatch), x = d_load(moved),
            y = d_load(moved + other * kBatch);
    // In this order the sum is the same for every face of a hemicube.
    const D height_squared = d_mul(height, height);
    const D distance_squared = d_add(d_add(d_mul(x, x), d_mul(y, y)), height_squared);
    farthest = d_max(distance_squared, farthest);
    const D edge_on = d_mul(d_set(kEdgeOn * kEdgeOn), distance_squared);
    above = n_or(above, n_and(d_greater(height, d_set(0)), d_greater(height_squared, edge_on)));
  }
  const D through_eye = d_mul(d_mul(d_set(kThroughEye * kThroughEye), normal_squared), farthest);
  return n_and(above, d_greater(across, through_eye));
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
    const D inverse = d_div(d_set(-1), per_x);
    const D slope = d_mul(per_y, inverse);
    const D offset = d_mul(constant, inverse);
    // Where it is still 0 the edge points at the eye: it bounds nothing.
    const D side = d_mul(per_x, facing_sign);
    const N left = d_greater(side, zero), right = d_greater(zero, side);
    d_store(edges, d_select(n_or(left, right), slope, zero));
    d_store(edges + kBatch, d_select(left, offset, d_set(-kNowhere)));
    d_store(edges + 2 * kBatch, d_select(right, offset, d_set(kNowhere)));
    edges += 3 * kBatch;
  }
}

/// Writes the pixels that polygons can cover, and how near they come.
/// @param in_front  bit p: polygon p is in front of the eye plane; others may cover all of the
/// window
/// @return bit p: polygon p may cover a pixel
static inline uint32_t project(const float* rounded, int32_t corner_count, const WindowProblem* w,
                               uint32_t in_front, PolygonBatch* batch) {
  const F x0 = f_set(static_cast<float>(w->x0)), y0 = f_set(static_cast<float>(w->y0));
  const F columns_per_x = f_set(static_cast<float>(w->columns_per_x));
  const F rows_per_y = f_set(static_cast<float>(w->rows_per_y));
  const F x_begin = f_set(static_cast<float>(w->x_begin)),
          x_end = f_set(static_cast<float>(w->x_end));
  const F y_begin = f_set(static_cast<float>(w->y_begin)),
          y_end = f_set(static_cast<float>(w->y_end));
  const F unit = f_set(static_cast<float>(w->unit));
  uint32_t found = 0;
  for (int first = 0; first < kBatch; first += kFloats) {
    M known = m_from_bits(in_front >> first & ((1u << kFloats) - 1));
    F x_low = f_set(3e38f), x_high = f_set(-3e38f), y_low = x_low, y_high = x_high;
    F nearest = f_set(0.0f);
    const float* corner = rounded + first;
    for (int32_t c = 0; c < corner_count; ++c, corner += 3 * kBatch) {
      const F z = f_load(corner + 2 * kBatch);
      known = m_and(known, f_greater(z, f_set(kLeastDepth)));
      const F inverse = f_div(f_set(1.0f), z);
      const F column = f_mul(f_sub(f_mul(f_load(corner), inverse), x0), columns_per_x);
      const F row = f_mul(f_sub(f_mul(f_load(corner + kBatch), inverse), y0), rows_per_y);
      nearest = f_max(inverse, nearest);
      x_low = f_min(column, x_low);
      x_high = f_max(column, x_high);
      y_low = f_min(row, y_low);
      y_high = f_max(row, y_high);
    }
    // Rounded up by truncation, and if in doubt outwards.
    const auto pixels = [&](F low, F high, F begin, F end, int32_t* from, int32_t* to) {
      low = f_add(low, f_set(1 - 1.5f * kPixelMargin));
      high = f_add(high, f_set(1 + kPixelMargin));
      f_store_int(from + first, f_select(known, f_min(f_max(low, begin), end), begin));
      f_store_int(to + first, f_select(known, f_max(f_min(high, end), begin), end));
      const auto* a = reinterpret_cast<const uint32_t*>(from + first);
      const auto* b = reinterpret_cast<const uint32_t*>(to + first);
      return u_less(u_load(a), u_load(b));
    };
    const M columns = pixels(x_low, x_high, x_begin, x_end, batch->x_begin, batch->x_end);
    const M rows = pixels(y_low, y_high, y_begin, y_end, batch->y_begin, batch->y_end);
    found |= m_bits(m_and(columns, rows)) << first;
    // No pixel is nearer than the nearest corner but for rounding, which in the plane of a polygon
    // seen at a grazing angle can be anything.
    f_store(batch->nearest + first,
            f_select(known, f_mul(f_mul(nearest, f_set(1 + 0x1p-16f)), unit), f_set(3e38f)));
  }
  for (int first = 0; first < kBatch; first += kDoubles) {
    d_store(batch->x_first + first, d_load_int(batch->x_begin + first));
    d_store(batch->x_last + first, d_load_int(batch->x_end + first));
  }
  return found;
}

/// Distance of the eye from the planes, times the lengths of their normals.
static inline D distance_to_eye(const double* planes, const WindowProblem* w) {
  D to_plane[3];
  for (int axis = 0; axis < 3; ++axis)
    to_plane[axis] = d_sub(d_load(planes + (3 + axis) * kBatch), d_set(w->eye[axis]));
  return d_dot(d_load(planes), d_load(planes + kBatch), d_load(planes + 2 * kBatch), to_plane[0],
               to_plane[1], to_plane[2]);
}

/// Writes 1/z as a plane over the pixels.
static inline void store_depth(const double* planes, int first, const WindowProblem* w, D distance,
                               PolygonBatch* batch) {
  const D facing = d_load(batch->facing + first);
  const D inverse = d_div(d_set(1), distance);
  D depth[3];
  for (int axis = 0; axis < 3; ++axis)
    depth[axis] = d_mul(d_set_dot(w->frame[axis], d_load(planes), d_load(planes + kBatch),
                                  d_load(planes + 2 * kBatch)),
                        inverse);
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
  d_store(batch->depth_at_origin + first, d_add(at_origin, d_mul(error, facing)));
  d_store_float(batch->depth_error + first, d_mul(d_set(3), error));
}

/// The polygons that are not the receiver, nor its copy or other side.
static inline N not_skipped(const double* planes, const WindowProblem* w) {
  N same = n_not(n_none());
  for (int axis = 0; axis < 3; ++axis) {
    same = n_and(same, d_equal(d_load(planes + axis * kBatch), d_set(w->skip_normal[axis])));
    same = n_and(same, d_equal(d_load(planes + (3 + axis) * kBatch), d_set(w->skip_point[axis])));
  }
  return n_not(same);
}

static uint32_t find_bounds(const Cluster* cluster, const WindowProblem* w, double* moved,
                            PolygonBatch* batch) {
  float* rounded =
      reinterpret_cast<float*>(moved + static_cast<int64_t>(cluster->corner_count) * 3 * kBatch);
  uint32_t alive = 0, in_front = 0;
  D distance[kBatch / kDoubles];
  for (int first = 0, k = 0; first < kBatch; first += kDoubles, ++k) {
    const double* planes = cluster->planes + first;
    distance[k] = distance_to_eye(planes, w);
    const N fronts = d_greater(d_set(0), d_mul(distance[k], d_load(planes + 6 * kBatch)));
    d_store(batch->facing + first, d_select(fronts, d_set(1), d_set(-1)));
    const CornerSummary s = move_corners(cluster->corners + first, cluster->corner_count, w,
                                         moved + first, rounded + first);
    N seen = n_and(not_skipped(planes, w), d_greater(s.z_high, d_set(0)));
    if (w->draw_backs == 0)
      seen = n_and(seen, fronts);
    const D n[3] = {d_load(planes), d_load(planes + kBatch), d_load(planes + 2 * kBatch)};
    const D normal_squared = d_dot(n[0], n[1], n[2], n[0], n[1], n[2]);
    const D across = d_mul(distance[k], distance[k]);
    // Most polygons are far from edge-on, whatever their corners are.
    N certain = d_greater(across, d_mul(d_set(w->edge_on_to_eye), normal_squared));
    if (w->above_horizon != 0) {
      certain = n_and(certain, d_greater(s.highest, d_set(w->edge_on_to_receiver)));
      seen = n_and(seen, d_greater(s.highest, d_set(0)));
    }
    if (n_bits(n_and(seen, n_not(certain))) != 0)
      seen =
          n_and(seen, not_edge_on(moved + first, cluster->corner_count, w, normal_squared, across));
    alive |= n_bits(seen) << first;
    in_front |= n_bits(d_greater(s.z_low, d_set(0))) << first;
  }
  alive &= cluster->present;
  if (alive == 0)
    return 0;
  alive &= project(rounded, cluster->corner_count, w, in_front, batch);
  for (int first = 0, k = 0; first < kBatch; first += kDoubles, ++k) {
    constexpr uint32_t kLanes = (1u << kDoubles) - 1;
    if ((alive & ~in_front) >> first & kLanes) {
      const N beyond = beyond_a_side(moved + first, cluster->corner_count, w);
      alive &= ~((n_bits(beyond) & ~(in_front >> first)) << first);
    }
    if ((alive >> first & kLanes) != 0)
      store_depth(cluster->planes + first, first, w, distance[k], batch);
  }
  return alive;
}

static void set_up(const Cluster* cluster, const WindowProblem* problem, const double* moved,
                   uint32_t polygons, PolygonBatch* batch) {
  batch->corner_count = cluster->corner_count;
  for (int first = 0; first < kBatch; first += kDoubles) {
    if ((polygons >> first & ((1u << kDoubles) - 1)) == 0)
      continue;
    const D facing = d_load(batch->facing + first);
    set_up_edges(moved + first, cluster->corner_count, problem, facing, batch->edges + first);
    const uint32_t fronts = n_bits(d_greater(facing, d_set(0)));
    for (int k = 0; k < kDoubles; ++k)
      batch->item[first + k] = cluster->ids[first + k] | (~fronts >> k & 1) << 31;
  }
}
