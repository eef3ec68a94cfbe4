#include "raster/kernels.h"

namespace hemicube::raster {
namespace scalar {

#include "raster/simd/ops_scalar.h"

#include "raster/simd/kernels.inl"

} // namespace scalar

extern const Kernels kScalarKernels;
const Kernels kScalarKernels = {"scalar",       scalar::test_node, scalar::find_bounds,
                                scalar::set_up, scalar::draw,      scalar::occlusion,
                                scalar::hidden, scalar::take_runs};

} // namespace hemicube::raster
