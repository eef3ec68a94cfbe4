// Operations of the SSE4.1 kernels: 2 doubles, 4 floats, 4 integers. A mask is a vector of
// all-ones lanes. See ops_scalar.h for what each one means.

#include "raster/simd/lanes_to_front.inl"

constexpr int kDoubles = 2;
constexpr int kFloats = 4;
using D = __m128d;
using N = __m128d;
using F = __m128;
using U = __m128i;
using M = __m128;

static inline D d_set(double value) {
  return _mm_set1_pd(value);
}
static inline D d_iota() {
  return _mm_setr_pd(0, 1);
}
static inline D d_load(const double* from) {
  return _mm_loadu_pd(from);
}
static inline void d_store(double* to, D a) {
  _mm_storeu_pd(to, a);
}
static inline D d_add(D a, D b) {
  return _mm_add_pd(a, b);
}
static inline D d_sub(D a, D b) {
  return _mm_sub_pd(a, b);
}
static inline D d_mul(D a, D b) {
  return _mm_mul_pd(a, b);
}
static inline D d_div(D a, D b) {
  return _mm_div_pd(a, b);
}
static inline D d_max(D a, D b) {
  return _mm_max_pd(a, b);
}
static inline D d_min(D a, D b) {
  return _mm_min_pd(a, b);
}
static inline D d_abs(D a) {
  return _mm_andnot_pd(_mm_set1_pd(-0.0), a);
}
static inline D d_negate(D a) {
  return _mm_xor_pd(_mm_set1_pd(-0.0), a);
}
static inline D d_copysign(D size, D sign) {
  return _mm_or_pd(size, _mm_and_pd(_mm_set1_pd(-0.0), sign));
}
static inline D d_ceil(D a) {
  return _mm_ceil_pd(a);
}
static inline void d_store_int(int32_t* to, D a) {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_cvttpd_epi32(a));
}
static inline void d_store_float(float* to, D a) {
  _mm_storel_pi(reinterpret_cast<__m64*>(to), _mm_cvtpd_ps(a));
}
static inline N d_greater(D a, D b) {
  return _mm_cmpgt_pd(a, b);
}
static inline N d_equal(D a, D b) {
  return _mm_cmpeq_pd(a, b);
}
static inline D d_select(N mask, D yes, D no) {
  return _mm_blendv_pd(no, yes, mask);
}

static inline N n_none() {
  return _mm_setzero_pd();
}
static inline N n_and(N a, N b) {
  return _mm_and_pd(a, b);
}
static inline N n_or(N a, N b) {
  return _mm_or_pd(a, b);
}
static inline N n_not(N a) {
  return _mm_xor_pd(a, _mm_castsi128_pd(_mm_set1_epi32(-1)));
}
static inline uint32_t n_bits(N a) {
  return static_cast<uint32_t>(_mm_movemask_pd(a));
}

struct I {
  int32_t lanes[2];
};
static inline I i_load(const int32_t* from) {
  return {{from[0], from[1]}};
}
static inline D d_lookup(const double* table, I at) {
  return _mm_loadh_pd(_mm_load_sd(table + at.lanes[0]), table + at.lanes[1]);
}
static inline D d_load_int(const int32_t* from) {
  return _mm_cvtepi32_pd(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
}
static inline int32_t n_compress(int32_t* to, int32_t first, N mask) {
  const uint32_t bits = n_bits(mask);
  to[0] = first;
  to[bits & 1] = first + 1;
  return __builtin_popcount(bits);
}

static inline F f_set(float value) {
  return _mm_set1_ps(value);
}
static inline F f_iota() {
  return _mm_setr_ps(0, 1, 2, 3);
}
static inline F f_load(const float* from) {
  return _mm_loadu_ps(from);
}
static inline void f_store(float* to, F a) {
  _mm_storeu_ps(to, a);
}
static inline F f_add(F a, F b) {
  return _mm_add_ps(a, b);
}
static inline F f_sub(F a, F b) {
  return _mm_sub_ps(a, b);
}
static inline F f_mul(F a, F b) {
  return _mm_mul_ps(a, b);
}
static inline F f_div(F a, F b) {
  return _mm_div_ps(a, b);
}
static inline F f_max(F a, F b) {
  return _mm_max_ps(a, b);
}
static inline F f_min(F a, F b) {
  return _mm_min_ps(a, b);
}
static inline F f_abs(F a) {
  return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
}
static inline void f_store_int(int32_t* to, F a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_cvttps_epi32(a));
}
static inline M f_greater(F a, F b) {
  return _mm_cmpgt_ps(a, b);
}
static inline M f_equal(F a, F b) {
  return _mm_cmpeq_ps(a, b);
}
static inline F f_select(M mask, F yes, F no) {
  return _mm_blendv_ps(no, yes, mask);
}

static inline U u_set(uint32_t value) {
  return _mm_set1_epi32(static_cast<int32_t>(value));
}
static inline U u_iota() {
  return _mm_setr_epi32(0, 1, 2, 3);
}
static inline U u_load(const uint32_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}
static inline void u_store(uint32_t* to, U a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), a);
}
static inline U u_add(U a, U b) {
  return _mm_add_epi32(a, b);
}
static inline M u_less(U a, U b) {
  const U sign = _mm_set1_epi32(INT32_MIN);
  return _mm_castsi128_ps(_mm_cmpgt_epi32(_mm_xor_si128(b, sign), _mm_xor_si128(a, sign)));
}
static inline M u_equal(U a, U b) {
  return _mm_castsi128_ps(_mm_cmpeq_epi32(a, b));
}
static inline U u_select(M mask, U yes, U no) {
  return _mm_castps_si128(_mm_blendv_ps(_mm_castsi128_ps(no), _mm_castsi128_ps(yes), mask));
}

static inline M m_first(int32_t count) {
  return _mm_castsi128_ps(_mm_cmpgt_epi32(_mm_set1_epi32(count), u_iota()));
}
static inline M m_from_bits(uint32_t bits) {
  const U lane = _mm_setr_epi32(1, 2, 4, 8);
  return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(u_set(bits), lane), lane));
}
static inline M m_and(M a, M b) {
  return _mm_and_ps(a, b);
}
static inline M m_or(M a, M b) {
  return _mm_or_ps(a, b);
}
static inline M m_not(M a) {
  return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1)));
}
static inline uint32_t m_bits(M a) {
  return static_cast<uint32_t>(_mm_movemask_ps(a));
}

static inline void f_store_where(float* to, M mask, F a, F there) {
  f_store(to, f_select(mask, a, there));
}
static inline void u_store_where(uint32_t* to, M mask, U a, U there) {
  u_store(to, u_select(mask, a, there));
}
static inline void u_compress(uint32_t* to, U a, M mask) {
  const auto* order = reinterpret_cast<const __m128i*>(kLanesToFront.bytes[m_bits(mask)]);
  u_store(to, _mm_shuffle_epi8(a, _mm_load_si128(order)));
}
