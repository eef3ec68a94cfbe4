#include "raster/simd/dispatch.h"

#include "raster/kernels.h"
#include "raster/memory.h"

#include <cstdlib>

namespace hemicube::raster {

extern const Kernels kScalarKernels;

#if defined(__x86_64__)
extern const Kernels kSse41Kernels;
extern const Kernels kAvx2Kernels;
extern const Kernels kAvx512Kernels;

namespace {

bool runs_here(const Kernels& kernels) {
  if (&kernels == &kAvx512Kernels)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (&kernels == &kAvx2Kernels)
    return __builtin_cpu_supports("avx2");
  return &kernels != &kSse41Kernels || __builtin_cpu_supports("sse4.1");
}

const Kernels* const kAllKernels[] = {&kAvx512Kernels, &kAvx2Kernels, &kSse41Kernels,
                                      &kScalarKernels};

} // namespace

std::string_view kernel_names() noexcept {
  return "avx512, avx2, sse41, scalar";
}

#else // what was built runs
#if defined(__aarch64__)
extern const Kernels kNeonKernels;
#elif defined(__wasm_simd128__)
extern const Kernels kWasmKernels;
#endif

namespace {

bool runs_here(const Kernels&) {
  return true;
}

const Kernels* const kAllKernels[] = {
#if defined(__aarch64__)
    &kNeonKernels,
#elif defined(__wasm_simd128__)
    &kWasmKernels,
#endif
    &kScalarKernels};

} // namespace

std::string_view kernel_names() noexcept {
#if defined(__aarch64__)
  return "neon, scalar";
#elif defined(__wasm_simd128__)
  return "wasm, scalar";
#else
  return "scalar";
#endif
}
#endif

const Kernels* kernels_by_name(std::string_view name) noexcept {
  for (const Kernels* kernels : kAllKernels)
    if (name == kernels->name && runs_here(*kernels))
      return kernels;
  return nullptr;
}

const Kernels& best_kernels() noexcept {
  if (const char* forced = std::getenv("HEMICUBE_ISA")) {
    if (const Kernels* kernels = kernels_by_name(forced))
      return *kernels;
    log_message(Status::error(StatusCode::kInvalidArgument, "HEMICUBE_ISA=", forced,
                              " is not available here, and not looked at")
                    .message()
                    .data());
  }
  for (const Kernels* kernels : kAllKernels)
    if (runs_here(*kernels))
      return *kernels;
  return kScalarKernels;
}

} // namespace hemicube::raster
