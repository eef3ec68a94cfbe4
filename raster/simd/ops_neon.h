// Operations of the NEON kernels: 2 doubles, 4 floats, 4 integers. A mask is a vector of all-ones
// lanes. See ops_scalar.h for what each one means.

#include "raster/simd/lanes_to_front.inl"

constexpr int kDoubles = 2;
constexpr int kFloats = 4;
using D = float64x2_t;
using N = uint64x2_t;
using F = float32x4_t;
using U = uint32x4_t;
using M = uint32x4_t;

static inline D d_set(double value) {
  return vdupq_n_f64(value);
}
static inline D d_iota() {
  return D{0, 1};
}
static inline D d_load(const double* from) {
  return vld1q_f64(from);
}
static inline void d_store(double* to, D a) {
  vst1q_f64(to, a);
}
static inline D d_add(D a, D b) {
  return vaddq_f64(a, b);
}
static inline D d_sub(D a, D b) {
  return vsubq_f64(a, b);
}
static inline D d_mul(D a, D b) {
  return vmulq_f64(a, b);
}
static inline D d_div(D a, D b) {
  return vdivq_f64(a, b);
}
static inline N d_greater(D a, D b) {
  return vcgtq_f64(a, b);
}
static inline N d_equal(D a, D b) {
  return vceqq_f64(a, b);
}
static inline D d_select(N mask, D yes, D no) {
  return vbslq_f64(mask, yes, no);
}
// Not vmaxq and vminq: if an operand is not a number, neither is what they return.
static inline D d_max(D a, D b) {
  return d_select(d_greater(a, b), a, b);
}
static inline D d_min(D a, D b) {
  return d_select(d_greater(b, a), a, b);
}
static inline D d_abs(D a) {
  return vabsq_f64(a);
}
static inline D d_negate(D a) {
  return vnegq_f64(a);
}
static inline D d_copysign(D size, D sign) {
  return vbslq_f64(vdupq_n_u64(uint64_t{1} << 63), sign, size);
}
static inline D d_ceil(D a) {
  return vrndpq_f64(a);
}
static inline void d_store_int(int32_t* to, D a) {
  vst1_s32(to, vqmovn_s64(vcvtq_s64_f64(a)));
}
static inline void d_store_float(float* to, D a) {
  vst1_f32(to, vcvt_f32_f64(a));
}

static inline N n_none() {
  return vdupq_n_u64(0);
}
static inline N n_and(N a, N b) {
  return vandq_u64(a, b);
}
static inline N n_or(N a, N b) {
  return vorrq_u64(a, b);
}
static inline N n_not(N a) {
  return vreinterpretq_u64_u32(vmvnq_u32(vreinterpretq_u32_u64(a)));
}
static inline uint32_t n_bits(N a) {
  return static_cast<uint32_t>(vaddvq_u64(vandq_u64(a, N{1, 2})));
}

struct I {
  int32_t lanes[2];
};
static inline I i_load(const int32_t* from) {
  return {{from[0], from[1]}};
}
static inline D d_lookup(const double* table, I at) {
  return vcombine_f64(vld1_f64(table + at.lanes[0]), vld1_f64(table + at.lanes[1]));
}
static inline D d_load_int(const int32_t* from) {
  return vcvtq_f64_s64(vmovl_s32(vld1_s32(from)));
}
static inline int32_t n_compress(int32_t* to, int32_t first, N mask) {
  const uint32_t bits = n_bits(mask);
  to[0] = first;
  to[bits & 1] = first + 1;
  return __builtin_popcount(bits);
}

static inline F f_set(float value) {
  return vdupq_n_f32(value);
}
static inline F f_iota() {
  return F{0, 1, 2, 3};
}
static inline F f_load(const float* from) {
  return vld1q_f32(from);
}
static inline void f_store(float* to, F a) {
  vst1q_f32(to, a);
}
static inline F f_add(F a, F b) {
  return vaddq_f32(a, b);
}
static inline F f_sub(F a, F b) {
  return vsubq_f32(a, b);
}
static inline F f_mul(F a, F b) {
  return vmulq_f32(a, b);
}
static inline F f_div(F a, F b) {
  return vdivq_f32(a, b);
}
static inline M f_greater(F a, F b) {
  return vcgtq_f32(a, b);
}
static inline M f_equal(F a, F b) {
  return vceqq_f32(a, b);
}
static inline F f_select(M mask, F yes, F no) {
  return vbslq_f32(mask, yes, no);
}
static inline F f_max(F a, F b) {
  return f_select(f_greater(a, b), a, b);
}
static inline F f_min(F a, F b) {
  return f_select(f_greater(b, a), a, b);
}
static inline F f_abs(F a) {
  return vabsq_f32(a);
}
static inline void f_store_int(int32_t* to, F a) {
  vst1q_s32(to, vcvtq_s32_f32(a));
}

static inline U u_set(uint32_t value) {
  return vdupq_n_u32(value);
}
static inline U u_iota() {
  return U{0, 1, 2, 3};
}
static inline U u_load(const uint32_t* from) {
  return vld1q_u32(from);
}
static inline void u_store(uint32_t* to, U a) {
  vst1q_u32(to, a);
}
static inline U u_add(U a, U b) {
  return vaddq_u32(a, b);
}
static inline M u_less(U a, U b) {
  return vcltq_u32(a, b);
}
static inline M u_equal(U a, U b) {
  return vceqq_u32(a, b);
}
static inline U u_select(M mask, U yes, U no) {
  return vbslq_u32(mask, yes, no);
}

static inline M m_first(int32_t count) {
  return vcgtq_s32(vdupq_n_s32(count), vreinterpretq_s32_u32(u_iota()));
}
static inline M m_from_bits(uint32_t bits) {
  return vtstq_u32(u_set(bits), U{1, 2, 4, 8});
}
static inline M m_and(M a, M b) {
  return vandq_u32(a, b);
}
static inline M m_or(M a, M b) {
  return vorrq_u32(a, b);
}
static inline M m_not(M a) {
  return vmvnq_u32(a);
}
static inline uint32_t m_bits(M a) {
  return vaddvq_u32(vandq_u32(a, U{1, 2, 4, 8}));
}

static inline void f_store_where(float* to, M mask, F a, F there) {
  f_store(to, f_select(mask, a, there));
}
static inline void u_store_where(uint32_t* to, M mask, U a, U there) {
  u_store(to, u_select(mask, a, there));
}
static inline void u_compress(uint32_t* to, U a, M mask) {
  const uint8x16_t order = vld1q_u8(kLanesToFront.bytes[m_bits(mask)]);
  u_store(to, vreinterpretq_u32_u8(vqtbl1q_u8(vreinterpretq_u8_u32(a), order)));
}
