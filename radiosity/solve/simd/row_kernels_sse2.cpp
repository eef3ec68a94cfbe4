#include "radiosity/solve/row_kernels.h"

#if defined(__x86_64__)

#include <emmintrin.h>

namespace hemicube::radiosity {
namespace sse2 {

#include "radiosity/solve/simd/ops_sse2.h"

#include "radiosity/solve/simd/pair_kernels.inl"

} // namespace sse2

extern const RowKernels kSse2RowKernels;
const RowKernels kSse2RowKernels = {"sse2", sse2::row_sums_1, sse2::two_bands<2>, sse2::row_sums_3,
                                    sse2::row_sums_4};

} // namespace hemicube::radiosity

#endif
