// Operations of the row kernels for WebAssembly's 128-bit vectors, on pairs of doubles. See
// ops_sse2.h for what each one means.

using P = v128_t;

static inline P p_set(double value) {
  return wasm_f64x2_splat(value);
}
static inline P p_load(const double* from) {
  return wasm_v128_load(from);
}
static inline P p_load_two(const double* first, const double* second) {
  return wasm_f64x2_make(*first, *second);
}
static inline P p_load_floats(const float* from) {
  return wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(from));
}
static inline void p_store(double* to, P a) {
  wasm_v128_store(to, a);
}
static inline P p_add(P a, P b) {
  return wasm_f64x2_add(a, b);
}
static inline P p_mul(P a, P b) {
  return wasm_f64x2_mul(a, b);
}
static inline double p_first_plus_second(P a) {
  return wasm_f64x2_extract_lane(a, 0) + wasm_f64x2_extract_lane(a, 1);
}
