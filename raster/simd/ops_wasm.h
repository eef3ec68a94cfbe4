// Operations of the kernels for WebAssembly's 128-bit vectors: 2 doubles, 4 floats, 4 integers. A
// mask is a vector of all-ones lanes. See ops_scalar.h for what each one means.

#include "raster/simd/lanes_to_front.inl"

constexpr int kDoubles = 2;
constexpr int kFloats = 4;
using D = v128_t;
using N = v128_t;
using F = v128_t;
using U = v128_t;
using M = v128_t;

static inline D d_set(double value) {
  return wasm_f64x2_splat(value);
}
static inline D d_iota() {
  return wasm_f64x2_make(0, 1);
}
static inline D d_load(const double* from) {
  return wasm_v128_load(from);
}
static inline void d_store(double* to, D a) {
  wasm_v128_store(to, a);
}
static inline D d_add(D a, D b) {
  return wasm_f64x2_add(a, b);
}
static inline D d_sub(D a, D b) {
  return wasm_f64x2_sub(a, b);
}
static inline D d_mul(D a, D b) {
  return wasm_f64x2_mul(a, b);
}
static inline D d_div(D a, D b) {
  return wasm_f64x2_div(a, b);
}
// Not max and min: if an operand is not a number, neither is what they return. pmax(b, a) is
// b < a ? a : b, and pmin(b, a) is a < b ? a : b.
static inline D d_max(D a, D b) {
  return wasm_f64x2_pmax(b, a);
}
static inline D d_min(D a, D b) {
  return wasm_f64x2_pmin(b, a);
}
static inline D d_abs(D a) {
  return wasm_f64x2_abs(a);
}
static inline D d_negate(D a) {
  return wasm_f64x2_neg(a);
}
static inline D d_copysign(D size, D sign) {
  return wasm_v128_bitselect(sign, size, wasm_f64x2_splat(-0.0));
}
static inline D d_ceil(D a) {
  return wasm_f64x2_ceil(a);
}
static inline void d_store_int(int32_t* to, D a) {
  wasm_v128_store64_lane(to, wasm_i32x4_trunc_sat_f64x2_zero(a), 0);
}
static inline void d_store_float(float* to, D a) {
  wasm_v128_store64_lane(to, wasm_f32x4_demote_f64x2_zero(a), 0);
}
static inline N d_greater(D a, D b) {
  return wasm_f64x2_gt(a, b);
}
static inline N d_equal(D a, D b) {
  return wasm_f64x2_eq(a, b);
}
static inline D d_select(N mask, D yes, D no) {
  return wasm_v128_bitselect(yes, no, mask);
}

static inline N n_none() {
  return wasm_i64x2_splat(0);
}
static inline N n_and(N a, N b) {
  return wasm_v128_and(a, b);
}
static inline N n_or(N a, N b) {
  return wasm_v128_or(a, b);
}
static inline N n_not(N a) {
  return wasm_v128_not(a);
}
static inline uint32_t n_bits(N a) {
  return static_cast<uint32_t>(wasm_i64x2_bitmask(a));
}

struct I {
  int32_t lanes[2];
};
static inline I i_load(const int32_t* from) {
  return {{from[0], from[1]}};
}
static inline D d_lookup(const double* table, I at) {
  return wasm_f64x2_make(table[at.lanes[0]], table[at.lanes[1]]);
}
static inline D d_load_int(const int32_t* from) {
  return wasm_f64x2_convert_low_i32x4(wasm_v128_load64_zero(from));
}
static inline int32_t n_compress(int32_t* to, int32_t first, N mask) {
  const uint32_t bits = n_bits(mask);
  to[0] = first;
  to[bits & 1] = first + 1;
  return __builtin_popcount(bits);
}

static inline F f_set(float value) {
  return wasm_f32x4_splat(value);
}
static inline F f_iota() {
  return wasm_f32x4_make(0, 1, 2, 3);
}
static inline F f_load(const float* from) {
  return wasm_v128_load(from);
}
static inline void f_store(float* to, F a) {
  wasm_v128_store(to, a);
}
static inline F f_add(F a, F b) {
  return wasm_f32x4_add(a, b);
}
static inline F f_sub(F a, F b) {
  return wasm_f32x4_sub(a, b);
}
static inline F f_mul(F a, F b) {
  return wasm_f32x4_mul(a, b);
}
static inline F f_div(F a, F b) {
  return wasm_f32x4_div(a, b);
}
static inline F f_max(F a, F b) {
  return wasm_f32x4_pmax(b, a);
}
static inline F f_min(F a, F b) {
  return wasm_f32x4_pmin(b, a);
}
static inline F f_abs(F a) {
  return wasm_f32x4_abs(a);
}
static inline void f_store_int(int32_t* to, F a) {
  wasm_v128_store(to, wasm_i32x4_trunc_sat_f32x4(a));
}
static inline M f_greater(F a, F b) {
  return wasm_f32x4_gt(a, b);
}
static inline M f_equal(F a, F b) {
  return wasm_f32x4_eq(a, b);
}
static inline F f_select(M mask, F yes, F no) {
  return wasm_v128_bitselect(yes, no, mask);
}

static inline U u_set(uint32_t value) {
  return wasm_u32x4_splat(value);
}
static inline U u_iota() {
  return wasm_u32x4_make(0, 1, 2, 3);
}
static inline U u_load(const uint32_t* from) {
  return wasm_v128_load(from);
}
static inline void u_store(uint32_t* to, U a) {
  wasm_v128_store(to, a);
}
static inline U u_add(U a, U b) {
  return wasm_i32x4_add(a, b);
}
static inline M u_less(U a, U b) {
  return wasm_u32x4_lt(a, b);
}
static inline M u_equal(U a, U b) {
  return wasm_i32x4_eq(a, b);
}
static inline U u_select(M mask, U yes, U no) {
  return wasm_v128_bitselect(yes, no, mask);
}

static inline M m_first(int32_t count) {
  return wasm_i32x4_gt(wasm_i32x4_splat(count), u_iota());
}
static inline M m_from_bits(uint32_t bits) {
  const U lane = wasm_u32x4_make(1, 2, 4, 8);
  return wasm_i32x4_eq(wasm_v128_and(u_set(bits), lane), lane);
}
static inline M m_and(M a, M b) {
  return wasm_v128_and(a, b);
}
static inline M m_or(M a, M b) {
  return wasm_v128_or(a, b);
}
static inline M m_not(M a) {
  return wasm_v128_not(a);
}
static inline uint32_t m_bits(M a) {
  return static_cast<uint32_t>(wasm_i32x4_bitmask(a));
}

static inline void f_store_where(float* to, M mask, F a, F there) {
  f_store(to, f_select(mask, a, there));
}
static inline void u_store_where(uint32_t* to, M mask, U a, U there) {
  u_store(to, u_select(mask, a, there));
}
static inline void u_compress(uint32_t* to, U a, M mask) {
  u_store(to, wasm_i8x16_swizzle(a, wasm_v128_load(kLanesToFront.bytes[m_bits(mask)])));
}
