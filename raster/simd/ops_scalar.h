// Operations of the portable kernels: vectors of one lane. The oracle of every other set.
// A mask is a bool; see ops_avx2.h for the same list in vectors.

constexpr int kDoubles = 1;
constexpr int kFloats = 1;
using D = double;
using F = float;
using U = uint32_t;
using M = bool;

static inline D d_set(double value) {
  return value;
}
static inline D d_iota() {
  return 0.0;
}
static inline D d_add(D a, D b) {
  return a + b;
}
static inline D d_mul(D a, D b) {
  return a * b;
}
static inline D d_max(D a, D b) {
  return a > b ? a : b;
}
static inline D d_min(D a, D b) {
  return a < b ? a : b;
}
static inline void d_store_ceil(int32_t* to, D a) {
  const int32_t whole = static_cast<int32_t>(a);
  *to = whole + (a > whole ? 1 : 0);
}
static inline void d_store_float(float* to, D a) {
  *to = static_cast<float>(a);
}

static inline F f_set(float value) {
  return value;
}
static inline F f_iota() {
  return 0.0f;
}
static inline F f_load(const float* from) {
  return *from;
}
static inline void f_store(float* to, F a) {
  *to = a;
}
static inline F f_add(F a, F b) {
  return a + b;
}
static inline F f_mul(F a, F b) {
  return a * b;
}
static inline F f_min(F a, F b) {
  return a < b ? a : b;
}
static inline M f_greater(F a, F b) {
  return a > b;
}
static inline M f_equal(F a, F b) {
  return a == b;
}
static inline F f_select(M mask, F yes, F no) {
  return mask ? yes : no;
}

static inline U u_set(uint32_t value) {
  return value;
}
static inline U u_load(const uint32_t* from) {
  return *from;
}
static inline void u_store(uint32_t* to, U a) {
  *to = a;
}
static inline M u_less(U a, U b) {
  return a < b;
}
static inline M u_equal(U a, U b) {
  return a == b;
}
static inline U u_select(M mask, U yes, U no) {
  return mask ? yes : no;
}

static inline M m_first(int32_t count) {
  return count > 0;
}
static inline M m_and(M a, M b) {
  return a && b;
}
static inline M m_or(M a, M b) {
  return a || b;
}
static inline uint32_t m_bits(M a) {
  return a ? 1u : 0u;
}
