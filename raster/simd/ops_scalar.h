// Operations of the portable kernels, and what every instruction set gives: vectors of one lane.
// D doubles with masks N, F floats and U 32-bit integers with masks M. Maxima and minima return
// their second operand if either is not a number; `iota` numbers the lanes.

constexpr int kDoubles = 1;
constexpr int kFloats = 1;
using D = double;
using N = bool;
using F = float;
using U = uint32_t;
using M = bool;

static inline D d_set(double value) {
  return value;
}
static inline D d_iota() {
  return 0.0;
}
static inline D d_load(const double* from) {
  return *from;
}
static inline void d_store(double* to, D a) {
  *to = a;
}
static inline D d_add(D a, D b) {
  return a + b;
}
static inline D d_sub(D a, D b) {
  return a - b;
}
static inline D d_mul(D a, D b) {
  return a * b;
}
static inline D d_div(D a, D b) {
  return a / b;
}
static inline D d_max(D a, D b) {
  return a > b ? a : b;
}
static inline D d_min(D a, D b) {
  return a < b ? a : b;
}
static inline D d_abs(D a) {
  return __builtin_fabs(a);
}
static inline D d_negate(D a) {
  return -a;
}
static inline D d_copysign(D size, D sign) {
  return __builtin_copysign(size, sign);
}
// Of numbers that fit an int32.
static inline D d_ceil(D a) {
  const int32_t whole = static_cast<int32_t>(a);
  return whole + (a > whole ? 1 : 0);
}
static inline void d_store_int(int32_t* to, D a) {
  *to = static_cast<int32_t>(a);
}
static inline void d_store_float(float* to, D a) {
  *to = static_cast<float>(a);
}
static inline N d_greater(D a, D b) {
  return a > b;
}
static inline N d_equal(D a, D b) {
  return a == b;
}
static inline D d_select(N mask, D yes, D no) {
  return mask ? yes : no;
}

static inline N n_none() {
  return false;
}
static inline N n_and(N a, N b) {
  return a && b;
}
static inline N n_or(N a, N b) {
  return a || b;
}
static inline N n_not(N a) {
  return !a;
}
static inline uint32_t n_bits(N a) {
  return a ? 1u : 0u;
}

// Numbers of elements of a table of kBatch doubles, one for each lane of a D.
using I = int32_t;
static inline I i_load(const int32_t* from) {
  return *from;
}
static inline D d_lookup(const double* table, I at) {
  return table[at];
}
static inline D d_load_int(const int32_t* from) {
  return *from;
}
// Writes `first` + lane for the lanes of the mask, one after the other, and anything after them, up
// to a whole vector; returns how many.
static inline int32_t n_compress(int32_t* to, int32_t first, N mask) {
  *to = first;
  return mask ? 1 : 0;
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
static inline F f_sub(F a, F b) {
  return a - b;
}
static inline F f_mul(F a, F b) {
  return a * b;
}
static inline F f_div(F a, F b) {
  return a / b;
}
static inline F f_max(F a, F b) {
  return a > b ? a : b;
}
static inline F f_min(F a, F b) {
  return a < b ? a : b;
}
static inline F f_abs(F a) {
  return __builtin_fabsf(a);
}
// Truncates numbers that fit an int32.
static inline void f_store_int(int32_t* to, F a) {
  *to = static_cast<int32_t>(a);
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
static inline U u_iota() {
  return 0;
}
static inline U u_load(const uint32_t* from) {
  return *from;
}
static inline void u_store(uint32_t* to, U a) {
  *to = a;
}
static inline U u_add(U a, U b) {
  return a + b;
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
// Stores the lanes of the mask; the others keep `there`, what memory holds.
static inline void f_store_where(float* to, M mask, F a, F there) {
  f_store(to, f_select(mask, a, there));
}
static inline void u_store_where(uint32_t* to, M mask, U a, U there) {
  u_store(to, u_select(mask, a, there));
}
// Writes the lanes of the mask one after the other, and anything after them, up to a whole vector.
static inline void u_compress(uint32_t* to, U a, M mask) {
  if (mask)
    *to = a;
}

// The first `count` lanes; none if count <= 0.
static inline M m_first(int32_t count) {
  return count > 0;
}
// Bit i is lane i.
static inline M m_from_bits(uint32_t bits) {
  return (bits & 1) != 0;
}
static inline M m_and(M a, M b) {
  return a && b;
}
static inline M m_or(M a, M b) {
  return a || b;
}
static inline M m_not(M a) {
  return !a;
}
static inline uint32_t m_bits(M a) {
  return a ? 1u : 0u;
}
