#include "raster/kernels.h"

#if defined(__x86_64__)

#include <immintrin.h>

// Every function of this file is compiled for AVX2, and none is visible outside it: the linker can
// never pick one of them for a program that runs on an older machine.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

namespace hemicube::raster {
namespace avx2 {

#include "raster/simd/ops_avx2.h"

#include "raster/simd/kernels.inl"

} // namespace avx2
} // namespace hemicube::raster

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace hemicube::raster {

extern const Kernels kAvx2Kernels;
const Kernels kAvx2Kernels = {"avx2",     avx2::test_node, avx2::find_bounds, avx2::set_up,
                              avx2::draw, avx2::occlusion, avx2::hidden,      avx2::take_runs};

} // namespace hemicube::raster

#endif
