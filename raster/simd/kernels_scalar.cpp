#include "raster/span_kernel.h"

namespace hemicube::raster {
namespace scalar {

#include "raster/simd/ops_scalar.h"

#include "raster/simd/kernels.inl"

} // namespace scalar

extern const Kernels kScalarKernels;
const Kernels kScalarKernels = {"scalar", scalar::solve_rows, scalar::fill_rows, scalar::smallest,
                                scalar::run_breaks};

} // namespace hemicube::raster
