#include "radiosity/solve/row_kernels.h"

#if defined(__aarch64__) // every one of these processors has NEON

#include <arm_neon.h>

namespace hemicube::radiosity {
namespace neon {

#include "radiosity/solve/simd/ops_neon.h"

#include "radiosity/solve/simd/pair_kernels.inl"

} // namespace neon

extern const RowKernels kNeonRowKernels;
const RowKernels kNeonRowKernels = {"neon", neon::row_sums_1, neon::two_bands<2>, neon::row_sums_3,
                                    neon::row_sums_4};

} // namespace hemicube::radiosity

#endif
