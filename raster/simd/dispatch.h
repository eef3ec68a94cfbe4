#pragma once

#include <string_view>

namespace hemicube::raster {

struct Kernels; // raster/kernels.h

/// The kernels of an instruction set by name ("scalar", "sse41", "avx2", "avx512", "neon", "wasm"),
/// or null if this build or this machine has none of that name.
const Kernels* kernels_by_name(std::string_view name) noexcept;

/// The fastest kernels this machine runs. HEMICUBE_ISA in the environment forces one by name; a
/// name that is not available there is ignored by the library and refused by the program.
const Kernels& best_kernels() noexcept;

/// All names this build knows, best first, separated by ", ".
std::string_view kernel_names() noexcept;

} // namespace hemicube::raster
