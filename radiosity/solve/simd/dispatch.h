#pragma once

#include "radiosity/solve/row_kernels.h"

#include <string_view>

namespace hemicube::radiosity {

/// The kernels for an instruction set by the name it has in raster/simd/dispatch.h, which says
/// whether this machine has it. Names without kernels of their own get those of the next lower one:
/// AVX-512 those of AVX2, because a sweep waits for memory.
const RowKernels& row_kernels(std::string_view isa) noexcept;

} // namespace hemicube::radiosity
