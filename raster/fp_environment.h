#pragma once

#include "raster/status.h"

#include <cfenv>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace hemicube {

/// Rounding to nearest and denormals kept, for the life of the object: a host program may have
/// changed either for its threads. One per block of work.
class FloatEnvironment {
public:
  FloatEnvironment() noexcept : rounding_(std::fegetround()) {
    if (rounding_ != FE_TONEAREST)
      std::fesetround(FE_TONEAREST);
#if defined(__x86_64__)
    control_ = _mm_getcsr();
    _mm_setcsr(control_ & ~kFlushDenormals);
#endif
  }
  ~FloatEnvironment() {
#if defined(__x86_64__)
    _mm_setcsr(control_);
#endif
    if (rounding_ != FE_TONEAREST)
      std::fesetround(rounding_);
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
  int rounding_;
#if defined(__x86_64__)
  static constexpr unsigned kFlushDenormals = 0x8040; // FTZ and DAZ
  unsigned control_;
#endif
};

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
  if (a * a - b != 0 || c * c - d != 0)
    return Status::error(StatusCode::kUnsupportedFloatEnvironment,
                         "this build fuses or extends floating-point operations: compile hemicube "
                         "with -ffp-contract=off and without -ffast-math");
  return {};
}

} // namespace hemicube
