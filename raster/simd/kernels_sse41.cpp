#include "raster/kernels.h"

#if defined(__x86_64__)

#include <immintrin.h>

// Every function of this file is compiled for SSE4.1, and none is visible outside it: the linker
// can never pick one of them for a program that runs on an older machine.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("sse4.1"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("sse4.1")
#endif

namespace hemicube::raster {
namespace sse41 {

#include "raster/simd/ops_sse41.h"

#include "raster/simd/kernels.inl"

} // namespace sse41
} // namespace hemicube::raster

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace hemicube::raster {

extern const Kernels kSse41Kernels;
const Kernels kSse41Kernels = {"sse41",     sse41::test_node, sse41::find_bounds, sse41::set_up,
                               sse41::draw, sse41::occlusion, sse41::hidden,      sse41::take_runs};

} // namespace hemicube::raster

#endif
