#pragma once

#include "raster/status.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#else
#include <cfenv>
#endif

namespace hemicube {

/// Rounding to nearest and denormals kept, for the life of the object: a host program may have
/// changed either for its threads. One per block of work.
class FloatEnvironment {
public:
#if defined(__x86_64__)
  // float and double are SSE's: its control word says it all, and the C library's <fenv.h>, which
  // sets the x87's besides, would take libm.
  FloatEnvironment() noexcept : control_(_mm_getcsr()) {
    _mm_setcsr(control_ & ~(kRounding | kFlushDenormals));
  }
  ~FloatEnvironment() {
    _mm_setcsr(control_);
  }
#elif defined(__aarch64__)
  FloatEnvironment() noexcept {
    asm volatile("mrs %0, fpcr" : "=r"(control_));
    asm volatile("msr fpcr, %0" : : "r"(control_ & ~(kRounding | kFlushDenormals)));
  }
  ~FloatEnvironment() {
    asm volatile("msr fpcr, %0" : : "r"(control_));
  }
#else
  FloatEnvironment() noexcept : rounding_(std::fegetround()) {
    if (rounding_ != FE_TONEAREST)
      std::fesetround(FE_TONEAREST);
  }
  ~FloatEnvironment() {
    if (rounding_ != FE_TONEAREST)
      std::fesetround(rounding_);
  }
#endif
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
#if defined(__x86_64__)
  static constexpr unsigned kRounding = 0x6000, kFlushDenormals = 0x8040; // RC; FTZ and DAZ
  unsigned control_;
#elif defined(__aarch64__)
  static constexpr std::uint64_t kRounding = 0xc00000;        // RMode
  static constexpr std::uint64_t kFlushDenormals = 0x1000003; // FZ; AH and FIZ
  std::uint64_t control_;
#else
  int rounding_;
#endif
};

#if defined(__x86_64__)
namespace detail {
/// What the compiler makes of a * a - b where it has fused operations to choose: in the kernels of
/// some instruction sets, though the rest of the build knows none.
__attribute__((target("fma"), noinline)) inline double square_less(double a, double b) noexcept {
  return a * a - b;
}
} // namespace detail
#endif

/// Detects a build whose compiler fuses a * b + c into one rounding, and extended precision.
/// @return kUnsupportedFloatEnvironment then
inline Status check_float_environment() noexcept {
  const FloatEnvironment environment;
  volatile double x = 1 + 0x1p-27;
  volatile double square = 1 + 0x1p-26; // x * x rounded
  const double a = x, b = square;
  volatile float y = 1 + 0x1p-12f;
  volatile float square_f = 1 + 0x1p-11f;
  const float c = y, d = square_f;
  bool is_honest = a * a - b == 0 && c * c - d == 0;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma"))
    is_honest = is_honest && detail::square_less(a, b) == 0;
#endif
  if (!is_honest)
    return Status::error(StatusCode::kUnsupportedFloatEnvironment,
                         "this build fuses or extends floating-point operations: compile hemicube "
                         "with -ffp-contract=off and without -ffast-math");
  return {};
}

} // namespace hemicube
