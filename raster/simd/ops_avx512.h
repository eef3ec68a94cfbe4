// Operations of the AVX-512 kernels: 8 doubles, 16 floats, 16 integers. A mask is a mask register.
// See ops_scalar.h for what each one means.

constexpr int kDoubles = 8;
constexpr int kFloats = 16;
using D = __m512d;
using N = __mmask8;
using F = __m512;
using U = __m512i;
using M = __mmask16;

static inline D d_set(double value) {
  return _mm512_set1_pd(value);
}
static inline D d_iota() {
  return _mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7);
}
static inline D d_load(const double* from) {
  return _mm512_loadu_pd(from);
}
static inline void d_store(double* to, D a) {
  _mm512_storeu_pd(to, a);
}
static inline D d_add(D a, D b) {
  return _mm512_add_pd(a, b);
}
static inline D d_sub(D a, D b) {
  return _mm512_sub_pd(a, b);
}
static inline D d_mul(D a, D b) {
  return _mm512_mul_pd(a, b);
}
static inline D d_div(D a, D b) {
  return _mm512_div_pd(a, b);
}
static inline D d_max(D a, D b) {
  return _mm512_max_pd(a, b);
}
static inline D d_min(D a, D b) {
  return _mm512_min_pd(a, b);
}
static inline D d_abs(D a) {
  return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a);
}
static inline D d_negate(D a) {
  return _mm512_xor_pd(_mm512_set1_pd(-0.0), a);
}
static inline D d_copysign(D size, D sign) {
  return _mm512_or_pd(size, _mm512_and_pd(_mm512_set1_pd(-0.0), sign));
}
static inline D d_ceil(D a) {
  return _mm512_roundscale_pd(a, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
}
static inline void d_store_int(int32_t* to, D a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvttpd_epi32(a));
}
static inline void d_store_float(float* to, D a) {
  _mm256_storeu_ps(to, _mm512_cvtpd_ps(a));
}
static inline N d_greater(D a, D b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
}
static inline N d_equal(D a, D b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ);
}
static inline D d_select(N mask, D yes, D no) {
  return _mm512_mask_blend_pd(mask, no, yes);
}

static inline N n_none() {
  return 0;
}
static inline N n_and(N a, N b) {
  return _kand_mask8(a, b);
}
static inline N n_or(N a, N b) {
  return _kor_mask8(a, b);
}
static inline N n_not(N a) {
  return _knot_mask8(a);
}
static inline uint32_t n_bits(N a) {
  return a;
}

using I = __m512i;
static inline I i_load(const int32_t* from) {
  return _mm512_cvtepi32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
}
static inline D d_lookup(const double* table, I at) {
  return _mm512_permutex2var_pd(_mm512_loadu_pd(table), at, _mm512_loadu_pd(table + 8));
}
static inline D d_load_int(const int32_t* from) {
  return _mm512_cvtepi32_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
}
static inline int32_t n_compress(int32_t* to, int32_t first, N mask) {
  const __m256i lanes =
      _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(mask, lanes));
  return __builtin_popcount(mask);
}

static inline F f_set(float value) {
  return _mm512_set1_ps(value);
}
static inline F f_iota() {
  return _mm512_setr_ps(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
static inline F f_load(const float* from) {
  return _mm512_loadu_ps(from);
}
static inline void f_store(float* to, F a) {
  _mm512_storeu_ps(to, a);
}
static inline F f_add(F a, F b) {
  return _mm512_add_ps(a, b);
}
static inline F f_sub(F a, F b) {
  return _mm512_sub_ps(a, b);
}
static inline F f_mul(F a, F b) {
  return _mm512_mul_ps(a, b);
}
static inline F f_div(F a, F b) {
  return _mm512_div_ps(a, b);
}
static inline F f_max(F a, F b) {
  return _mm512_max_ps(a, b);
}
static inline F f_min(F a, F b) {
  return _mm512_min_ps(a, b);
}
static inline F f_abs(F a) {
  return _mm512_andnot_ps(_mm512_set1_ps(-0.0f), a);
}
static inline void f_store_int(int32_t* to, F a) {
  _mm512_storeu_si512(to, _mm512_cvttps_epi32(a));
}
static inline M f_greater(F a, F b) {
  return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ);
}
static inline M f_equal(F a, F b) {
  return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ);
}
static inline F f_select(M mask, F yes, F no) {
  return _mm512_mask_blend_ps(mask, no, yes);
}

static inline U u_set(uint32_t value) {
  return _mm512_set1_epi32(static_cast<int32_t>(value));
}
static inline U u_iota() {
  return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
static inline U u_load(const uint32_t* from) {
  return _mm512_loadu_si512(from);
}
static inline void u_store(uint32_t* to, U a) {
  _mm512_storeu_si512(to, a);
}
static inline U u_add(U a, U b) {
  return _mm512_add_epi32(a, b);
}
static inline M u_less(U a, U b) {
  return _mm512_cmplt_epu32_mask(a, b);
}
static inline M u_equal(U a, U b) {
  return _mm512_cmpeq_epi32_mask(a, b);
}
static inline U u_select(M mask, U yes, U no) {
  return _mm512_mask_blend_epi32(mask, no, yes);
}
static inline void f_store_where(float* to, M mask, F a, F) {
  _mm512_mask_storeu_ps(to, mask, a);
}
static inline void u_store_where(uint32_t* to, M mask, U a, U) {
  _mm512_mask_storeu_epi32(to, mask, a);
}
static inline void u_compress(uint32_t* to, U a, M mask) {
  u_store(to, _mm512_maskz_compress_epi32(mask, a));
}

static inline M m_first(int32_t count) {
  return _mm512_cmpgt_epi32_mask(_mm512_set1_epi32(count), u_iota());
}
static inline M m_from_bits(uint32_t bits) {
  return static_cast<M>(bits);
}
static inline M m_and(M a, M b) {
  return _kand_mask16(a, b);
}
static inline M m_or(M a, M b) {
  return _kor_mask16(a, b);
}
static inline M m_not(M a) {
  return _knot_mask16(a);
}
static inline uint32_t m_bits(M a) {
  return a;
}
