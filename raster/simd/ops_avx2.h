// Operations of the AVX2 kernels: 4 doubles, 8 floats, 8 integers. A mask is a vector of
// all-ones lanes. See ops_scalar.h for what each one means.

constexpr int kDoubles = 4;
constexpr int kFloats = 8;
using D = __m256d;
using N = __m256d;
using F = __m256;
using U = __m256i;
using M = __m256;

static inline D d_set(double value) {
  return _mm256_set1_pd(value);
}
static inline D d_iota() {
  return _mm256_setr_pd(0, 1, 2, 3);
}
static inline D d_load(const double* from) {
  return _mm256_loadu_pd(from);
}
static inline void d_store(double* to, D a) {
  _mm256_storeu_pd(to, a);
}
static inline D d_add(D a, D b) {
  return _mm256_add_pd(a, b);
}
static inline D d_sub(D a, D b) {
  return _mm256_sub_pd(a, b);
}
static inline D d_mul(D a, D b) {
  return _mm256_mul_pd(a, b);
}
static inline D d_div(D a, D b) {
  return _mm256_div_pd(a, b);
}
static inline D d_max(D a, D b) {
  return _mm256_max_pd(a, b);
}
static inline D d_min(D a, D b) {
  return _mm256_min_pd(a, b);
}
static inline D d_abs(D a) {
  return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a);
}
static inline D d_negate(D a) {
  return _mm256_xor_pd(_mm256_set1_pd(-0.0), a);
}
static inline D d_copysign(D size, D sign) {
  return _mm256_or_pd(size, _mm256_and_pd(_mm256_set1_pd(-0.0), sign));
}
static inline D d_ceil(D a) {
  return _mm256_ceil_pd(a);
}
static inline void d_store_int(int32_t* to, D a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvttpd_epi32(a));
}
static inline void d_store_float(float* to, D a) {
  _mm_storeu_ps(to, _mm256_cvtpd_ps(a));
}
static inline N d_greater(D a, D b) {
  return _mm256_cmp_pd(a, b, _CMP_GT_OQ);
}
static inline N d_equal(D a, D b) {
  return _mm256_cmp_pd(a, b, _CMP_EQ_OQ);
}
static inline D d_select(N mask, D yes, D no) {
  return _mm256_blendv_pd(no, yes, mask);
}

static inline N n_none() {
  return _mm256_setzero_pd();
}
static inline N n_and(N a, N b) {
  return _mm256_and_pd(a, b);
}
static inline N n_or(N a, N b) {
  return _mm256_or_pd(a, b);
}
static inline N n_not(N a) {
  return _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi32(-1)));
}
static inline uint32_t n_bits(N a) {
  return static_cast<uint32_t>(_mm256_movemask_pd(a));
}

using I = __m128i;
static inline I i_load(const int32_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}
static inline D d_lookup(const double* table, I at) {
  // Not the plain gather: GCC 12 warns of its own header.
  return _mm256_mask_i32gather_pd(_mm256_setzero_pd(), table, at,
                                  _mm256_castsi256_pd(_mm256_set1_epi32(-1)), 8);
}
static inline D d_load_int(const int32_t* from) {
  return _mm256_cvtepi32_pd(i_load(from));
}
static inline int32_t n_compress(int32_t* to, int32_t first, N mask) {
  int32_t count = 0;
  const uint32_t bits = n_bits(mask);
  for (int32_t lane = 0; lane < kDoubles; ++lane) {
    to[count] = first + lane;
    count += static_cast<int32_t>(bits >> lane & 1);
  }
  return count;
}

static inline F f_set(float value) {
  return _mm256_set1_ps(value);
}
static inline F f_iota() {
  return _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
}
static inline F f_load(const float* from) {
  return _mm256_loadu_ps(from);
}
static inline void f_store(float* to, F a) {
  _mm256_storeu_ps(to, a);
}
static inline F f_add(F a, F b) {
  return _mm256_add_ps(a, b);
}
static inline F f_sub(F a, F b) {
  return _mm256_sub_ps(a, b);
}
static inline F f_mul(F a, F b) {
  return _mm256_mul_ps(a, b);
}
static inline F f_div(F a, F b) {
  return _mm256_div_ps(a, b);
}
static inline F f_max(F a, F b) {
  return _mm256_max_ps(a, b);
}
static inline F f_min(F a, F b) {
  return _mm256_min_ps(a, b);
}
static inline F f_abs(F a) {
  return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
}
static inline void f_store_int(int32_t* to, F a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(a));
}
static inline M f_greater(F a, F b) {
  return _mm256_cmp_ps(a, b, _CMP_GT_OQ);
}
static inline M f_equal(F a, F b) {
  return _mm256_cmp_ps(a, b, _CMP_EQ_OQ);
}
static inline F f_select(M mask, F yes, F no) {
  return _mm256_blendv_ps(no, yes, mask);
}

static inline U u_set(uint32_t value) {
  return _mm256_set1_epi32(static_cast<int32_t>(value));
}
static inline U u_iota() {
  return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}
static inline U u_load(const uint32_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}
static inline void u_store(uint32_t* to, U a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a);
}
static inline U u_add(U a, U b) {
  return _mm256_add_epi32(a, b);
}
static inline M u_less(U a, U b) {
  const U sign = _mm256_set1_epi32(INT32_MIN);
  return _mm256_castsi256_ps(
      _mm256_cmpgt_epi32(_mm256_xor_si256(b, sign), _mm256_xor_si256(a, sign)));
}
static inline M u_equal(U a, U b) {
  return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b));
}
static inline U u_select(M mask, U yes, U no) {
  return _mm256_castps_si256(
      _mm256_blendv_ps(_mm256_castsi256_ps(no), _mm256_castsi256_ps(yes), mask));
}

static inline M m_first(int32_t count) {
  return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(count), u_iota()));
}
static inline M m_from_bits(uint32_t bits) {
  const U lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(u_set(bits), lane), lane));
}
static inline M m_and(M a, M b) {
  return _mm256_and_ps(a, b);
}
static inline M m_or(M a, M b) {
  return _mm256_or_ps(a, b);
}
static inline M m_not(M a) {
  return _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));
}
static inline uint32_t m_bits(M a) {
  return static_cast<uint32_t>(_mm256_movemask_ps(a));
}

static inline void f_store_where(float* to, M mask, F a, F there) {
  f_store(to, f_select(mask, a, there));
}
static inline void u_store_where(uint32_t* to, M mask, U a, U there) {
  u_store(to, u_select(mask, a, there));
}
static inline void u_compress(uint32_t* to, U a, M mask) {
  // Which lanes to move for each of the 256 masks: worked out once, at compile time.
  struct Table {
    alignas(8) uint8_t lanes[256][8];
    constexpr Table() : lanes() {
      for (int m = 0; m < 256; ++m) {
        int k = 0;
        for (int lane = 0; lane < 8; ++lane)
          if ((m >> lane & 1) != 0)
            lanes[m][k++] = static_cast<uint8_t>(lane);
      }
    }
  };
  static constexpr Table kTable;
  const __m128i order =
      _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kTable.lanes[m_bits(mask)]));
  u_store(to, _mm256_permutevar8x32_epi32(a, _mm256_cvtepu8_epi32(order)));
}
