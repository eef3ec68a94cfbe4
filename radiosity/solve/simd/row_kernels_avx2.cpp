#include "radiosity/solve/row_kernels.h"

#if defined(__x86_64__)

#include <immintrin.h>

// Every function of this file is compiled for AVX2, and none is visible outside it: the linker can
// never pick one of them for a program that runs on an older machine.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

namespace hemicube::radiosity {
namespace {

inline __m256d four_at(const double* x, const uint32_t* c) {
  const __m128d low = _mm_loadh_pd(_mm_load_sd(x + c[0]), x + c[1]);
  const __m128d high = _mm_loadh_pd(_mm_load_sd(x + c[2]), x + c[3]);
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1);
}

void row_sums_1(const uint32_t* columns, const float* values, uint64_t count, const double* x,
                double* sums) {
  __m256d low = _mm256_setzero_pd(), high = _mm256_setzero_pd(); // partial sums 0..3, 4..7
  uint64_t k = 0;
  for (; k + 8 <= count; k += 8) {
    const uint32_t* const c = columns + k;
    __m256d x_low, x_high;
    if (c[7] - c[0] == 7) { // ascending: eight neighbours
      x_low = _mm256_loadu_pd(x + c[0]);
      x_high = _mm256_loadu_pd(x + c[0] + 4);
    } else {
      x_low = four_at(x, c);
      x_high = four_at(x, c + 4);
    }
    const __m256d v_low = _mm256_cvtps_pd(_mm_loadu_ps(values + k));
    const __m256d v_high = _mm256_cvtps_pd(_mm_loadu_ps(values + k + 4));
    low = _mm256_add_pd(low, _mm256_mul_pd(v_low, x_low));
    high = _mm256_add_pd(high, _mm256_mul_pd(v_high, x_high));
  }
  double lanes[8];
  _mm256_storeu_pd(lanes, low);
  _mm256_storeu_pd(lanes + 4, high);
  for (int lane = 0; k < count; ++k, ++lane)
    lanes[lane] += static_cast<double>(values[k]) * x[columns[k]];
  const __m256d halves = _mm256_add_pd(_mm256_loadu_pd(lanes), _mm256_loadu_pd(lanes + 4));
  const __m128d quarters =
      _mm_add_pd(_mm256_castpd256_pd128(halves), _mm256_extractf128_pd(halves, 1));
  sums[0] = _mm_cvtsd_f64(_mm_add_sd(quarters, _mm_unpackhi_pd(quarters, quarters)));
}

/// Two bands of one patch: one vector.
struct TwoBands {
  using Vector = __m128d;
  static Vector zero() { return _mm_setzero_pd(); }
  static Vector load(const double* x) { return _mm_loadu_pd(x); }
  static Vector multiply(Vector a, Vector b) { return _mm_mul_pd(a, b); }
  static Vector add(Vector a, Vector b) { return _mm_add_pd(a, b); }
  static void store(double* to, Vector a) { _mm_storeu_pd(to, a); }
  /// Vectors of four values each.
  static void spread(const float* values, Vector* vectors) {
    const __m256d four = _mm256_cvtps_pd(_mm_loadu_ps(values));
    const __m128d low = _mm256_castpd256_pd128(four), high = _mm256_extractf128_pd(four, 1);
    vectors[0] = _mm_unpacklo_pd(low, low);
    vectors[1] = _mm_unpackhi_pd(low, low);
    vectors[2] = _mm_unpacklo_pd(high, high);
    vectors[3] = _mm_unpackhi_pd(high, high);
  }
  static Vector spread_one(float value) { return _mm_set1_pd(static_cast<double>(value)); }
};

/// Three or four bands. Three lie without a gap between patches, which saves a quarter of what x
/// takes in cache; the fourth sum is then worthless.
struct FourBands {
  using Vector = __m256d;
  static Vector zero() { return _mm256_setzero_pd(); }
  static Vector load(const double* x) { return _mm256_loadu_pd(x); }
  static Vector multiply(Vector a, Vector b) { return _mm256_mul_pd(a, b); }
  static Vector add(Vector a, Vector b) { return _mm256_add_pd(a, b); }
  static void store(double* to, Vector a) { _mm256_storeu_pd(to, a); }
  static void spread(const float* values, Vector* vectors) {
    const __m256d four = _mm256_cvtps_pd(_mm_loadu_ps(values));
    const __m256d even = _mm256_unpacklo_pd(four, four), odd = _mm256_unpackhi_pd(four, four);
    vectors[0] = _mm256_permute2f128_pd(even, even, 0x00);
    vectors[1] = _mm256_permute2f128_pd(odd, odd, 0x00);
    vectors[2] = _mm256_permute2f128_pd(even, even, 0x11);
    vectors[3] = _mm256_permute2f128_pd(odd, odd, 0x11);
  }
  static Vector spread_one(float value) { return _mm256_set1_pd(static_cast<double>(value)); }
};

template <typename Bands, uint64_t kWidth>
void row_sums(const uint32_t* columns, const float* values, uint64_t count, const double* x,
              double* sums) {
  typename Bands::Vector partial[8], value[8];
  for (auto& sum : partial)
    sum = Bands::zero();
  const auto add = [&](uint64_t k, uint64_t lane) {
    const auto bands = Bands::load(x + uint64_t{columns[k]} * kWidth);
    partial[lane] = Bands::add(partial[lane], Bands::multiply(value[lane], bands));
  };
  uint64_t k = 0;
  for (; k + 8 <= count; k += 8) {
    Bands::spread(values + k, value);
    Bands::spread(values + k + 4, value + 4);
    add(k, 0);
    add(k + 1, 1);
    add(k + 2, 2);
    add(k + 3, 3);
    add(k + 4, 4);
    add(k + 5, 5);
    add(k + 6, 6);
    add(k + 7, 7);
  }
#pragma GCC unroll 7
  for (uint64_t lane = 0; lane < 7; ++lane) { // unrolled: sums that are indexed leave registers
    if (k + lane >= count)
      break;
    value[lane] = Bands::spread_one(values[k + lane]);
    add(k + lane, lane);
  }
  for (int lane = 0; lane < 4; ++lane)
    partial[lane] = Bands::add(partial[lane], partial[lane + 4]);
  Bands::store(sums,
               Bands::add(Bands::add(partial[0], partial[2]), Bands::add(partial[1], partial[3])));
}

} // namespace
} // namespace hemicube::radiosity

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace hemicube::radiosity {

extern const RowKernels kAvx2RowKernels;
const RowKernels kAvx2RowKernels = {"avx2", row_sums_1, row_sums<TwoBands, 2>,
                                    row_sums<FourBands, 3>, row_sums<FourBands, 4>};

} // namespace hemicube::radiosity

#endif
