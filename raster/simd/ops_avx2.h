// Operations of the AVX2 kernels: 4 doubles, 8 floats, 8 integers. A mask is a vector of all-ones
// lanes. d_max, d_min and f_min return the second operand if either is NaN; no kernel feeds them
// one.

constexpr int kDoubles = 4;
constexpr int kFloats = 8;
using D = __m256d;
using F = __m256;
using U = __m256i;
using M = __m256;

static inline D d_set(double value) {
  return _mm256_set1_pd(value);
}
static inline D d_iota() {
  return _mm256_setr_pd(0, 1, 2, 3);
}
static inline D d_add(D a, D b) {
  return _mm256_add_pd(a, b);
}
static inline D d_mul(D a, D b) {
  return _mm256_mul_pd(a, b);
}
static inline D d_max(D a, D b) {
  return _mm256_max_pd(a, b);
}
static inline D d_min(D a, D b) {
  return _mm256_min_pd(a, b);
}
static inline void d_store_ceil(int32_t* to, D a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvttpd_epi32(_mm256_ceil_pd(a)));
}
static inline void d_store_float(float* to, D a) {
  _mm_storeu_ps(to, _mm256_cvtpd_ps(a));
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
static inline F f_mul(F a, F b) {
  return _mm256_mul_ps(a, b);
}
static inline F f_min(F a, F b) {
  return _mm256_min_ps(a, b);
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
static inline U u_load(const uint32_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}
static inline void u_store(uint32_t* to, U a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a);
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
  const U lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(count), lanes));
}
static inline M m_and(M a, M b) {
  return _mm256_and_ps(a, b);
}
static inline M m_or(M a, M b) {
  return _mm256_or_ps(a, b);
}
static inline uint32_t m_bits(M a) {
  return static_cast<uint32_t>(_mm256_movemask_ps(a));
}
