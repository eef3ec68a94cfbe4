#include "radiosity/solve/row_kernels.h"

#if defined(__wasm_simd128__) // see raster/simd/kernels_wasm.cpp

#include <wasm_simd128.h>

namespace hemicube::radiosity {
namespace wasm {

#include "radiosity/solve/simd/ops_wasm.h"

#include "radiosity/solve/simd/pair_kernels.inl"

} // namespace wasm

extern const RowKernels kWasmRowKernels;
const RowKernels kWasmRowKernels = {"wasm", wasm::row_sums_1, wasm::two_bands<2>, wasm::row_sums_3,
                                    wasm::row_sums_4};

} // namespace hemicube::radiosity

#endif
