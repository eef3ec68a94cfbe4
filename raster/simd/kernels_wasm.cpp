#include "raster/kernels.h"

// A module that holds one vector instruction is refused as a whole where there are none: so they
// are there if all of the build has them, with -msimd128.
#if defined(__wasm_simd128__)

#include <wasm_simd128.h>

namespace hemicube::raster {
namespace wasm {

#include "raster/simd/ops_wasm.h"

#include "raster/simd/kernels.inl"

} // namespace wasm

extern const Kernels kWasmKernels;
const Kernels kWasmKernels = {"wasm",     wasm::test_node, wasm::find_bounds, wasm::set_up,
                              wasm::draw, wasm::occlusion, wasm::hidden,      wasm::take_runs};

} // namespace hemicube::raster

#endif
