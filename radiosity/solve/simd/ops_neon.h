// Operations of the row kernels for NEON, on pairs of doubles. See ops_sse2.h for what each one
// means.

using P = float64x2_t;

static inline P p_set(double value) {
  return vdupq_n_f64(value);
}
static inline P p_load(const double* from) {
  return vld1q_f64(from);
}
static inline P p_load_two(const double* first, const double* second) {
  return vcombine_f64(vld1_f64(first), vld1_f64(second));
}
static inline P p_load_floats(const float* from) {
  return vcvt_f64_f32(vld1_f32(from));
}
static inline void p_store(double* to, P a) {
  vst1q_f64(to, a);
}
static inline P p_add(P a, P b) {
  return vaddq_f64(a, b);
}
static inline P p_mul(P a, P b) {
  return vmulq_f64(a, b);
}
static inline double p_first_plus_second(P a) {
  return vgetq_lane_f64(a, 0) + vgetq_lane_f64(a, 1);
}
