#include "radiosity/solve/row_kernels.h"

#if defined(__x86_64__)

#include <emmintrin.h>

namespace hemicube::radiosity {
namespace {

/// The eight partial sums of one band, two to a vector, folded by the tree of interleaved_sum.
double fold(const __m128d* sums) {
  const __m128d half01 = _mm_add_pd(sums[0], sums[2]); // 0 + 4, 1 + 5
  const __m128d half23 = _mm_add_pd(sums[1], sums[3]); // 2 + 6, 3 + 7
  const __m128d quarter = _mm_add_pd(half01, half23);
  return _mm_cvtsd_f64(_mm_add_sd(quarter, _mm_unpackhi_pd(quarter, quarter)));
}

__m128d pair_at(const double* x, uint32_t low, uint32_t high) {
  return _mm_loadh_pd(_mm_load_sd(x + low), x + high);
}

void row_sums_1(const uint32_t* columns, const float* values, uint64_t count, const double* x,
                double* sums) {
  __m128d partial[4] = {_mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd()};
  uint64_t k = 0;
  for (; k + 8 <= count; k += 8)
    for (int half = 0; half < 2; ++half) {
      const uint32_t* const c = columns + k + 4 * half;
      const __m128 v = _mm_loadu_ps(values + k + 4 * half);
      partial[2 * half] =
          _mm_add_pd(partial[2 * half], _mm_mul_pd(_mm_cvtps_pd(v), pair_at(x, c[0], c[1])));
      partial[2 * half + 1] =
          _mm_add_pd(partial[2 * half + 1],
                     _mm_mul_pd(_mm_cvtps_pd(_mm_movehl_ps(v, v)), pair_at(x, c[2], c[3])));
    }
  double lanes[8];
  for (int pair = 0; pair < 4; ++pair)
    _mm_storeu_pd(lanes + 2 * pair, partial[pair]);
  for (int lane = 0; k < count; ++k, ++lane)
    lanes[lane] += static_cast<double>(values[k]) * x[columns[k]];
  for (int pair = 0; pair < 4; ++pair)
    partial[pair] = _mm_loadu_pd(lanes + 2 * pair);
  sums[0] = fold(partial);
}

/// Two bands of kWidth.
template <uint64_t kWidth>
void two_bands(const uint32_t* columns, const float* values, uint64_t count, const double* x,
               double* sums) {
  __m128d partial[8];
  for (__m128d& sum : partial)
    sum = _mm_setzero_pd();
  const auto add = [&](uint64_t k, int lane) {
    const __m128d value = _mm_set1_pd(static_cast<double>(values[k]));
    partial[lane] = _mm_add_pd(partial[lane],
                               _mm_mul_pd(value, _mm_loadu_pd(x + uint64_t{columns[k]} * kWidth)));
  };
  uint64_t k = 0;
  for (; k + 8 <= count; k += 8)
    for (int lane = 0; lane < 8; ++lane)
      add(k + static_cast<uint64_t>(lane), lane);
  for (int lane = 0; k < count; ++k, ++lane)
    add(k, lane);
  for (int lane = 0; lane < 4; ++lane)
    partial[lane] = _mm_add_pd(partial[lane], partial[lane + 4]);
  _mm_storeu_pd(sums,
                _mm_add_pd(_mm_add_pd(partial[0], partial[2]), _mm_add_pd(partial[1], partial[3])));
}

// Eight sums of more than two bands would not fit into the registers.
void row_sums_3(const uint32_t* columns, const float* values, uint64_t count, const double* x,
                double* sums) {
  two_bands<3>(columns, values, count, x, sums);
  two_bands<3>(columns, values, count, x + 1, sums + 1);
}

void row_sums_4(const uint32_t* columns, const float* values, uint64_t count, const double* x,
                double* sums) {
  two_bands<4>(columns, values, count, x, sums);
  two_bands<4>(columns, values, count, x + 2, sums + 2);
}

} // namespace

extern const RowKernels kSse2RowKernels;
const RowKernels kSse2RowKernels = {"sse2", row_sums_1, two_bands<2>, row_sums_3, row_sums_4};

} // namespace hemicube::radiosity

#endif
