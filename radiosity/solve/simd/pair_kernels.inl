// Row sums over pairs of doubles, written once over the operations of an ops_<isa>.h that the
// including file has pulled into the enclosing namespace.

/// The eight partial sums of one band, two to a vector, folded by the tree of interleaved_sum.
static inline double fold(const P* sums) {
  const P half01 = p_add(sums[0], sums[2]); // 0 + 4, 1 + 5
  const P half23 = p_add(sums[1], sums[3]); // 2 + 6, 3 + 7
  return p_first_plus_second(p_add(half01, half23));
}

static void row_sums_1(const uint32_t* columns, const float* values, uint64_t count,
                       const double* x, double* sums) {
  P partial[4] = {p_set(0), p_set(0), p_set(0), p_set(0)};
  uint64_t k = 0;
  for (; k + 8 <= count; k += 8)
    for (int pair = 0; pair < 4; ++pair) {
      const uint32_t* const c = columns + k + 2 * pair;
      const P value = p_load_floats(values + k + 2 * pair);
      partial[pair] = p_add(partial[pair], p_mul(value, p_load_two(x + c[0], x + c[1])));
    }
  double lanes[8];
  for (int pair = 0; pair < 4; ++pair)
    p_store(lanes + 2 * pair, partial[pair]);
  for (int lane = 0; k < count; ++k, ++lane)
    lanes[lane] += static_cast<double>(values[k]) * x[columns[k]];
  for (int pair = 0; pair < 4; ++pair)
    partial[pair] = p_load(lanes + 2 * pair);
  sums[0] = fold(partial);
}

/// Two bands of kWidth.
template <uint64_t kWidth>
static void two_bands(const uint32_t* columns, const float* values, uint64_t count, const double* x,
                      double* sums) {
  P partial[8];
  for (P& sum : partial)
    sum = p_set(0);
  const auto add = [&](uint64_t k, int lane) {
    const P value = p_set(static_cast<double>(values[k]));
    partial[lane] = p_add(partial[lane], p_mul(value, p_load(x + uint64_t{columns[k]} * kWidth)));
  };
  uint64_t k = 0;
  for (; k + 8 <= count; k += 8)
    for (int lane = 0; lane < 8; ++lane)
      add(k + static_cast<uint64_t>(lane), lane);
  for (int lane = 0; k < count; ++k, ++lane)
    add(k, lane);
  for (int lane = 0; lane < 4; ++lane)
    partial[lane] = p_add(partial[lane], partial[lane + 4]);
  p_store(sums, p_add(p_add(partial[0], partial[2]), p_add(partial[1], partial[3])));
}

// Eight sums of more than two bands would not fit into the registers.
static void row_sums_3(const uint32_t* columns, const float* values, uint64_t count,
                       const double* x, double* sums) {
  two_bands<3>(columns, values, count, x, sums);
  two_bands<3>(columns, values, count, x + 1, sums + 1);
}

static void row_sums_4(const uint32_t* columns, const float* values, uint64_t count,
                       const double* x, double* sums) {
  two_bands<4>(columns, values, count, x, sums);
  two_bands<4>(columns, values, count, x + 2, sums + 2);
}
