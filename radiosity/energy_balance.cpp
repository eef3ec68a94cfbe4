#include "radiosity/energy_balance.h"

namespace hemicube::radiosity {

void balance_energy(const Scene& scene, const PatchSet& patches, const Solution& s,
                    std::span<EnergyBalance> energy) noexcept {
  for (std::uint32_t b = 0; b < s.band_count; ++b) {
    EnergyBalance band;
    for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
      const double area = patches.area[i];
      const std::size_t at = std::size_t{i} * s.band_count + b;
      band.emitted += area * (s.exitance[at] + s.space[i] * scene.space_exitance[b]);
      band.absorbed += area * (1 - s.reflectance[at]) * s.irradiance[at];
      band.back_side += area * s.back_side[i] * s.radiosity[at];
      band.escaped += area * s.space[i] * s.radiosity[at];
    }
    if (band.emitted > 0)
      band.imbalance =
          (band.emitted - band.absorbed - band.back_side - band.escaped) / band.emitted;
    energy[b] = band;
  }
}

} // namespace hemicube::radiosity
