#include "raster/kernels.h"

#if defined(__x86_64__)

#if !defined(__clang__)
// GCC 12 warns of its own header: _mm512_undefined_pd reads a variable that it never sets.
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

// Every function of this file is compiled for AVX-512, and none is visible outside it: the linker
// can never pick one of them for a program that runs on an older machine.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512bw,avx512vl"))),        \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl")
#endif

namespace hemicube::raster {
namespace avx512 {

#include "raster/simd/ops_avx512.h"

#include "raster/simd/kernels.inl"

} // namespace avx512
} // namespace hemicube::raster

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace hemicube::raster {

extern const Kernels kAvx512Kernels;
const Kernels kAvx512Kernels = {"avx512",       avx512::test_node, avx512::find_bounds,
                                avx512::set_up, avx512::draw,      avx512::occlusion,
                                avx512::hidden, avx512::take_runs};

} // namespace hemicube::raster

#endif
