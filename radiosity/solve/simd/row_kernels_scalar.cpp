#include "radiosity/form_factor/interleaved_sum.h"
#include "radiosity/solve/row_kernels.h"

// The oracle of the other row kernels, and what machines without them run.
namespace hemicube::radiosity {
namespace {

template <uint64_t kWidth>
void row_sums(const uint32_t* columns, const float* values, uint64_t count, const double* x,
              double* sums) {
  for (uint64_t band = 0; band < kWidth; ++band)
    sums[band] = interleaved_sum(0, count, [=](uint64_t k) {
      return static_cast<double>(values[k]) * x[columns[k] * kWidth + band];
    });
}

} // namespace

extern const RowKernels kScalarRowKernels;
const RowKernels kScalarRowKernels = {"scalar", row_sums<1>, row_sums<2>, row_sums<3>, row_sums<4>};

} // namespace hemicube::radiosity
