// Operations of the row kernels for SSE2, on pairs of doubles.

using P = __m128d;

static inline P p_set(double value) {
  return _mm_set1_pd(value);
}
static inline P p_load(const double* from) {
  return _mm_loadu_pd(from);
}
// From two places.
static inline P p_load_two(const double* first, const double* second) {
  return _mm_loadh_pd(_mm_load_sd(first), second);
}
// Two neighbours, widened.
static inline P p_load_floats(const float* from) {
  const auto* both = reinterpret_cast<const __m128i*>(from);
  return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(both)));
}
static inline void p_store(double* to, P a) {
  _mm_storeu_pd(to, a);
}
static inline P p_add(P a, P b) {
  return _mm_add_pd(a, b);
}
static inline P p_mul(P a, P b) {
  return _mm_mul_pd(a, b);
}
static inline double p_first_plus_second(P a) {
  return _mm_cvtsd_f64(_mm_add_sd(a, _mm_unpackhi_pd(a, a)));
}
