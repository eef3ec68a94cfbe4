#include "radiosity/solve/simd/dispatch.h"

namespace hemicube::radiosity {

extern const RowKernels kScalarRowKernels;

#if defined(__x86_64__)
extern const RowKernels kSse2RowKernels;
extern const RowKernels kAvx2RowKernels;

const RowKernels& row_kernels(std::string_view isa) noexcept {
  if (isa == "avx2" || isa == "avx512")
    return kAvx2RowKernels;
  return isa == "sse41" ? kSse2RowKernels : kScalarRowKernels;
}
#elif defined(__aarch64__)
extern const RowKernels kNeonRowKernels;

const RowKernels& row_kernels(std::string_view isa) noexcept {
  return isa == "neon" ? kNeonRowKernels : kScalarRowKernels;
}
#elif defined(__wasm_simd128__)
extern const RowKernels kWasmRowKernels;

const RowKernels& row_kernels(std::string_view isa) noexcept {
  return isa == "wasm" ? kWasmRowKernels : kScalarRowKernels;
}
#else
const RowKernels& row_kernels(std::string_view) noexcept {
  return kScalarRowKernels;
}
#endif

} // namespace hemicube::radiosity
