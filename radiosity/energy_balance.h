#pragma once

#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// Where the power of a solution on a matrix goes.
/// @param energy  receives [band]; `cut` and `unshot` stay 0
void balance_energy(const Scene& scene, const PatchSet& patches, const Solution& solution,
                    std::span<EnergyBalance> energy) noexcept;

} // namespace hemicube::radiosity
