#pragma once

// The seam between the solvers and the instruction sets: plain data and function pointers. Included
// by the ISA files, so it includes nothing but <stdint.h>.
#include <stdint.h>

namespace hemicube::radiosity {

/// sums[b] = sum of values[k] * x[columns[k] * W + b] over 0 <= k < count, for W bands side by
/// side, each in the order of interleaved_sum.h. No scale. A row's columns ascend.
/// @param x     [patch][W], and one more double that may be read
/// @param sums  [W]; room for 4
using RowSums = void (*)(const uint32_t* columns, const float* values, uint64_t count,
                         const double* x, double* sums);

/// The inner loops of the solvers for one instruction set. All give the same bits: a vector holds
/// bands or interleaved partial sums side by side, and never folds them in an order of its own.
struct RowKernels {
  const char* name;
  RowSums of_1, of_2, of_3, of_4; ///< W = 1, 2, 3, 4
};

} // namespace hemicube::radiosity
