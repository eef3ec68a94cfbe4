#include "raster/kernels.h"

#if defined(__aarch64__) // every one of these processors has NEON

#include <arm_neon.h>

namespace hemicube::raster {
namespace neon {

#include "raster/simd/ops_neon.h"

#include "raster/simd/kernels.inl"

} // namespace neon

extern const Kernels kNeonKernels;
const Kernels kNeonKernels = {"neon",     neon::test_node, neon::find_bounds, neon::set_up,
                              neon::draw, neon::occlusion, neon::hidden,      neon::take_runs};

} // namespace hemicube::raster

#endif
